// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/droplet_crowd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

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

Vec3 vectorOf(const std::array<float, 3>& v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// Whether a droplet runs from one sample to the next. Small shifts are not runs: rain on a droplet at rest shifts its
/// centre.
bool runs(const DropletPose& from, const DropletPose& to)
{
    return from.moves || to.moves || length(vectorOf(to.place) - vectorOf(from.place)) > static_cast<double>(to.across);
}

/// Splits the time of a droplet on the ground.
/// @param first  index of the first sample there
/// @param last   index behind the last one
/// @param end    first frame without it
void splitOnGround(const DropletHistory& history, std::size_t first, std::size_t last, std::uint32_t end, Spans& spans)
{
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
        if (from.place == to.place || !runs(from, to)) {
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

void split(const DropletHistory& history, Spans& spans)
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
            splitOnGround(history, first, last, end, spans);
        }
        first = last;
    }
}

Spans spansOf(const DropletHistories& histories)
{
    Spans spans;
    for (const DropletHistory* history : histories.all()) {
        split(*history, spans);
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
};

/// Path of a run; straight and with constant speed between two points.
std::vector<Point> pathOf(const Span& run)
{
    std::vector<Point> path;
    const auto add = [&](std::uint32_t frame) { path.push_back({frame, vectorOf(run.history->at(frame).place)}); };
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
        path.push_back(
            {run.end, run.end < run.history->end ? vectorOf(run.history->at(run.end).place) : path.back().place});
    }
    return path;
}

/// Points that suffice within the tolerances. D. H. Douglas and T. K. Peucker, "Algorithms for the reduction of the
/// number of points required to represent a digitized line", Cartographica 10 (1973) 112, over time.
/// @param tolerance    across the path [m]
/// @param time_frames  additional tolerance along the path [frames]
std::vector<Point> reduced(const std::vector<Point>& path, double tolerance, double time_frames)
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
        const double longer = tolerance + time_frames * size / std::max(frames, 1.0);
        double worst = 1.0;
        std::size_t split = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double share = (path[i].frame - path[first].frame) / frames;
            const Vec3 off = path[i].place - path[first].place - share * chord;
            const double ahead = dot(off, along);
            const double excess = std::max(length(off - ahead * along) / tolerance, std::abs(ahead) / longer);
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

