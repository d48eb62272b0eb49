// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/droplet_crowd.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "axes.h"
#include "byte_stream.h"
#include "droplet/error.h"

namespace droplet {
namespace {

/// Shorter rests are part of the run around them: another copy would cost more keys [frames].
constexpr std::uint32_t kShortRest = 15;

/// Time in which a slot shows a droplet.
struct Span {
    const DropletHistory* history = nullptr;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// Rests, runs and falls of all droplets.
struct Spans {
    std::vector<Span> rests;
    std::vector<Span> runs;
    std::vector<Span> falls;
};

/// Whether a droplet runs from one sample to the next. Small shifts are not runs: rain on a droplet at rest shifts its
/// centre. On ground that deforms, large ones may be the ground's.
bool runs(const DropletPose& from, const DropletPose& to, bool deforms)
{
    return from.moves || to.moves ||
           (!deforms && length(vectorOf(to.place) - vectorOf(from.place)) > static_cast<double>(to.across));
}

/// Time of a droplet on the ground.
struct OnGround {
    std::size_t first = 0;  ///< index of the first sample there
    std::size_t last = 0;   ///< index behind the last one
    std::uint32_t end = 0;  ///< first frame without it
    bool deforms = false;   ///< CrowdOptions::deforms
};

/// Splits this time.
void splitOnGround(const DropletHistory& history, const OnGround& time, Spans& spans)
{
    const std::size_t first = time.first;
    const std::size_t last = time.last;
    const std::uint32_t end = time.end;
    std::uint32_t done = history.samples[first].frame;
    std::optional<std::uint32_t> running;  // first frame of the run
    std::uint32_t moved = 0;               // last frame with a motion
    const auto end_run = [&](std::uint32_t next) {
        if (running && next - moved >= kShortRest) {
            spans.runs.push_back({&history, *running, moved});
            done = moved;
            running.reset();
        }
    };
    for (std::size_t i = first + 1; i < last; ++i) {
        const DropletPose& from = history.samples[i - 1].pose;
        const DropletPose& to = history.samples[i].pose;
        if (from.place == to.place || !runs(from, to, time.deforms)) {
            continue;
        }
        const std::uint32_t frame = history.samples[i].frame;
        end_run(frame - 1);
        if (!running) {
            running = frame - 1 - done >= kShortRest ? frame - 1 : done;
            if (*running > done) {
                spans.rests.push_back({&history, done, *running});
            }
        }
        moved = frame;
    }
    end_run(end);
    if (running) {
        spans.runs.push_back({&history, *running, end});
    } else {
        spans.rests.push_back({&history, done, end});
    }
}

void split(const DropletHistory& history, bool deforms, Spans& spans)
{
    const std::vector<DropletSample>& samples = history.samples;
    for (std::size_t first = 0; first < samples.size();) {
        std::size_t last = first + 1;
        while (last < samples.size() && samples[last].pose.airborne == samples[first].pose.airborne) {
            ++last;
        }
        const std::uint32_t end = last < samples.size() ? samples[last].frame : history.end;
        if (samples[first].pose.airborne) {
            spans.falls.push_back({&history, samples[first].frame, end});
        } else {
            splitOnGround(history, {first, last, end, deforms}, spans);
        }
        first = last;
    }
}

Spans spansOf(const DropletHistories& histories, bool deforms)
{
    Spans spans;
    for (const DropletHistory* history : histories.all()) {
        split(*history, deforms, spans);
    }
    for (std::vector<Span>* all : {&spans.rests, &spans.runs, &spans.falls}) {
        std::stable_sort(all->begin(), all->end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
    }
    return spans;
}

/// Place of a droplet at the beginning of a frame.
struct Point {
    std::uint32_t frame = 0;
    Vec3 place;
    Vec3 normal;
};

/// Path of a run; straight and with constant speed between two points.
std::vector<Point> pathOf(const Span& run)
{
    std::vector<Point> path;
    const auto add = [&](std::uint32_t frame) {
        const DropletPose& pose = run.history->at(frame);
        path.push_back({frame, vectorOf(pose.place), pose.normal()});
    };
    add(run.begin);
    for (const DropletSample& sample : run.history->samples) {
        if (sample.frame > run.begin && sample.frame < run.end) {
            if (sample.frame - 1 > path.back().frame) {
                add(sample.frame - 1);  // it rested until then
            }
            add(sample.frame);
        }
    }
    if (path.back().frame < run.end) {
        // The path ends at the next rest, or where the droplet was last.
        if (run.end < run.history->end) {
            add(run.end);
        } else {
            path.push_back({run.end, path.back().place, path.back().normal});
        }
    }
    return path;
}

/// Points that suffice within the tolerances. D. H. Douglas and T. K. Peucker, "Algorithms for the reduction of the
/// number of points required to represent a digitized line", Cartographica 10 (1973) 112, over time.
struct PathTolerance {
    double across = 0.0;             ///< the path [m]
    double frames = 0.0;             ///< additional, along the path
    std::optional<double> off = {};  ///< the ground [m]; empty: as across
};

std::vector<Point> reduced(const std::vector<Point>& path, const PathTolerance& tolerance)
{
    std::vector<bool> kept(path.size(), false);
    kept.front() = true;
    kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, path.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        const double frames = path[last].frame - path[first].frame;
        const Vec3 chord = path[last].place - path[first].place;
        const double size = length(chord);
        const Vec3 along = size > 0.0 ? (1.0 / size) * chord : Vec3{};
        const double longer = tolerance.across + tolerance.frames * size / std::max(frames, 1.0);
        double worst = 1.0;
        std::size_t split = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double share = (path[i].frame - path[first].frame) / frames;
            const Vec3 off = path[i].place - path[first].place - share * chord;
            const double ahead = dot(off, along);
            const double lift = tolerance.off ? std::abs(dot(off, path[i].normal)) / *tolerance.off : 0.0;
            const double excess =
                std::max({length(off - ahead * along) / tolerance.across, std::abs(ahead) / longer, lift});
            if (excess > worst) {
                worst = excess;
                split = i;
            }
        }
        if (split > 0) {
            kept[split] = true;
            open.emplace_back(first, split);
            open.emplace_back(split, last);
        }
    }
    std::vector<Point> points;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (kept[i]) {
            points.push_back(path[i]);
        }
    }
    return points;
}

/// Part of a path; straight and with constant speed between two points.
std::vector<Point> partOf(const std::vector<Point>& path, std::uint32_t begin, std::uint32_t end)
{
    const auto at = [&](std::uint32_t frame) {
        const auto after = std::find_if(path.begin(), path.end(), [&](const Point& p) { return p.frame >= frame; });
        if (after->frame == frame) {
            return *after;
        }
        const Point& from = *(after - 1);
        const double share = static_cast<double>(frame - from.frame) / (after->frame - from.frame);
        return Point{frame, from.place + share * (after->place - from.place), from.normal};
    };
    std::vector<Point> part{at(begin)};
    for (const Point& point : path) {
        if (point.frame > begin && point.frame < end) {
            part.push_back(point);
        }
    }
    if (end > begin) {
        part.push_back(at(end));
    }
    return part;
}

/// Pose that is shown from a frame on.
struct Change {
    std::uint32_t frame = 0;
    DropletPose pose;
};

/// Changes that are shown in a part of their time.
std::vector<Change> partOf(const std::vector<Change>& changes, std::uint32_t begin, std::uint32_t end)
{
    std::vector<Change> part;
    for (const Change& change : changes) {
        if (change.frame <= begin) {
            part.assign(1, {begin, change.pose});
        } else if (change.frame < end) {
            part.push_back(change);
        }
    }
    return part;
}

/// Pose at the begin of a span, and after each change since the last one: of the size, of the place of a droplet at
/// rest, or of the shape of a running one.
/// @param tolerance  of the place over the contact radius, for a droplet at rest
std::vector<Change> changesOf(const Span& span, std::optional<double> tolerance)
{
    DropletPose last = span.history->at(span.begin);
    std::vector<Change> changes{{span.begin, last}};
    for (const DropletSample& sample : span.history->samples) {
        if (sample.frame <= span.begin || sample.frame >= span.end) {
            continue;
        }
        const DropletPose& pose = sample.pose;
        const double shift = length(vectorOf(pose.place) - vectorOf(last.place));
        if (!last.looksLike(pose) || (tolerance && shift > *tolerance * static_cast<double>(pose.restRadius()))) {
            last = sample.pose;
            changes.push_back({sample.frame, last});
        }
    }
    return changes;
}

/// Time in which a copy shows a droplet with one shape.
struct Piece {
    Span span;
    std::uint32_t begin = 0;  ///< of the span
    std::uint32_t end = 0;
    std::vector<Change> changes;
    std::vector<Point> path = {};  ///< of a run
    std::size_t shape = 0;         ///< as in SceneCrowd::shape_of
};

/// Splits the time of a droplet where its shape does not fit the ground any more.
/// @param shown  poses in this time, the first at its begin
/// @return       begins of the parts, and their shapes; empty: the mesh's
std::vector<std::pair<std::uint32_t, DropletShape>> fit(const DropletMesh& mesh, const CrowdSeating& seating,
                                                        const std::vector<Change>& shown)
{
    constexpr double kGap = 0.03;   // with kSameShape a twentieth of the contact radius
    constexpr double kMore = 0.02;  // where seating leaves a larger gap
    std::vector<std::pair<std::uint32_t, DropletShape>> parts;
    double most = 0.0;
    for (const Change& change : shown) {
        const auto gap = [&] {
            const std::vector<Vec3>& own = parts.back().second.vertices;
            return seating.gap(own.empty() ? mesh.vertices : own, change.pose);
        };
        if (!parts.empty() && gap() <= most) {
            continue;
        }
        parts.emplace_back(change.frame, DropletShape{});
        if (gap() > kGap) {
            parts.back().second = seating.seat(mesh, change.pose);
        }
        most = std::max(kGap, gap() + kMore);
    }
    return parts;
}

/// Shapes of a crowd. Shapes that are nearly the same are one.
class Shapes {
public:
    /// Number of a shape as in SceneCrowd::shape_of.
    std::size_t numberOf(DropletShape&& shape)
    {
        constexpr std::size_t kLookBack = 64;
        if (shape.vertices.empty()) {
            return 0;
        }
        for (std::size_t k = all_.size(); k-- > 0 && k + kLookBack >= all_.size();) {
            if (areSame(all_[k], shape)) {
                return k + 1;
            }
        }
        all_.push_back(std::move(shape));
        return all_.size();
    }

