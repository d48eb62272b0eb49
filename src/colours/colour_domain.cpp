// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boundaries between regions as arcs from junction to junction, each faired once, as maps of areas are stored: T. K.
// Peucker and N. Chrisman, "Cartographic data structures" (1975).
#include "droplet/colours/colour_domain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "colours/label_arcs.h"
#include "droplet/error.h"
#include "image/rgb.h"
#include "outline/faired_rim.h"
#include "outline/pixels.h"
#include "require.h"

namespace droplet {
namespace {

constexpr double kFull = 65535.0;

/// Pixels of a picture.
class Grid {
public:
    explicit Grid(const ColourRegions& regions) : width_(regions.width), height_(regions.height) {}

    /// Column of the pixel with an index.
    [[nodiscard]] int column(std::size_t i) const { return static_cast<int>(i % static_cast<std::size_t>(width_)); }
    [[nodiscard]] int row(std::size_t i) const { return static_cast<int>(i / static_cast<std::size_t>(width_)); }

    [[nodiscard]] std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    /// Calls a function with column and row of every pixel within a distance of one, along rows and columns.
    template <class Visit>
    void around(int x, int y, int reach, const Visit& visit) const
    {
        for (int v = std::max(0, y - reach); v <= std::min(height_ - 1, y + reach); ++v) {
            for (int u = std::max(0, x - reach); u <= std::min(width_ - 1, x + reach); ++u) {
                visit(u, v);
            }
        }
    }

private:
    int width_;
    int height_;
};

/// Gives regions smaller than a size to the neighbour with the longest common border.
class SpeckAbsorber {
public:
    SpeckAbsorber(const ColourRegions& regions, ColourDomain& report)
        : labels_(regions.label), grid_(regions), report_(report)
    {
    }

    std::vector<std::uint8_t> absorb(double speck_size)
    {
        constexpr int kRounds = 3;  // a speck may be absorbed by a speck
        bool changed = true;
        for (int round = 0; round < kRounds && changed; ++round) {
            changed = false;
            std::vector<std::uint8_t> seen(labels_.size(), 0);
            for (std::size_t i = 0; i < labels_.size(); ++i) {
                if (seen[i] == 0) {
                    changed = absorbFrom(i, speck_size, seen) || changed;
                }
            }
        }
        return std::move(labels_);
    }

private:
    bool absorbFrom(std::size_t start, double speck_size, std::vector<std::uint8_t>& seen)
    {
        const std::uint8_t label = labels_[start];
        std::vector<std::size_t> region{start};
        seen[start] = 1;
        std::map<std::uint8_t, std::size_t> neighbours;
        for (std::size_t k = 0; k < region.size(); ++k) {
            const int x = grid_.column(region[k]);
            const int y = grid_.row(region[k]);
            grid_.around(x, y, 1, [&](int u, int v) {
                const bool is_beside = (u == x) != (v == y);
                // Liquid is 8-connected, dry 4-connected.
                if ((u == x && v == y) || (label == 0 && !is_beside)) {
                    return;
                }
                const std::size_t there = grid_.at(u, v);
                if (labels_[there] != label) {
                    neighbours[labels_[there]] += is_beside ? 1 : 0;
                } else if (seen[there] == 0) {
                    seen[there] = 1;
                    region.push_back(there);
                }
            });
        }
        const auto area = static_cast<double>(region.size());
        if (area >= speck_size || neighbours.empty()) {
            return false;
        }
        const auto longest = std::max_element(neighbours.begin(), neighbours.end(),
                                              [](const auto& a, const auto& b) { return a.second < b.second; });
        for (const std::size_t i : region) {
            labels_[i] = longest->first;
        }
        ++report_.specks_dropped;
        report_.largest_speck_px = std::max(report_.largest_speck_px, area);
        return true;
    }

    std::vector<std::uint8_t> labels_;
    Grid grid_;
    ColourDomain& report_;
};

/// Share of one label's colour in the pixels beside its boundary with another label.
class PairCoverage {
public:
    PairCoverage(const ColourRegions& regions, const std::vector<std::uint8_t>& labels)
        : regions_(regions), labels_(labels), grid_(regions)
    {
    }

