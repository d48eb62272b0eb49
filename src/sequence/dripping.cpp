// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much hangs is solved for. How much of it falls is not a question of rest: it is measured, W. D. Harkins and
// F. E. Brown, "The determination of surface tension (free surface energy), and the weight of falling drops", J. Am.
// Chem. Soc. 41 (1919) 499, as a fraction f of T. Tate's weight 2πrσ ("On the magnitude of a drop of liquid formed
// under different circumstances", Phil. Mag. 27 (1864) 176), by r/V^⅓ of the drop.
#include "droplet/sequence/dripping.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/units.h"
#include "number_text.h"
#include "require.h"

namespace droplet {
namespace {

using std::numbers::pi;

/// A disc of radius r from which drops fall; volumes over the cube of the capillary length a.
struct Tip {
    double largest = 0.0;  ///< that hangs: the equation of Young and Laplace, integrated from the apex (J. F. Padday
                           ///< and A. R. Pitt, Phil. Trans. R. Soc. A 275 (1973) 489)
    double share = 0.0;    ///< that falls: 2πr f(r/V^⅓)/largest
};

/// r/a is 0.3, 0.37, 0.5, 0.71, 0.9, 1.1, 1.3, 1.5, 1.83, 2.2, 2.6 and 3.2. Below, f has no measurements, and the share
/// stays; a wider disc holds no more.
constexpr std::array kTips{Tip{1.444, 0.981}, Tip{1.749, 0.950},  Tip{2.386, 0.905},  Tip{3.477, 0.834},
                           Tip{4.621, 0.768}, Tip{5.934, 0.713},  Tip{7.362, 0.668},  Tip{8.882, 0.636},
                           Tip{11.53, 0.604}, Tip{14.379, 0.599}, Tip{17.036, 0.623}, Tip{18.962, 0.644}};

/// Ball of radius 1: an icosahedron whose triangles are divided into four, three times; 1280 triangles.
struct Ball {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    double volume = 0.0;
};

Ball makeBall()
{
    const double golden = std::numbers::phi;
    Ball ball;
    for (const double one : {-1.0, 1.0}) {
        for (const double other : {-golden, golden}) {
            ball.vertices.insert(ball.vertices.end(), {{0.0, one, other}, {one, other, 0.0}, {other, 0.0, one}});
        }
    }
    for (Vec3& vertex : ball.vertices) {
        vertex = 1.0 / length(vertex) * vertex;
    }
    // Its faces are three vertices that are neighbours, at the distance of an edge.
    const double edge = 2.0 / std::sqrt(1.0 + golden * golden);
    const auto are_near = [&](std::uint32_t a, std::uint32_t b) {
        return length(ball.vertices[a] - ball.vertices[b]) < 1.1 * edge;
    };
    const auto count = static_cast<std::uint32_t>(ball.vertices.size());
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
            for (std::uint32_t c = b + 1; c < count; ++c) {
                if (are_near(a, b) && are_near(b, c) && are_near(c, a)) {
                    const Vec3 up = cross(ball.vertices[b] - ball.vertices[a], ball.vertices[c] - ball.vertices[a]);
                    const bool is_outward = dot(up, ball.vertices[a]) > 0.0;
                    ball.triangles.push_back(is_outward ? Triangle{a, b, c} : Triangle{a, c, b});
                }
            }
        }
    }
    for (int level = 0; level < 3; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(ball.vertices.size()));
            if (is_new) {
                const Vec3 sum = ball.vertices[a] + ball.vertices[b];
                ball.vertices.push_back(1.0 / length(sum) * sum);
            }
            return found->second;
        };
        std::vector<Triangle> finer;
        finer.reserve(4 * ball.triangles.size());
        for (const auto& [a, b, c] : ball.triangles) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        ball.triangles = std::move(finer);
    }
    for (const auto& [a, b, c] : ball.triangles) {
        ball.volume += dot(ball.vertices[a], cross(ball.vertices[b], ball.vertices[c])) / 6.0;
    }
    return ball;
}