    [[nodiscard]] std::vector<SceneShape> sceneShapes() const
    {
        std::vector<SceneShape> shapes(all_.size());
        std::transform(all_.begin(), all_.end(), shapes.begin(), [](const DropletShape& shape) {
            return SceneShape{sceneVectors(shape.vertices), sceneVectors(shape.normals)};
        });
        return shapes;
    }

private:
    static bool areSame(const DropletShape& a, const DropletShape& b)
    {
        constexpr double kSameShape = 0.02;  // over the half width
        for (std::size_t i = 0; i < a.vertices.size(); ++i) {
            if (length(a.vertices[i] - b.vertices[i]) > kSameShape) {
                return false;
            }
        }
        return true;
    }

    std::vector<DropletShape> all_;
};

void append(std::vector<float>& numbers, Vec3 v)
{
    numbers.insert(numbers.end(), {toFloat(v.x), toFloat(v.y), toFloat(v.z)});
}

/// Rounds numbers, for shorter text.
template <std::size_t Size>
std::array<double, Size> rounded(const std::array<double, Size>& numbers, int decimals)
{
    std::array<double, Size> result{};
    const double unit = std::pow(10.0, decimals);
    std::transform(numbers.begin(), numbers.end(), result.begin(),
                   [unit](double number) { return std::round(unit * number) / unit + 0.0; });
    return result;
}

std::array<double, 3> numbersOf(float x, float y, float z)
{
    return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

class CrowdBuilder {
public:
    CrowdBuilder(const DropletHistories& histories, const CrowdOptions& options, Scene& scene)
        : frames_(histories.frames()), options_(options), scene_(scene)
    {
        const Spans spans = spansOf(histories, options.deforms);
        scene.animation = options.animation;
        material_ = scene.addMaterial(liquidMaterial(lookOf(options.material), meanRadius(spans)));
        const bool moves = !options.poses.empty();
        root_ = scene.addNode({"droplets"}, moves ? std::optional(options.ground) : std::nullopt);
        for (const Vec3& corner : options.corners) {
            const Vec3 up = yUp(corner);
            SceneNode node{options.corner};
            node.translation = rounded(std::array{up.x, up.y, up.z}, options.decimals);
            scene.corners.push_back(scene.addNode(std::move(node), moves ? std::nullopt : std::optional(root_)));
        }
        moveGround();
        if (!spans.rests.empty() && options.deforms) {
            addRuns(spans.rests, options.resting, "droplets at rest", true);
        } else if (!spans.rests.empty()) {
            addRests(spans.rests);
        }
        if (!spans.runs.empty()) {
            addRuns(spans.runs, options.running, "droplets on their way", true);
        }
        if (!spans.falls.empty()) {
            addRuns(spans.falls, options.falling, "droplets in the air", false);
        }
    }

private:
    [[nodiscard]] float timeOf(std::uint32_t frame) const { return toFloat(frame / scene_.frames_per_second); }

    /// Thickness of the liquid for viewers, which do not scale it with the copies.
    static double meanRadius(const Spans& spans)
    {
        double sum = 0.0;
        for (const std::vector<Span>* all : {&spans.rests, &spans.runs, &spans.falls}) {
            for (const Span& span : *all) {
                sum += static_cast<double>(span.history->at(span.begin).restRadius());
            }
        }
        const std::size_t count = spans.rests.size() + spans.runs.size() + spans.falls.size();
        return count > 0 ? sum / static_cast<double>(count) : 0.0;
    }

    void animate(std::size_t node, SceneChange change, std::size_t times, std::vector<float> values)
    {
        scene_.tracks.push_back({node, change, false, times, std::move(values)});
    }

    void animateInSteps(std::size_t node, SceneChange change, std::size_t times, std::vector<float> values)
    {
        scene_.tracks.push_back({node, change, true, times, std::move(values), change == SceneChange::Rotation});
    }

    /// Copies of a mesh, and their shapes.
    struct Copies {
        std::vector<std::size_t> nodes;
        std::vector<std::size_t> shapes;
    };

    void addCrowd(const DropletMesh& mesh, const char* name, Copies copies, const Shapes& shapes)
    {
        SceneCrowd crowd{scene_.addMesh(sceneMesh(mesh, name, material_)), std::move(copies.nodes), root_};
        if (options_.seating) {
            crowd.shapes = shapes.sceneShapes();
            crowd.shape_of = std::move(copies.shapes);
            sortByShape(crowd);
        }
        scene_.crowds.push_back(std::move(crowd));
    }

    /// Copies of one shape follow one another, those of many copies first: a file's meshes hold a number of copies, and
    /// meshes with the same shapes are one.
    static void sortByShape(SceneCrowd& crowd)
    {
        std::map<std::size_t, std::size_t> counts;
        for (const std::size_t shape : crowd.shape_of) {
            ++counts[shape];
        }
        std::vector<std::size_t> order(crowd.nodes.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            const std::size_t one = crowd.shape_of[a];
            const std::size_t other = crowd.shape_of[b];
            return std::pair(counts[other], one) < std::pair(counts[one], other);
        });
        SceneCrowd sorted = crowd;
        for (std::size_t i = 0; i < order.size(); ++i) {
            sorted.nodes[i] = crowd.nodes[order[i]];
            sorted.shape_of[i] = crowd.shape_of[order[i]];
        }
        crowd = std::move(sorted);
    }

    /// Splits pieces where their shapes do not fit any more.
    /// @param shown  poses of a piece that are to be looked at
    template <typename PosesOf>
    std::vector<Piece> fitted(const std::vector<Piece>& pieces, const DropletMesh& mesh, Shapes& shapes,
                              const PosesOf& shown)
    {
        if (!options_.seating) {
            return pieces;
        }
        std::vector<std::vector<std::pair<std::uint32_t, DropletShape>>> parts(pieces.size());
        tbb::parallel_for(std::size_t{0}, pieces.size(),
                          [&](std::size_t i) { parts[i] = fit(mesh, *options_.seating, shown(pieces[i])); });
        std::vector<Piece> all;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            for (std::size_t k = 0; k < parts[i].size(); ++k) {
                const std::uint32_t begin = parts[i][k].first;
                const std::uint32_t end = k + 1 < parts[i].size() ? parts[i][k + 1].first : pieces[i].end;
                Piece piece{pieces[i].span, begin, end, partOf(pieces[i].changes, begin, end)};
                if (!pieces[i].path.empty()) {
                    piece.path = partOf(pieces[i].path, begin, end);
                }
                piece.shape = shapes.numberOf(std::move(parts[i][k].second));
                all.push_back(std::move(piece));
            }
        }
        std::stable_sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
        return all;
    }