    /// @param right  0: dry
    [[nodiscard]] std::uint16_t share(int x, int y, std::uint8_t left, std::uint8_t right) const
    {
        const std::size_t i = grid_.at(x, y);
        if (right == 0) {
            return ofLiquid(x, y, left);
        }
        return level(regions_.mixture.empty() ? between(i, left, colourOf(right), right) : mixed(i, left, right));
    }

private:
    static std::uint16_t level(double share) { return static_cast<std::uint16_t>(std::lround(kFull * share)); }

    [[nodiscard]] Vec3 colourOf(std::uint8_t label) const { return vectorOf(regions_.palette[label - 1U].colour); }

    /// Place of a pixel's colour on the line from one colour to another.
    [[nodiscard]] double between(std::size_t i, std::uint8_t left, Vec3 other, std::uint8_t right) const
    {
        if (regions_.is_blend[i] == 0 && (labels_[i] == left || labels_[i] == right)) {
            return labels_[i] == left ? 1.0 : 0.0;
        }
        const Vec3 here = vectorOf(regions_.colour[i]);
        const Vec3 step = colourOf(left) - other;
        const double square = dot(step, step);
        return square > 0.0 ? std::clamp(dot(here - other, step) / square, 0.0, 1.0) : 0.0;
    }

    /// Share of one colour beside another one, from their exact areas.
    [[nodiscard]] double mixed(std::size_t i, std::uint8_t left, std::uint8_t right) const
    {
        constexpr double kWholePixel = 255.0;
        if (labels_[i] != left && labels_[i] != right) {
            return 0.5;
        }
        const PixelMixture& mixture = regions_.mixture[i];
        const bool is_mixed = labels_[i] == regions_.label[i] && mixture.other == (labels_[i] == left ? right : left);
        const double own = is_mixed ? mixture.share / kWholePixel : 1.0;
        return labels_[i] == left ? own : 1.0 - own;
    }

    /// Share of all liquid.
    [[nodiscard]] std::uint16_t ofLiquid(int x, int y, std::uint8_t left) const
    {
        const std::size_t i = grid_.at(x, y);
        if (!regions_.alpha.empty()) {
            return regions_.alpha[i];
        }
        if (regions_.is_blend[i] == 0 || !regions_.background) {
            return labels_[i] == 0 ? 0 : std::numeric_limits<std::uint16_t>::max();
        }
        bool is_near_dry = false;
        grid_.around(x, y, 2, [&](int u, int v) {
            const std::size_t j = grid_.at(u, v);
            is_near_dry = is_near_dry || (labels_[j] == 0 && regions_.is_blend[j] == 0);
        });
        if (labels_[i] != 0 && !is_near_dry) {
            return std::numeric_limits<std::uint16_t>::max();
        }
        return level(between(i, left, vectorOf(*regions_.background), 0));
    }

    const ColourRegions& regions_;
    const std::vector<std::uint8_t>& labels_;
    Grid grid_;
};

/// Faired arcs and the places of their junctions; pixels.
struct FairedArcs {
    std::vector<PixelLoop> arcs;  ///< without the junctions
    std::vector<Vec2> junctions;
    bool anti_aliased = false;
};

/// Fairs all arcs.
class ArcFairing {
public:
    ArcFairing(const ColourRegions& regions, const std::vector<std::uint8_t>& labels, const LabelArcs& arcs)
        : regions_(regions), coverage_(regions, labels), arcs_(arcs), faired_(arcs.arcs.size())
    {
    }