double radiusOf(double volume)
{
    return std::cbrt(volume * 3.0 / (4.0 * pi));
}

/// Adds drops to a surface.
void addDrops(const Frame& frame, Vec2 extent, Surface& surface)
{
    static const Ball ball = makeBall();
    for (std::size_t k = 0; k < frame.falling.size(); ++k) {
        const FallingDrop& drop = frame.falling[k];
        const double scale = std::cbrt(drop.volume / ball.volume);
        const auto first = static_cast<std::uint32_t>(surface.vertices.size());
        const double radius = radiusOf(drop.volume);
        surface.parts.push_back({.droplet = frame.droplets.size() + k,
                                 .first_vertex = first,
                                 .vertices = ball.vertices.size(),
                                 .first_triangle = surface.triangles.size(),
                                 .triangles = ball.triangles.size(),
                                 .quads = 0,
                                 .volume = drop.volume,
                                 .area = pi * radius * radius});
        for (const Vec3& direction : ball.vertices) {
            const Vec3 place = drop.place() + scale * direction;
            surface.weld.push_back(static_cast<std::uint32_t>(surface.vertices.size()));
            surface.vertices.push_back(place);
            surface.normals.push_back(direction);
            surface.uvs.push_back({place.x / extent.x, 1.0 - place.y / extent.y});
        }
        if (!surface.contact_angle.empty()) {
            surface.contact_angle.resize(surface.vertices.size(), 0.0F);
        }
        for (const auto& [a, b, c] : ball.triangles) {
            surface.triangles.push_back({first + a, first + b, first + c});
        }
    }
}