    /// Calls take(slot, shape) for slots that show pieces one after another; all pieces of a slot have one shape.
    template <typename Take>
    static void forSlots(const std::vector<Piece>& pieces, std::uint32_t pause, const Take& take)
    {
        std::map<std::size_t, std::vector<Piece>> by_shape;
        for (const Piece& piece : pieces) {
            by_shape[piece.shape].push_back(piece);
        }
        for (const auto& [shape, same] : by_shape) {
            for (const std::vector<std::size_t>& slot : assignSlots(same, pause)) {
                std::vector<Piece> shown;
                shown.reserve(slot.size());
                for (const std::size_t number : slot) {
                    shown.push_back(same[number]);
                }
                take(shown, shape);
            }
        }
    }

    /// Adds the node of a copy, in the pose of the first frame.
    std::size_t addCopy(const Piece& piece, std::size_t parent, Vec3 place, bool turns)
    {
        SceneNode node;
        if (piece.begin > 0) {
            node.scale = {0.0, 0.0, 0.0};
        } else {
            const DropletPose& pose = piece.changes.front().pose;
            node.translation = rounded(std::array{place.x, place.y, place.z}, options_.decimals);
            const float radius = pose.restRadius();
            node.scale =
                rounded(turns ? numbersOf(pose.along, pose.up, pose.across) : numbersOf(radius, radius, radius),
                        options_.decimals + 1);
            if (turns) {
                std::copy(pose.turn.begin(), pose.turn.end(), node.rotation.begin());
                node.rotation = rounded(node.rotation, 4);
            }
        }
        return scene_.addNode(std::move(node), parent);
    }