    FairedArcs run(bool corners)
    {
        std::map<std::pair<std::uint8_t, std::uint8_t>, std::vector<std::size_t>> pairs;
        for (std::size_t k = 0; k < arcs_.arcs.size(); ++k) {
            pairs[{arcs_.arcs[k].left, arcs_.arcs[k].right}].push_back(k);
        }
        FairedArcs result;
        for (const auto& [pair, members] : pairs) {
            fairPair(pair.first, pair.second, members, corners, result);
        }
        placeJunctions(result);
        for (std::size_t k = 0; k < faired_.size(); ++k) {
            if (arcs_.arcs[k].from) {
                faired_[k].ends = {result.junctions[*arcs_.arcs[k].from], result.junctions[*arcs_.arcs[k].to]};
            }
        }
        removeTouchingCorners(faired_);
        for (const CorneredLoop& arc : faired_) {
            result.arcs.push_back(withCorners(arc));
        }
        return result;
    }

private:
    void fairPair(std::uint8_t left, std::uint8_t right, const std::vector<std::size_t>& members, bool corners,
                  FairedArcs& result)
    {
        std::vector<Border> borders;
        borders.reserve(members.size());
        for (const std::size_t k : members) {
            borders.push_back(arcs_.arcs[k].crossings);
        }
        const Mask mask = maskOf(left, right, borders);
        const CoverageField field(mask, 0.5);
        const bool anti_aliased = looksAntiAliased(field, borders);
        result.anti_aliased = result.anti_aliased || anti_aliased;
        Coverage coverage;
        if (anti_aliased) {
            coverage = [&field](int x, int y) { return field.coverage(x, y); };
        }
        tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t i) {
            const LabelArc& arc = arcs_.arcs[members[i]];
            SlotLoop slots = placeSlots(field, arc.crossings, anti_aliased);
            loosenNearJunctions(arc, slots);
            const bool is_open = arc.from.has_value();
            CorneredLoop& faired = faired_[members[i]];
            if (corners || is_open) {
                faired = fairWithCorners(slots, coverage, is_open);
            } else {
                faired = fairWhole(std::move(slots));
            }
            if (!corners) {
                faired.corners.clear();
            }
            if (is_open) {
                keepAtBorder(faired);
            }
        });
    }

    /// Coverage around the borders of a pair of labels; 0 elsewhere.
    [[nodiscard]] Mask maskOf(std::uint8_t left, std::uint8_t right, const std::vector<Border>& borders) const
    {
        constexpr int kReach = 6;  // of measurement and of the search of corners [px]
        Mask mask;
        mask.width = regions_.width;
        mask.height = regions_.height;
        mask.coverage.assign(regions_.label.size(), 0);
        std::vector<std::uint8_t> done(regions_.label.size(), 0);
        const Grid grid(regions_);
        for (const Border& border : borders) {
            for (const Crossing& at : border) {
                grid.around(at.x, at.y, kReach, [&](int x, int y) {
                    const std::size_t i = grid.at(x, y);
                    if (done[i] == 0) {
                        done[i] = 1;
                        mask.coverage[i] = coverage_.share(x, y, left, right);
                    }
                });
            }
        }
        return mask;
    }

    [[nodiscard]] Vec2 middleOf(std::size_t junction) const
    {
        const LabelJunction& at = arcs_.junctions[junction];
        return {at.x + 1.0, at.y + 1.0};
    }

    [[nodiscard]] bool isAtBorder(const Slot& slot) const
    {
        const Vec2 outside = slot.liquid + slot.toward;
        return outside.x < 0.0 || outside.y < 0.0 || outside.x > regions_.width || outside.y > regions_.height;
    }

    /// Puts an arc exactly on the image's border and its corners, where it is too short for fairing to do so.
    void keepAtBorder(CorneredLoop& arc) const
    {
        for (Slot& slot : arc.slots) {
            slot.t = isAtBorder(slot) ? 0.5 : slot.t;
        }
        for (std::size_t i = 0; i + 1 < arc.slots.size(); ++i) {
            const Slot& slot = arc.slots[i];
            const Slot& next = arc.slots[i + 1];
            const bool turns = slot.liquid == next.liquid && dot(slot.toward, next.toward) == 0.0;
            const bool is_known = std::any_of(arc.corners.begin(), arc.corners.end(), [&](const Corner& corner) {
                return corner.turn.first <= i + 1 && corner.turn.last >= i;
            });
            if (turns && !is_known && isAtBorder(slot) && isAtBorder(next)) {
                arc.corners.push_back({{i, i + 1}, slot.liquid + 0.5 * (slot.toward + next.toward), false, false});
            }
        }
        std::sort(arc.corners.begin(), arc.corners.end(),
                  [](const Corner& a, const Corner& b) { return a.turn.first < b.turn.first; });
    }