/// Calls take(frame, pose) for the begin of a span and for each change since the last call: of the size, of the place
/// of a droplet at rest, or of the shape of a running one.
/// @param tolerance  of the place over the contact radius, for a droplet at rest
template <typename Take>
void forChanges(const Span& span, std::optional<double> tolerance, const Take& take)
{
    DropletPose last = span.history->at(span.begin);
    take(span.begin, last);
    for (const DropletSample& sample : span.history->samples) {
        if (sample.frame <= span.begin || sample.frame >= span.end) {
            continue;
        }
        const DropletPose& pose = sample.pose;
        const double shift = length(vectorOf(pose.place) - vectorOf(last.place));
        if (!last.looksLike(pose) || (tolerance && shift > *tolerance * static_cast<double>(pose.restRadius()))) {
            last = sample.pose;
            take(sample.frame, last);
        }
    }
}

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
        const Spans spans = spansOf(histories);
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
        if (!spans.rests.empty()) {
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

    void addCrowd(const DropletMesh& mesh, const char* name, std::vector<std::size_t> nodes)
    {
        scene_.crowds.push_back({scene_.addMesh(sceneMesh(mesh, name, material_)), std::move(nodes), root_});
    }

    /// Adds the node of a copy, in the pose of the first frame.
    std::size_t addCopy(const Span& span, std::size_t parent, Vec3 place, bool turns)
    {
        SceneNode node;
        if (span.begin > 0) {
            node.scale = {0.0, 0.0, 0.0};
        } else {
            const DropletPose& pose = span.history->at(0);
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
        std::vector<Span> spans;
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
            facing->spans.push_back(rest);
        }
        std::vector<std::size_t> copies;
        for (const Facing& facing : facings) {
            SceneNode node{"at rest"};
            std::copy(facing.turn.begin(), facing.turn.end(), node.rotation.begin());
            const std::size_t parent = scene_.addNode(std::move(node), root_);
            const auto [x, y, z, w] = facing.turn;
            const std::array<float, 4> back{-x, -y, -z, w};
            for (const std::vector<std::size_t>& slot : assignSlots(facing.spans, 0)) {
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
                for (const std::size_t number : slot) {
                    const Span& span = facing.spans[number];
                    if (span.begin > free) {
                        key(free, place, 0.0F);
                    }
                    forChanges(span, options_.place_tolerance, [&](std::uint32_t frame, const DropletPose& pose) {
                        place = turnedBy(back, vectorOf(pose.place));
                        key(frame, place, pose.restRadius());
                    });
                    free = span.end;
                }
                if (free < frames_) {
                    key(free, place, 0.0F);
                }
                const Span& first = facing.spans[slot.front()];
                const std::size_t copy =
                    addCopy(first, parent, turnedBy(back, vectorOf(first.history->at(first.begin).place)), false);
                copies.push_back(copy);
                if (times.size() > 1) {
                    const std::size_t keys = scene_.addTimes(std::move(times));
                    if (!std::equal(places.begin() + 3, places.end(), places.begin())) {
                        animateInSteps(copy, SceneChange::Translation, keys, std::move(places));
                    }
                    animateInSteps(copy, SceneChange::Scale, keys, std::move(sizes));
                }
            }
        }
        addCrowd(options_.resting, "droplets at rest", std::move(copies));
    }

    /// @param turns  whether the droplets have a direction
    void addRuns(const std::vector<Span>& runs, const DropletMesh& mesh, const char* name, bool turns)
    {
        std::vector<std::size_t> copies;
        for (const std::vector<std::size_t>& slot : assignSlots(runs, 1)) {
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
            const Span& first = runs[slot.front()];
            if (first.begin > 0) {
                hide(0, first.history->at(first.begin));
            }
            for (const std::size_t number : slot) {
                const Span& run = runs[number];
                const auto tolerance =
                    options_.place_tolerance * static_cast<double>(run.history->at(run.begin).across);
                for (const Point& point :
                     reduced(pathOf(run), tolerance, options_.time_tolerance * scene_.frames_per_second)) {
                    times.push_back(timeOf(point.frame));
                    append(places, point.place);
                }
                forChanges(run, std::nullopt, change);
                if (run.end < frames_) {
                    hide(run.end, run.history->at(run.end - 1));
                }
            }
            const std::size_t copy = addCopy(first, root_, vectorOf(first.history->at(first.begin).place), turns);
            copies.push_back(copy);
            animate(copy, SceneChange::Translation, scene_.addTimes(std::move(times)), std::move(places));
            const std::size_t keys = scene_.addTimes(std::move(changes));
            if (turns) {
                animateInSteps(copy, SceneChange::Rotation, keys, std::move(rotations));
            }
            animateInSteps(copy, SceneChange::Scale, keys, std::move(sizes));
        }
        addCrowd(mesh, name, std::move(copies));
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

void checkCrowd(const DropletHistories& histories, const char* remedy)
{
    // Bytes of a joint's JSON and of a sample's keys. In memory the JSON takes about fifteen times as much.
    constexpr std::uint64_t kJoint = 800;
    constexpr std::uint64_t kSample = 10;
    constexpr std::uint64_t kMax = std::uint64_t{1} << 27;
    const std::uint64_t bytes = kSample * histories.samples() + kJoint * histories.maxCount();
    if (bytes >= kMax) {
        throw Error(ErrorCode::InvalidArgument,
                    std::to_string(histories.frames()) + " frames of up to " + std::to_string(histories.maxCount()) +
                        " droplets would make a glTF file of about " + std::to_string(bytes) +
                        " bytes; it must be less than 128 MiB: use a shorter time, fewer frames per second or " +
                        remedy);
    }
}

}  // namespace droplet