    void moveGround()
    {
        if (options_.poses.empty()) {
            return;
        }
        std::vector<float> times;
        std::vector<float> places;
        std::vector<float> turns;
        for (std::uint32_t frame = 0; frame < options_.poses.size(); ++frame) {
            const auto& [place, turn] = options_.poses[frame];
            times.push_back(timeOf(frame));
            places.insert(places.end(), place.begin(), place.end());
            turns.insert(turns.end(), turn.begin(), turn.end());
        }
        const std::size_t keys = scene_.addTimes(std::move(times));
        animate(options_.ground, SceneChange::Translation, keys, std::move(places));
        animate(options_.ground, SceneChange::Rotation, keys, std::move(turns));
    }

    /// Droplets at rest with the same normal, to kFacing.
    struct Facing {
        std::array<float, 4> turn{};
        Vec3 normal;
        std::vector<Piece> pieces;
    };

    void addRests(const std::vector<Span>& rests)
    {
        std::vector<Facing> facings;
        for (const Span& rest : rests) {
            const DropletPose& pose = rest.history->at(rest.begin);
            const Vec3 normal = pose.normal();
            auto facing = std::find_if(facings.begin(), facings.end(),
                                       [&](const Facing& one) { return dot(one.normal, normal) > std::cos(kFacing); });
            if (facing == facings.end()) {
                facing = facings.insert(facings.end(), {pose.turn, normal, {}});
            }
            facing->pieces.push_back({rest, rest.begin, rest.end, changesOf(rest, options_.place_tolerance)});
        }
        Copies copies;
        Shapes shapes;
        for (const Facing& facing : facings) {
            SceneNode node{"at rest"};
            std::copy(facing.turn.begin(), facing.turn.end(), node.rotation.begin());
            const std::size_t parent = scene_.addNode(std::move(node), root_);
            const auto as_shown = [&](const Piece& piece) {
                std::vector<Change> shown = piece.changes;
                for (Change& change : shown) {
                    const float radius = change.pose.restRadius();
                    change.pose.turn = facing.turn;
                    change.pose.along = radius;
                    change.pose.across = radius;
                    change.pose.up = radius;
                }
                return shown;
            };
            forSlots(fitted(facing.pieces, options_.resting, shapes, as_shown), 0,
                     [&](const std::vector<Piece>& slot, std::size_t shape) {
                         copies.nodes.push_back(addRest(slot, facing.turn, parent));
                         copies.shapes.push_back(shape);
                     });
        }
        addCrowd(options_.resting, "droplets at rest", std::move(copies), shapes);
    }