    /// Pixels near a junction mix more than two colours.
    void loosenNearJunctions(const LabelArc& arc, SlotLoop& slots) const
    {
        constexpr double kNear = 3.0;           // [px]
        constexpr double kLooseSpread = 0.4;    // as beside a corner [px]
        constexpr double kBorderSpread = 0.01;  // places at the image's border are exact
        if (!arc.from) {
            return;
        }
        for (Slot& slot : slots) {
            const bool is_near =
                std::min(length(slot.point() - middleOf(*arc.from)), length(slot.point() - middleOf(*arc.to))) < kNear;
            if (is_near && slot.measured) {
                slot.spread = isAtBorder(slot) ? kBorderSpread : std::max(slot.spread, kLooseSpread);
            }
        }
    }

    /// End of an arc at a junction.
    struct ArcEnd {
        Vec2 at;
        Vec2 direction;  ///< unit, toward the junction; zero for a single slot
    };

    static ArcEnd endOf(const SlotLoop& slots, bool is_last)
    {
        constexpr double kLength = 4.0;  // [px]
        const std::size_t n = slots.size();
        const auto point = [&](std::size_t k) { return slots[is_last ? n - 1 - k : k].point(); };
        std::size_t k = 0;
        while (k + 1 < n && length(point(k) - point(0)) < kLength) {
            ++k;
        }
        const Vec2 along = point(0) - point(k);
        return {point(0), k == 0 ? Vec2{} : (1.0 / length(along)) * along};
    }

    /// Places every junction where the lines through its arcs' ends meet, within its square.
    void placeJunctions(FairedArcs& result) const
    {
        std::vector<std::vector<ArcEnd>> ends(arcs_.junctions.size());
        for (std::size_t k = 0; k < arcs_.arcs.size(); ++k) {
            if (arcs_.arcs[k].from) {
                ends[*arcs_.arcs[k].from].push_back(endOf(faired_[k].slots, false));
                ends[*arcs_.arcs[k].to].push_back(endOf(faired_[k].slots, true));
            }
        }
        constexpr double kPull = 1e-4;    // toward the ends themselves, relative to the lines
        constexpr double kMargin = 0.05;  // from the sides of the square [px]
        for (std::size_t j = 0; j < ends.size(); ++j) {
            // Normal equations of Σ (d × (p − a))² + kPull |p − a|²
            double xx = 0.0;
            double xy = 0.0;
            double yy = 0.0;
            Vec2 right{};
            for (const ArcEnd& end : ends[j]) {
                const Vec2 d = end.direction;
                const double a = d.y * d.y + kPull;
                const double b = -d.x * d.y;
                const double c = d.x * d.x + kPull;
                xx += a;
                xy += b;
                yy += c;
                right = right + Vec2{a * end.at.x + b * end.at.y, b * end.at.x + c * end.at.y};
            }
            const double determinant = xx * yy - xy * xy;
            const Vec2 place{(yy * right.x - xy * right.y) / determinant, (xx * right.y - xy * right.x) / determinant};
            const Vec2 middle = middleOf(j);
            const auto within = [](double value, double centre) {
                return std::clamp(value, centre - 0.5 + kMargin, centre + 0.5 - kMargin);
            };
            const LabelJunction& cell = arcs_.junctions[j];
            // Liquid that reaches the image's border ends there.
            const auto at_border = [](int first, int size, double border) {
                return first < 0 ? std::optional(0.0) : first + 1 == size ? std::optional(border) : std::nullopt;
            };
            result.junctions.push_back(
                {at_border(cell.x, regions_.width, regions_.width).value_or(within(place.x, middle.x)),
                 at_border(cell.y, regions_.height, regions_.height).value_or(within(place.y, middle.y))});
        }
    }

    const ColourRegions& regions_;
    PairCoverage coverage_;
    const LabelArcs& arcs_;
    std::vector<CorneredLoop> faired_;
};

/// Line with flags of its corners.
struct Line {
    std::vector<Vec2> points;
    std::vector<std::uint8_t> corner;
};