/// Lowest place under the ceiling of a droplet.
Vec3 lowestOf(const Surface& surface, std::size_t droplet)
{
    const auto part = std::find_if(surface.parts.begin(), surface.parts.end(),
                                   [&](const SurfacePart& one) { return one.droplet == droplet; });
    const auto begin = surface.vertices.begin() + static_cast<std::ptrdiff_t>(part->first_vertex);
    return *std::max_element(begin, begin + static_cast<std::ptrdiff_t>(part->vertices),
                             [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
}

/// Requires that gravity ends what hangs, and not the solver. By Tate's law, with the smallest share of it that hangs
/// from any disc, a footprint that is everywhere as wide as two discs of radius r = area/rim holds more than one of
/// them.
/// @throws Error NoSuchDroplet
void requireHeavy(const ShapeFigures& figures, double capillary_length, std::size_t droplet, std::size_t count)
{
    constexpr double kLeast = 0.75;  // of 2πra²: the least of all discs is 0.76, at r = 0.43 a
    const double least =
        kLeast * 2.0 * pi * (figures.footprint_area / figures.rim_length) * capillary_length * capillary_length;
    if (figures.volume < least) {
        throw Error(
            ErrorCode::NoSuchDroplet,
            (count == 1 ? "" : fmt::format("droplet {} of {}: ", droplet + 1, count)) +
                fmt::format("its largest volume was not found: more than {} uL should hang, but solutions end at "
                            "{} uL; use more triangles, or a smoother or larger footprint",
                            numberText(least / kMicrolitre, 3), numberText(figures.volume / kMicrolitre, 3)));
    }
}

/// Refuses an inflow that sheds so many drops in a step that no volume is found that hangs after them. Where one falls
/// at most, what stays is far from what can hang.
/// @param drops  largest number of them that fall off one droplet in the step
/// @throws Error NoSuchDroplet
[[noreturn]] void refuseInflow(const DrippingOptions& dripping, std::size_t drops)
{
    const auto parts = static_cast<double>(std::max<std::size_t>(drops, 2));
    const double most = dripping.inflow / parts / kMicrolitre;
    const double unit = std::pow(10.0, std::floor(std::log10(most)) - 1.0);  // of two digits, rounded down
    throw Error(ErrorCode::NoSuchDroplet,
                fmt::format("inflow of {} uL/s is too much: {} {} off one droplet in a step of {} s, and no volume was "
                            "found that hangs after that; let less flow in, {} uL/s at most, or take shorter steps",
                            numberText(dripping.inflow / kMicrolitre), drops, drops == 1 ? "drop falls" : "drops fall",
                            numberText(dripping.time_step, 3), numberText(std::floor(most / unit) * unit)));
}

/// Droplet that grows for a step.
class Growth {
public:
    Growth(double volume, double inflow, double step) : begin_(volume), volume_(volume), inflow_(inflow), step_(step)
    {
        volume_ += inflow_ * step_;
    }

    /// Volume at the end of the step.
    [[nodiscard]] double volume() const { return volume_; }

    /// Sheds drops whenever the droplet is as large as can hang.
    /// @return  for each drop: time since it left at the end of the step [s]
    std::vector<double> shed(double largest, double drop)
    {
        std::vector<double> since;
        volume_ = begin_;
        double time = 0.0;
        while (volume_ + inflow_ * (step_ - time) > largest) {
            time = std::min(time + std::max(largest - volume_, 0.0) / inflow_, step_);
            volume_ = largest - drop;
            since.push_back(step_ - time);
        }
        // What does not add up because the droplet was over its limit from the start stays in it.
        volume_ = begin_ + inflow_ * step_ - static_cast<double>(since.size()) * drop;
        return since;
    }

private:
    double begin_ = 0.0;
    double volume_ = 0.0;
    double inflow_ = 0.0;
    double step_ = 0.0;
};

}  // namespace

void DrippingOptions::validate() const
{
    require(inflow > 0.0 && std::isfinite(inflow), "inflow", inflow, "finite and more than 0 m³/s");
    require(time_step > 0.0 && std::isfinite(time_step), "time_step", time_step, "finite and more than 0 s");
    require(way > 0.0 && std::isfinite(way), "way", way, "finite and more than 0 m");
}

double fallingShare(double largest, double capillary_length)
{
    require(largest > 0.0, "largest", largest, "more than 0 m³");
    require(capillary_length > 0.0, "capillary_length", capillary_length, "more than 0 m");
    const double volume = largest / (capillary_length * capillary_length * capillary_length);
    const auto above = std::find_if(kTips.begin(), kTips.end(), [&](const Tip& tip) { return tip.largest >= volume; });
    if (above == kTips.begin() || above == kTips.end()) {
        return above == kTips.begin() ? above->share : kTips.back().share;
    }
    const Tip& below = *std::prev(above);
    return std::lerp(below.share, above->share, (volume - below.largest) / (above->largest - below.largest));
}

Frame nextDripping(const Frame& before, const Outline& outline, const SequenceOptions& options,
                   const DrippingOptions& dripping, const Progress& progress)
{
    dripping.validate();
    constexpr double kAcross = 1e-9;  // sin π is not exactly 0
    const PlaneGravity gravity = planeGravity(options.droplet.solve);
    const std::optional<double> capillary_length = capillaryLength(options.droplet.solve.liquid, -gravity.normal);
    if (options.volume_mode != VolumeMode::Track) {
        throw Error(ErrorCode::InvalidArgument, "volume_mode must be track: every droplet has its own amount");
    }
    if (!(gravity.normal < 0.0) || length(gravity.along) > -kAcross * gravity.normal || !capillary_length) {
        throw Error(ErrorCode::InvalidArgument,
                    "drops fall from a level ceiling: tilt must be 180 degrees, or gravity "
                    "negative, and the liquid must have a weight");
    }
    SequenceOptions own = options;
    own.hold = false;
    own.droplet.allow_less = true;

    double area = 0.0;
    for (const ShapeFigures& figures : before.droplet.figures) {
        area += figures.footprint_area;
    }
    std::vector<Growth> growths;
    growths.reserve(before.droplets.size());
    for (std::size_t k = 0; k < before.droplets.size(); ++k) {
        const double share = before.droplet.figures[k].footprint_area / area;
        growths.emplace_back(before.droplets[k].volume, share * dripping.inflow, dripping.time_step);
    }

    Frame start = before;
    std::vector<FallingDrop> shed;
    Frame next;
    // The second time, the droplets that shed drops have what is left; the third time, if less was found to hang.
    constexpr int kMost = 3;
    for (int k = 0;; ++k) {
        for (std::size_t i = 0; i < growths.size(); ++i) {
            start.droplets[i].volume = growths[i].volume();
        }
        next = nextFrame(start, outline, own, progress);
        std::vector<std::size_t> too_heavy;
        for (std::size_t i = 0; i < next.droplets.size(); ++i) {
            if (next.droplet.limits[i] == FillLimit::Existence) {
                too_heavy.push_back(i);
            }
        }
        if (too_heavy.empty()) {
            break;
        }
        if (k + 1 == kMost) {
            std::size_t most = 1;
            for (const Ancestry& droplet : next.droplets) {
                const auto fell = std::count_if(shed.begin(), shed.end(),
                                                [&](const FallingDrop& drop) { return drop.droplet == droplet.id; });
                most = std::max(most, static_cast<std::size_t>(fell));
            }
            refuseInflow(dripping, most);
        }
        for (const std::size_t i : too_heavy) {
            requireHeavy(next.droplet.figures[i], *capillary_length, i, next.droplets.size());
            const double largest = next.droplet.figures[i].volume;
            const double drop = fallingShare(largest, *capillary_length) * largest;
            const Vec3 lowest = lowestOf(next.droplet.surface, i);
            std::erase_if(shed, [&](const FallingDrop& one) { return one.droplet == next.droplets[i].id; });
            for (const double since : growths[i].shed(largest, drop)) {
                shed.push_back({.droplet = next.droplets[i].id,
                                .volume = drop,
                                .start = {lowest.x, lowest.y, lowest.z - radiusOf(drop)},
                                .since = since,
                                .gravity = -gravity.normal});
            }
        }
    }

    // The neck breaks below what stays, so no ball begins in it.
    for (FallingDrop& drop : shed) {
        const auto droplet = std::find_if(next.droplets.begin(), next.droplets.end(),
                                          [&](const Ancestry& one) { return one.id == drop.droplet; });
        const auto index = static_cast<std::size_t>(droplet - next.droplets.begin());
        drop.start.z = std::max(drop.start.z, lowestOf(next.droplet.surface, index).z + radiusOf(drop.volume));
    }

    next.volume_gained = dripping.inflow * dripping.time_step;
    next.volume_lost = 0.0;
    next.drops_shed = before.drops_shed + shed.size();
    for (FallingDrop drop : before.falling) {
        drop.since += dripping.time_step;
        next.falling.push_back(drop);
    }
    next.falling.insert(next.falling.end(), shed.begin(), shed.end());
    std::erase_if(next.falling, [&](const FallingDrop& drop) {
        const bool is_gone = drop.place().z - drop.start.z > dripping.way;
        next.volume_lost += is_gone ? drop.volume : 0.0;
        return is_gone;
    });
    for (const FallingDrop& drop : next.falling) {
        const auto above = std::find_if(next.droplets.begin(), next.droplets.end(),
                                        [&](const Ancestry& one) { return one.id == drop.droplet; });
        const auto index = static_cast<std::size_t>(above - next.droplets.begin());
        const double top = drop.place().z - radiusOf(drop.volume);
        if (drop.since > dripping.time_step && top < next.droplet.figures[index].height_max) {
            next.droplet.warnings.emplace_back(
                "a droplet grows into the drop that it shed: at such a rate liquid runs rather than drips; let less "
                "flow in");
            break;
        }
    }
    next.continues = next.continues && shed.empty() && next.falling.size() == before.falling.size();
    addDrops(next, outline.extent, next.droplet.surface);
    return next;
}

}  // namespace droplet