    /// Adds a copy that shows droplets at rest, one after another; returns its node.
    std::size_t addRest(const std::vector<Piece>& slot, const std::array<float, 4>& turn, std::size_t parent)
    {
        const auto [x, y, z, w] = turn;
        const std::array<float, 4> back{-x, -y, -z, w};
        std::vector<float> times;
        std::vector<float> places;
        std::vector<float> sizes;
        std::uint32_t free = 0;
        const auto key = [&](std::uint32_t frame, Vec3 place, float radius) {
            times.push_back(timeOf(frame));
            append(places, place);
            sizes.insert(sizes.end(), 3, radius);
        };
        Vec3 place;
        for (const Piece& piece : slot) {
            if (piece.begin > free) {
                key(free, place, 0.0F);
            }
            for (const Change& change : piece.changes) {
                place = turnedBy(back, vectorOf(change.pose.place));
                key(change.frame, place, change.pose.restRadius());
            }
            free = piece.end;
        }
        if (free < frames_) {
            key(free, place, 0.0F);
        }
        const std::size_t copy =
            addCopy(slot.front(), parent, turnedBy(back, vectorOf(slot.front().changes.front().pose.place)), false);
        if (times.size() > 1) {
            const std::size_t keys = scene_.addTimes(std::move(times));
            if (!std::equal(places.begin() + 3, places.end(), places.begin())) {
                animateInSteps(copy, SceneChange::Translation, keys, std::move(places));
            }
            animateInSteps(copy, SceneChange::Scale, keys, std::move(sizes));
        }
        return copy;
    }