/// Draws a line with fewer points between two of its own, both kept: as few as the length and the bend of their chords
/// allow.
/// @return  indices of the kept points, after `begin`, up to `end`
std::vector<std::size_t> fewerPoints(const std::vector<Vec2>& points, std::size_t begin, std::size_t end, double edge)
{
    constexpr double kMaxSagitta = 0.15;  // [px]; nearer boundaries are rare
    constexpr double kMinSagitta = 0.05;  // error of traced places [px]
    constexpr double kMaxBend = 0.044;  // sagitta of an arc that turns by 0.35, relative to its chord, as of other rims
    std::vector<double> arc{0.0};
    for (std::size_t i = begin; i < end; ++i) {
        arc.push_back(arc.back() + length(points[i + 1] - points[i]));
    }
    const auto is_flat = [&](std::size_t from, std::size_t to) {
        const Vec2 chord = points[to] - points[from];
        const double size = length(chord);
        const double max = std::clamp(kMaxBend * size, kMinSagitta, kMaxSagitta);
        return std::all_of(points.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                           points.begin() + static_cast<std::ptrdiff_t>(to),
                           [&](Vec2 p) { return std::abs(cross(chord, p - points[from])) <= max * size; });
    };
    std::vector<std::size_t> kept;
    for (std::size_t from = begin; from < end;) {
        const double rest = arc.back() - arc[from - begin];
        const double target = arc[from - begin] + rest / std::max(1.0, std::round(rest / edge));
        std::size_t to = from + 1;
        while (to < end && std::abs(arc[to + 1 - begin] - target) <= std::abs(arc[to - begin] - target) &&
               is_flat(from, to + 1)) {
            ++to;
        }
        kept.push_back(to);
        from = to;
    }
    return kept;
}

/// The line with fewer points, all of which are corners.
/// @param is_closed  the line goes on from its last point to its first
Line coarser(Line line, double edge, bool is_closed)
{
    if (is_closed) {
        // It may begin at a corner, so that this stays.
        const auto corner = std::find(line.corner.begin(), line.corner.end(), 1) - line.corner.begin();
        const auto first = corner < static_cast<std::ptrdiff_t>(line.points.size()) ? corner : 0;
        std::rotate(line.points.begin(), line.points.begin() + first, line.points.end());
        std::rotate(line.corner.begin(), line.corner.begin() + first, line.corner.end());
        line.points.push_back(line.points.front());
        line.corner.push_back(1);
        double whole = 0.0;
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            whole += length(line.points[i] - line.points[i - 1]);
        }
        constexpr double kFewest = 8.0;
        edge = std::min(edge, whole / kFewest);
    }
    Line result{{line.points.front()}, {1}};
    for (std::size_t begin = 0; begin + 1 < line.points.size();) {
        std::size_t end = begin + 1;
        while (end + 1 < line.points.size() && line.corner[end] == 0) {
            ++end;
        }
        for (const std::size_t i : fewerPoints(line.points, begin, end, edge)) {
            result.points.push_back(line.points[i]);
            result.corner.push_back(1);
        }
        begin = end;
    }
    if (is_closed) {
        result.points.pop_back();
        result.corner.pop_back();
    }
    return result;
}

/// Arcs of a picture in their final place [px].
struct Boundaries {
    LabelArcs arcs;
    FairedArcs faired;

    /// Line of an arc with its junctions.
    /// @param with_folds  keep points so near to a junction that the line folds there
    [[nodiscard]] Line lineOf(std::size_t k, bool with_folds = false) const
    {
        Line line{faired.arcs[k].points, faired.arcs[k].corner};
        const LabelArc& arc = arcs.arcs[k];
        if (arc.from) {
            if (!with_folds) {
                dropFolded(line, faired.junctions[*arc.to], line.points.size() - 1);
                dropFolded(line, faired.junctions[*arc.from], 0);
            }
            line.points.insert(line.points.begin(), faired.junctions[*arc.from]);
            line.points.push_back(faired.junctions[*arc.to]);
            line.corner.insert(line.corner.begin(), 1);
            line.corner.push_back(1);
        }
        return line;
    }

    [[nodiscard]] bool isShared(std::size_t k) const { return arcs.arcs[k].right != 0; }

private:
    /// Drops the point at an end of a line if it is so near to the junction that the line would fold there.
    static void dropFolded(Line& line, Vec2 junction, std::size_t end)
    {
        constexpr double kNear = 0.4;  // [px]
        if (line.points.size() < 3) {
            return;
        }
        const Vec2 inner = line.points[end == 0 ? 1 : end - 1];
        const Vec2 out = line.points[end] - inner;
        const Vec2 on = junction - line.points[end];
        const double half = 0.5 * length(out) * length(on);  // cosine of 60 degrees
        if (length(on) < kNear && dot(out, on) < half) {
            line.points.erase(line.points.begin() + static_cast<std::ptrdiff_t>(end));
            line.corner.erase(line.corner.begin() + static_cast<std::ptrdiff_t>(end));
        }
    }
};

