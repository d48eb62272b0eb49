// SPDX-License-Identifier: GPL-3.0-or-later
//
// Level rises from the lowest place near the droplet, and faces are flooded in the order of the edges that it passes
// (priority flood: R. Barnes, C. Lehman, D. Mulla, Computers & Geosciences 62 (2014) 117), until a face beyond leads
// down, or the hollow is known to hold the liquid. Where the ground beyond is part of a larger hollow, and the liquid
// suffices to fill it up to this edge, the flood goes on: bumps of its bottom are below the level.
#include "flow/hollow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "droplet/wind/forces.h"
#include "flow/flooded_part.h"
#include "flow/flow_terrain_content.h"
#include "flow/puddle.h"

namespace droplet {
namespace {

// A hollow shallower than this share of the droplet's radius is none, as for hops (walk.cpp).
constexpr double kShallow = 2e-3;
// Faces after which it is asked first whether the hollow holds the liquid; then after twice as many, and so on.
constexpr std::size_t kFirstCheck = 16;
// Hollows with more faces are not followed to their end: they hold the liquid.
constexpr std::size_t kMostFaces = 1'000'000;
// Of a normal's parts.
constexpr double kRounding = 1e-9;

using Heights = std::array<double, 3>;

struct FloodedFace {
    std::uint32_t face = 0;
    Heights heights = {};  ///< ascending
    double area = 0.0;     ///< seen from above; negative where it overhangs
};

/// An edge that the level may pass.
struct Pass {
    /// Of its lower and its upper end, in parts of the slack: rounding must not choose between edges of one height. Of
    /// edges that meet in a corner, level ones come first.
    std::array<double, 2> rank = {};
    std::uint32_t face = 0;  ///< before it
    std::uint32_t side = 0;
    double height = 0.0;  ///< of its lower end
    double top = 0.0;
    friend bool operator>(const Pass& a, const Pass& b)
    {
        return std::tie(a.rank, a.face, a.side) > std::tie(b.rank, b.face, b.side);
    }
};

class Flood {
public:
    Flood(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
        : surface_(surface), faces_(surface.faces), up_(up), liquid_(liquid), slack_(kShallow * liquid.radius)
    {
    }

    Hollow run()
    {
        const End end = flood([&] { return heldBy(filled()) >= liquid_.volume ? Known::Enough : Known::Nothing; });
        if (end.pass) {
            return over(*end.pass);
        }
        return {std::nullopt, end.is_enough ? heldBy(filled()) : liquid_.volume};
    }

    std::optional<FilledHollow> pond()
    {
        if (!reachesBottom(liquid_.face, dot(up_, liquid_.place))) {
            return std::nullopt;
        }
        const double thick = thicknessOf(liquid_);
        const double flat = flatArea(liquid_);
        const End end = flood([&] {
            const Flooded water = filled();
            if (water.volume >= liquid_.volume) {
                return Known::Enough;
            }
            // Higher levels have no smaller area: so much would it hold when it is as deep as the liquid is thick.
            const double least = water.volume + water.area * (deepest() + thick - level_);
            return water.area > flat && least > liquid_.volume ? Known::Spreads : Known::Nothing;
        });
        if (!end.is_enough && !end.pass && !end.spreads) {
            return std::nullopt;
        }
        std::optional<FilledHollow> whole = end.spreads ? std::nullopt : fillFrom(end);
        if (whole && level_ - deepest() >= thick) {
            return whole;
        }
        const Puddle puddle = puddleAround(surface_, up_, liquid_);
        if (puddle.pond) {
            return FilledHollow{*puddle.pond, {}};
        }
        return whole && (puddle.is_blocked || whole->pond.area <= flat) ? whole : std::nullopt;
    }

private:
    /// Why a flood ended; neither: nothing is known.
    struct End {
        std::optional<Pass> pass = {};  ///< the liquid would run over there
        bool is_enough = false;         ///< the hollow takes up all liquid
        bool spreads = false;           ///< on flat ground it would cover less
    };

    /// What is known of the liquid at a level.
    enum class Known {
        Nothing,
        Enough,   ///< the hollow takes it up
        Spreads,  ///< on flat ground it would cover less: it does not fill the hollow
    };

    /// Raises the level.
    /// @param ask  for what is known, from time to time
    template <typename Ask>
    End flood(const Ask& ask)
    {
        if (!begin(liquid_.face, dot(up_, liquid_.place))) {
            return {};
        }
        std::size_t check = kFirstCheck;
        while (!passes_.empty()) {
            const Pass pass = passes_.top();
            if (!exits_.empty() && pass.height > bottom_ + slack_) {
                break;
            }
            passes_.pop();
            const std::uint32_t next = faces_[pass.face].neighbour[pass.side];
            if (next != FlowSurface::kNone && is_flooded_.contains(next)) {
                continue;
            }
            level_ = std::max(level_, pass.height);
            if (flooded_.size() >= check) {
                const Known known = ask();
                if (known == Known::Spreads) {
                    return {{}, false, true};
                }
                if (flooded_.size() > kMostFaces) {
                    return {};
                }
                if (known == Known::Enough) {
                    return {{}, true, false};
                }
                check *= 2;
            }
            if (next != FlowSurface::kNone && heightsOf(next)[lowestOf(next)] >= level_ - slack_) {
                flood(next);
            } else if (level_ - bottom_ > slack_) {
                if (ask() == Known::Enough) {
                    return {{}, true, false};
                }
                if (!joins(next)) {
                    return {pass, false, false};
                }
            } else if (is_flat_ && isEdge(next)) {
                exits_.push_back(pass);  // the whole flat counts, as a puddle on a plate does
            } else if (next == FlowSurface::kNone || !begin(next, level_)) {
                return {};
            }
        }
        if (exits_.empty()) {
            return {};
        }
        return {*nearestExit(), false, false};
    }

    /// Floods the ground beyond a pass as well, up to the level, if it is in the same hollow and the liquid suffices.
    /// Otherwise all is as before.
    bool joins(std::uint32_t beyond)
    {
        if (beyond == FlowSurface::kNone) {
            return false;
        }
        const std::size_t before = flooded_.size();
        const auto passes = passes_;
        const auto back = [&] {
            for (std::size_t k = before; k < flooded_.size(); ++k) {
                is_flooded_.erase(flooded_[k].face);
            }
            flooded_.resize(before);
            passes_ = passes;
            return false;
        };
        std::vector<std::uint32_t> open{beyond};
        for (std::size_t check = flooded_.size() + kFirstCheck; !open.empty();) {
            const std::uint32_t face = open.back();
            open.pop_back();
            if (is_flooded_.contains(face)) {
                continue;
            }
            // Overhanging ground is the outside of what holds the liquid.
            if (dot(faces_[face].normal, up_) < -kRounding || flooded_.size() > kMostFaces) {
                return back();
            }
            flood(face);
            if (flooded_.size() >= check) {
                if (filled().volume > liquid_.volume) {
                    return back();
                }
                check *= 2;
            }
            const Heights heights = heightsOf(face);
            for (std::size_t side = 0; side < 3; ++side) {
                if (std::min(heights[side], heights[(side + 1) % 3]) <= level_) {
                    const std::uint32_t next = faces_[face].neighbour[side];
                    if (next == FlowSurface::kNone) {
                        return back();
                    }
                    open.push_back(next);
                }
            }
        }
        return filled().volume <= liquid_.volume || back();
    }

    /// The pond that fills the hollow, after a flood; empty if most of the liquid runs over, or the hollow has no
    /// depth.
    std::optional<FilledHollow> fillFrom(const End& end)
    {
        const Flooded brim = filled();
        FilledHollow made;
        if (brim.volume >= liquid_.volume) {
            sinkTo(liquid_.volume);
        } else {
            made.pond.dome = liquid_.volume - brim.volume;
            if (heldBy(brim) < liquid_.volume && made.pond.dome > brim.volume) {
                return std::nullopt;
            }
            if (const std::uint32_t next = faces_[end.pass->face].neighbour[end.pass->side];
                next != FlowSurface::kNone) {
                made.beyond = next;
            }
        }
        std::erase_if(flooded_, [&](const FloodedFace& face) { return face.heights.front() >= level_; });
        const Flooded water = filled();
        if (!(level_ - deepest() > slack_) || !(water.area > 0.0)) {
            return std::nullopt;
        }
        made.pond.up = up_;
        made.pond.level = level_;
        made.pond.area = water.area;
        made.pond.bending = liquid_.puddle / (2.0 * std::sin(0.5 * liquid_.contact_angle));
        for (const FloodedFace& face : flooded_) {
            made.pond.faces.push_back(face.face);
        }
        std::sort(made.pond.faces.begin(), made.pond.faces.end());
        return made;
    }

    /// Lowers the level to where what is below it is a volume: by Newton's method, or halves where walls lean inward
    /// and its step would be too long.
    void sinkTo(double volume)
    {
        double low = deepest();
        double high = level_;
        for (;;) {
            level_ = high;
            const Flooded above = filled();
            const double step = above.area > 0.0 ? (above.volume - volume) / above.area : 0.0;
            level_ = high - step > low ? high - step : 0.5 * (low + high);
            if (!(level_ < high && level_ > low)) {
                break;
            }
            if (filled().volume >= volume) {
                high = level_;
            } else {
                low = level_;
                const double middle = 0.5 * (low + high);
                level_ = middle;
                if (!(middle > low && middle < high)) {
                    break;
                }
                (filled().volume >= volume ? high : low) = middle;
            }
        }
        level_ = high;
    }

    /// Height of the lowest ground of the flood.
    [[nodiscard]] double deepest() const
    {
        double low = std::numeric_limits<double>::infinity();
        for (const FloodedFace& face : flooded_) {
            low = std::min(low, face.heights.front());
        }
        return low;
    }

    [[nodiscard]] Heights heightsOf(std::uint32_t face) const
    {
        const auto& [a, b, c] = faces_[face].corners;
        return {dot(up_, a), dot(up_, b), dot(up_, c)};
    }

    [[nodiscard]] std::size_t lowestOf(std::uint32_t face) const
    {
        const Heights heights = heightsOf(face);
        return static_cast<std::size_t>(std::min_element(heights.begin(), heights.end()) - heights.begin());
    }

    /// Whether the droplet reaches the bottom of a face: otherwise it rests on a slope.
    /// @param height  of the droplet, or of the last bottom
    [[nodiscard]] bool reachesBottom(std::uint32_t face, double height) const
    {
        const Vec3 corner = faces_[face].corners[lowestOf(face)];
        return height - dot(up_, corner) <= slack_ || length(corner - liquid_.place) <= liquid_.radius;
    }

    /// Begins at the bottom of a face, if the droplet reaches it.
    /// @param height  of the droplet, or of the last bottom
    bool begin(std::uint32_t face, double height)
    {
        if (!reachesBottom(face, height)) {
            return false;
        }
        bottom_ = std::min(height, heightsOf(face)[lowestOf(face)]);
        level_ = bottom_;
        constexpr double kLevel = 0.9994;  // cosine of 2°
        is_flat_ = height - bottom_ <= slack_ && dot(faces_[face].normal, up_) >= kLevel;
        exits_.clear();
        flooded_.clear();
        is_flooded_.clear();
        passes_ = {};
        flood(face);
        return true;
    }

    void flood(std::uint32_t face)
    {
        is_flooded_.insert(face);
        const Heights heights = heightsOf(face);
        FloodedFace flooded{face, heights, dot(faces_[face].normal, up_) * areaOf(faces_[face])};
        std::sort(flooded.heights.begin(), flooded.heights.end());
        flooded_.push_back(flooded);
        for (std::uint32_t side = 0; side < 3; ++side) {
            const auto [low, high] = std::minmax(heights[side], heights[(side + 1) % 3]);
            const double ground = dot(up_, liquid_.place);
            passes_.push({{ranked(low - ground), ranked(high - ground)}, face, side, low, high});
        }
    }

    [[nodiscard]] Flooded filled() const
    {
        Flooded sum;
        for (const FloodedFace& face : flooded_) {
            const Flooded part = floodedPart(face.heights, face.area, level_);
            sum.area += part.area;
            sum.volume += part.volume;
        }
        return {std::max(sum.area, 0.0), std::max(sum.volume, 0.0)};
    }

    /// Volume up to the level, and what surface tension holds above it.
    [[nodiscard]] double heldBy(const Flooded& sum) const
    {
        const double cap = capVolume(std::sqrt(sum.area / std::numbers::pi), liquid_.contact_angle);
        return sum.volume + std::min(sum.area * liquid_.puddle, cap);
    }

    /// Whether level ground ends where another face, or nothing, follows; ground that slopes a little does not.
    [[nodiscard]] bool isEdge(std::uint32_t next) const
    {
        constexpr double kSteep = 0.87;  // cosine of 30°
        return next == FlowSurface::kNone || dot(faces_[next].normal, up_) < kSteep;
    }

    [[nodiscard]] double ranked(double length) const
    {
        constexpr double kParts = 100.0;
        return std::round(length * kParts / slack_);
    }

    /// Middle of a level edge, or the lower end of one.
    [[nodiscard]] Vec3 placeOf(const Pass& pass) const
    {
        const FlowSurface::Face& face = faces_[pass.face];
        const Vec3 a = face.corners[pass.side];
        const Vec3 b = face.corners[(pass.side + 1) % 3];
        return pass.top - pass.height <= slack_ ? 0.5 * (a + b) : dot(up_, a) <= dot(up_, b) ? a : b;
    }

    [[nodiscard]] std::vector<Pass>::const_iterator nearestExit() const
    {
        return std::min_element(exits_.begin(), exits_.end(), [&](const Pass& a, const Pass& b) {
            return ranked(length(placeOf(a) - liquid_.place)) < ranked(length(placeOf(b) - liquid_.place));
        });
    }

    [[nodiscard]] Hollow over(const Pass& pass) const
    {
        const Flooded sum = filled();
        const double held = heldBy(sum);
        if (held >= liquid_.volume) {
            return {std::nullopt, held};
        }
        const FlowSurface::Face& from = faces_[pass.face];
        const std::uint32_t next = from.neighbour[pass.side];
        const bool is_open = next == FlowSurface::kNone;
        Brim result{is_open ? pass.face : next, placeOf(pass), {}, is_open, sum.volume, held};
        const Vec3 way = is_open ? -1.0 * from.inward[pass.side] : faces_[next].corners[lowestOf(next)] - result.place;
        result.ahead = (1.0 / length(way)) * way;
        return {result, 0.0};
    }

    const FlowSurface& surface_;
    const std::vector<FlowSurface::Face>& faces_;
    Vec3 up_;
    const RestingLiquid& liquid_;
    double slack_;          ///< [m]
    bool is_flat_ = false;  ///< the droplet lies on level ground
    double bottom_ = 0.0;
    double level_ = 0.0;
    std::vector<FloodedFace> flooded_;
    std::unordered_set<std::uint32_t> is_flooded_;
    std::vector<Pass> exits_;  ///< downward from level ground
    std::priority_queue<Pass, std::vector<Pass>, std::greater<>> passes_;
};

/// Whether liquid is below its ground: it lies in no hollow, whatever rises around it.
bool hangs(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
{
    return !(dot(surface.faces[liquid.face].normal, up) > 0.0);
}

}  // namespace

Hollow hollowAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
{
    if (hangs(surface, up, liquid)) {
        return {std::nullopt, liquid.volume};
    }
    return Flood(surface, up, liquid).run();
}

std::optional<FilledHollow> pondAround(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
{
    if (hangs(surface, up, liquid)) {
        return std::nullopt;
    }
    return Flood(surface, up, liquid).pond();
}

}  // namespace droplet