    /// @param turns  whether the droplets have a direction
    void addRuns(const std::vector<Span>& runs, const DropletMesh& mesh, const char* name, bool turns)
    {
        std::vector<Piece> pieces;
        for (const Span& run : runs) {
            const auto width = static_cast<double>(run.history->at(run.begin).across);
            PathTolerance tolerance{options_.place_tolerance * width,
                                    options_.time_tolerance * scene_.frames_per_second};
            if (options_.seating) {
                constexpr double kOff = 0.015;  // over the half width
                tolerance.off = kOff * width;
            }
            pieces.push_back({run, run.begin, run.end, changesOf(run, std::nullopt), reduced(pathOf(run), tolerance)});
        }
        const auto as_shown = [](const Piece& piece) {
            std::vector<Change> shown;
            shown.reserve(piece.end - piece.begin);
            for (std::uint32_t frame = piece.begin; frame < piece.end; ++frame) {
                DropletPose pose = partOf(piece.changes, frame, frame + 1).front().pose;
                const Vec3 place = partOf(piece.path, frame, frame).front().place;
                pose.place = {toFloat(place.x), toFloat(place.y), toFloat(place.z)};
                const DropletPose& real = piece.span.history->at(frame);
                pose.face = real.face;
                pose.shape = real.shape;
                shown.push_back({frame, pose});
            }
            return shown;
        };
        Copies copies;
        Shapes shapes;
        if (turns) {
            pieces = fitted(pieces, mesh, shapes, as_shown);
        }
        forSlots(pieces, 1, [&](const std::vector<Piece>& slot, std::size_t shape) {
            copies.nodes.push_back(addRun(slot, turns));
            copies.shapes.push_back(shape);
        });
        addCrowd(mesh, name, std::move(copies), shapes);
    }