/// Line of a loop [px].
Line joined(const Boundaries& boundaries, const std::vector<Line>& lines, const LabelLoop& loop)
{
    Line result;
    for (const ArcUse& use : loop.arcs) {
        Line line = lines[use.arc];
        if (use.is_reversed) {
            std::reverse(line.points.begin(), line.points.end());
            std::reverse(line.corner.begin(), line.corner.end());
        }
        if (boundaries.arcs.arcs[use.arc].from) {
            line.points.pop_back();  // the next arc begins with it
            line.corner.pop_back();
        }
        result.points.insert(result.points.end(), line.points.begin(), line.points.end());
        result.corner.insert(result.corner.end(), line.corner.begin(), line.corner.end());
    }
    return result;
}

double areaOf(const Line& line)
{
    return signedArea(Loop{line.points, line.corner});
}

/// Lines that cross or touch one another, or themselves, between their ends.
class Crossings {
public:
    explicit Crossings(const Boundaries& boundaries, const std::vector<Line>& lines)
    {
        for (std::size_t k = 0; k < lines.size(); ++k) {
            const std::vector<Vec2>& points = lines[k].points;
            const bool is_closed = !boundaries.arcs.arcs[k].from.has_value();
            for (std::size_t i = is_closed ? 0 : 1; i < points.size(); ++i) {
                segments_.push_back({points[(i > 0 ? i : points.size()) - 1], points[i], k});
            }
        }
        for (std::size_t s = 0; s < segments_.size(); ++s) {
            const Segment& segment = segments_[s];
            const auto [left, right] = std::minmax({cellOf(segment.from.x), cellOf(segment.to.x)});
            const auto [top, bottom] = std::minmax({cellOf(segment.from.y), cellOf(segment.to.y)});
            for (std::int64_t y = top; y <= bottom; ++y) {
                for (std::int64_t x = left; x <= right; ++x) {
                    cells_.push_back({y * kRow + x, s});
                }
            }
        }
        std::sort(cells_.begin(), cells_.end());
    }

    /// Indices of the lines, ascending.
    [[nodiscard]] std::vector<std::size_t> lines() const
    {
        std::vector<std::size_t> found;
        for (auto begin = cells_.begin(); begin != cells_.end();) {
            const auto end = std::find_if(begin, cells_.end(), [&](const auto& c) { return c.first != begin->first; });
            for (auto a = begin; a != end; ++a) {
                for (auto b = a + 1; b != end; ++b) {
                    if (meet(segments_[a->second], segments_[b->second])) {
                        found.push_back(segments_[a->second].line);
                        found.push_back(segments_[b->second].line);
                    }
                }
            }
            begin = end;
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

private:
    struct Segment {
        Vec2 from;
        Vec2 to;
        std::size_t line = 0;
    };
    static constexpr std::int64_t kRow = std::int64_t{1} << 32;
    static constexpr double kCell = 4.0;  // [px]

    static std::int64_t cellOf(double at) { return static_cast<std::int64_t>(std::floor(at / kCell)); }

    static bool meet(const Segment& p, const Segment& q)
    {
        if (p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to) {
            return false;
        }
        const Vec2 u = p.to - p.from;
        const Vec2 v = q.to - q.from;
        return cross(u, q.from - p.from) * cross(u, q.to - p.from) <= 0.0 &&
               cross(v, p.from - q.from) * cross(v, p.to - q.from) <= 0.0;
    }

    std::vector<Segment> segments_;
    std::vector<std::pair<std::int64_t, std::size_t>> cells_;
};

/// Lines of all arcs; those between neighbours have only corners, at most about `edge` apart [px]. Where lines would
/// cross, or a loop is hardly longer than an edge, all points are kept.
std::vector<Line> linesOf(const Boundaries& boundaries, std::optional<double> edge)
{
    constexpr double kMaxChange = 0.1;  // of the area of a loop
    std::vector<Line> whole(boundaries.arcs.arcs.size());
    std::vector<Line> lines(whole.size());
    const auto all_corners = [&](Line line, std::size_t k) {
        if (boundaries.isShared(k)) {
            std::fill(line.corner.begin(), line.corner.end(), std::uint8_t{1});
        }
        return line;
    };
    tbb::parallel_for(std::size_t{0}, lines.size(), [&](std::size_t k) {
        lines[k] = boundaries.lineOf(k);
        whole[k] = all_corners(lines[k], k);
        lines[k] = edge && boundaries.isShared(k)
                       ? coarser(std::move(lines[k]), *edge, !boundaries.arcs.arcs[k].from.has_value())
                       : whole[k];
    });
    for (const LabelLoop& loop : boundaries.arcs.loops) {
        const double area = areaOf(joined(boundaries, whole, loop));
        if (std::abs(areaOf(joined(boundaries, lines, loop)) - area) > kMaxChange * std::abs(area)) {
            for (const ArcUse& use : loop.arcs) {
                lines[use.arc] = whole[use.arc];
            }
        }
    }
    std::vector<std::uint8_t> is_whole(lines.size(), 0);
    for (std::vector<std::size_t> crossing = Crossings(boundaries, lines).lines(); !crossing.empty();
         crossing = Crossings(boundaries, lines).lines()) {
        bool changed = false;
        for (const std::size_t k : crossing) {
            if (is_whole[k] < 2) {
                lines[k] = is_whole[k] == 0 ? whole[k] : all_corners(boundaries.lineOf(k, true), k);
                ++is_whole[k];
                changed = true;
            }
        }
        if (!changed) {
            break;
        }
    }
    return lines;
}

void addFootprints(const Outline& outline, std::size_t colour, ColourDomain& result)
{
    for (Footprint& footprint : split(outline).droplets) {
        result.domain.droplets.push_back(std::move(footprint));
        result.colour.push_back(colour);
    }
}

/// Footprints that meet at common boundaries.
void addTouching(const ColourRegions& regions, const Boundaries& boundaries, const ColourTraceOptions& options,
                 ColourDomain& result)
{
    const std::vector<Line> lines =
        linesOf(boundaries, options.edge ? std::optional(*options.edge / result.pixel_size) : std::nullopt);
    for (std::size_t k = 0; k < regions.palette.size(); ++k) {
        Outline outline;
        outline.extent = result.domain.extent;
        for (const LabelLoop& border : boundaries.arcs.loops) {
            if (border.label != k + 1) {
                continue;
            }
            Line line = joined(boundaries, lines, border);
            Loop loop{{}, std::move(line.corner)};
            for (const Vec2 p : line.points) {
                loop.points.push_back(placeOf(p, regions.width, regions.height, result.pixel_size));
            }
            outline.loops.push_back(std::move(loop));
        }
        if (outline.loops.empty()) {
            result.lost.push_back(k);
        } else {
            addFootprints(outline, k, result);
        }
    }
}

/// Distance of pixels from a label's boundaries with other liquid [px]; infinite beyond `reach`.
std::vector<float> distances(const ColourRegions& regions, const Boundaries& boundaries, std::uint8_t label,
                             double reach)
{
    std::vector<float> result(regions.label.size(), std::numeric_limits<float>::infinity());
    const Grid grid(regions);
    const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(reach / 8.0));
    const auto measure = [&](Vec2 a, Vec2 b) {
        const auto first = [&](double at) { return std::max(0, static_cast<int>(std::floor(at - reach))); };
        const auto last = [&](double at, int size) {
            return std::min(size - 1, static_cast<int>(std::floor(at + reach)));
        };
        const Vec2 along = b - a;
        const double square = dot(along, along);
        for (int y = first(std::min(a.y, b.y)); y <= last(std::max(a.y, b.y), regions.height); ++y) {
            for (int x = first(std::min(a.x, b.x)); x <= last(std::max(a.x, b.x), regions.width); ++x) {
                const Vec2 from = Vec2{x + 0.5, y + 0.5} - a;
                const double t = square > 0.0 ? std::clamp(dot(from, along) / square, 0.0, 1.0) : 0.0;
                float& here = result[grid.at(x, y)];
                here = std::min(here, static_cast<float>(length(from - t * along)));
            }
        }
    };
    for (std::size_t k = 0; k < boundaries.arcs.arcs.size(); ++k) {
        const LabelArc& arc = boundaries.arcs.arcs[k];
        if (arc.right == 0 || (arc.left != label && arc.right != label)) {
            continue;
        }
        std::vector<Vec2> points = boundaries.lineOf(k).points;
        if (!arc.from) {
            points.push_back(points.front());
        }
        for (std::size_t i = 0; i + 1 < points.size(); i += stride) {
            measure(points[i], points[std::min(i + stride, points.size() - 1)]);
        }
    }
    return result;
}

/// Footprints with a gap between neighbours.
void addApart(const ColourRegions& regions, const std::vector<std::uint8_t>& labels, const Boundaries& boundaries,
              const ColourTraceOptions& options, ColourDomain& result)
{
    const double half = 0.5 * options.gap / result.pixel_size;
    const PairCoverage coverage(regions, labels);
    const Grid grid(regions);
    TraceOptions trace_options = options.trace;
    trace_options.threshold = 0.5;
    trace_options.clean = {};
    trace_options.allow_dry = true;
    for (std::size_t k = 0; k < regions.palette.size(); ++k) {
        const auto label = static_cast<std::uint8_t>(k + 1);
        const std::vector<float> away = distances(regions, boundaries, label, half + 2.0);
        Mask mask;
        mask.width = regions.width;
        mask.height = regions.height;
        mask.raster_scale = regions.raster_scale;
        mask.coverage.assign(labels.size(), 0);
        tbb::parallel_for(0, mask.height, [&](int y) {
            for (int x = 0; x < mask.width; ++x) {
                const std::size_t i = grid.at(x, y);
                const bool is_other = labels[i] != label && labels[i] != 0;
                bool is_beside = labels[i] == label;
                if (labels[i] == 0) {
                    grid.around(x, y, 2,
                                [&](int u, int v) { is_beside = is_beside || labels[grid.at(u, v)] == label; });
                }
                if (!is_beside && !(is_other && std::isfinite(away[i]))) {
                    continue;
                }
                const double own = is_other ? 1.0 : coverage.share(x, y, label, 0) / kFull;
                const double distance = is_other ? -static_cast<double>(away[i]) : static_cast<double>(away[i]);
                mask.coverage[i] = static_cast<std::uint16_t>(
                    std::lround(kFull * std::min(own, std::clamp(distance - half + 0.5, 0.0, 1.0))));
            }
        });
        const Outline outline = trace(mask, trace_options);
        result.anti_aliased = result.anti_aliased || outline.anti_aliased;
        if (outline.loops.empty()) {
            result.lost.push_back(k);
        } else {
            addFootprints(outline, k, result);
        }
    }
}

}  // namespace