    /// Adds a copy that shows droplets on their way, one after another; returns its node.
    std::size_t addRun(const std::vector<Piece>& slot, bool turns)
    {
        std::vector<float> times;
        std::vector<float> places;
        std::vector<float> changes;  // times of rotations and sizes
        std::vector<float> rotations;
        std::vector<float> sizes;
        const auto change = [&](std::uint32_t frame, const DropletPose& pose) {
            changes.push_back(timeOf(frame));
            rotations.insert(rotations.end(), pose.turn.begin(), pose.turn.end());
            sizes.insert(sizes.end(), {pose.along, pose.up, pose.across});
        };
        const auto hide = [&](std::uint32_t frame, DropletPose pose) {
            pose.along = 0.0F;
            pose.across = 0.0F;
            pose.up = 0.0F;
            change(frame, pose);
        };
        const Piece& first = slot.front();
        if (first.begin > 0) {
            hide(0, first.changes.front().pose);
        }
        for (const Piece& piece : slot) {
            for (const Point& point : piece.path) {
                times.push_back(timeOf(point.frame));
                append(places, point.place);
            }
            for (const Change& one : piece.changes) {
                change(one.frame, one.pose);
            }
            if (piece.end < frames_) {
                hide(piece.end, piece.span.history->at(piece.end - 1));
            }
        }
        const std::size_t copy = addCopy(first, root_, first.path.front().place, turns);
        animate(copy, SceneChange::Translation, scene_.addTimes(std::move(times)), std::move(places));
        const std::size_t keys = scene_.addTimes(std::move(changes));
        if (turns) {
            animateInSteps(copy, SceneChange::Rotation, keys, std::move(rotations));
        }
        animateInSteps(copy, SceneChange::Scale, keys, std::move(sizes));
        return copy;
    }

    std::uint32_t frames_;
    const CrowdOptions& options_;
    Scene& scene_;
    std::size_t material_ = 0;
    std::size_t root_ = 0;  ///< node of all droplets
};

}  // namespace

void addDroplets(const DropletHistories& histories, const CrowdOptions& options, Scene& scene)
{
    CrowdBuilder(histories, options, scene);
}

void checkCrowd(const DropletHistories& histories, std::size_t shapes, const char* remedy)
{
    // Bytes of a joint's JSON, of a shape, and of a sample's keys. In memory the JSON takes about fifteen times as
    // much.
    constexpr std::uint64_t kJoint = 800;
    constexpr std::uint64_t kShape = 3600;  // with its joint
    constexpr std::uint64_t kSample = 10;
    constexpr std::uint64_t kMax = std::uint64_t{1} << 27;
    const std::uint64_t bytes = kSample * histories.samples() + kJoint * histories.maxCount() + kShape * shapes;
    if (bytes >= kMax) {
        throw Error(ErrorCode::InvalidArgument,
                    std::to_string(histories.frames()) + " frames of up to " + std::to_string(histories.maxCount()) +
                        " droplets would make a glTF file of about " + std::to_string(bytes) +
                        " bytes; it must be less than 128 MiB: use a shorter time, fewer frames per second or " +
                        remedy);
    }
}

}  // namespace droplet