void ColourTraceOptions::validate() const
{
    trace.validate();
    require(gap >= 0.0 && std::isfinite(gap), "gap", gap, "finite and at least 0 m");
    if (edge) {
        require(*edge > 0.0 && std::isfinite(*edge), "edge", *edge, "finite and more than 0 m");
    }
}

double pixelSize(const ColourRegions& regions, const TraceOptions& options)
{
    return pixelSize(regions.width, regions.raster_scale, options);
}

ColourDomain traceColours(const ColourRegions& regions, const ColourTraceOptions& options)
{
    options.validate();
    ColourDomain result;
    result.pixel_size = pixelSize(regions, options.trace);
    result.domain.extent = {regions.width * result.pixel_size, regions.height * result.pixel_size};
    const std::vector<std::uint8_t> labels = SpeckAbsorber(regions, result).absorb(options.trace.speck_size);
    const LabelView view{regions.width, regions.height, labels};
    Boundaries boundaries{followLabels(view), {}};
    boundaries.faired = ArcFairing(regions, labels, boundaries.arcs).run(options.trace.corners);
    result.anti_aliased = boundaries.faired.anti_aliased;
    if (options.gap > 0.0) {
        addApart(regions, labels, boundaries, options, result);
    } else {
        addTouching(regions, boundaries, options, result);
    }
    if (result.domain.droplets.empty()) {
        throw Error(ErrorCode::InvalidInput,
                    options.gap > 0.0
                        ? "no region of the picture is wider than the gap"
                        : "only specks in the picture: the largest of " + std::to_string(result.specks_dropped) +
                              " has " + std::to_string(static_cast<long>(result.largest_speck_px)) + " pixels");
    }
    return result;
}

}  // namespace droplet
