// SPDX-License-Identifier: GPL-3.0-or-later
//
// A matching in the graph of triangles that have an edge in common, after J.-F. Remacle, J. Lambrechts, B. Seny,
// E. Marchandise, A. Johnen and C. Geuzaine, "Blossom-Quad: A non-uniform quadrilateral mesh generator using a
// minimum-cost perfect-matching algorithm" (2012): pairs are taken by their quality, best first; then every triangle
// that was left alone looks for another one along a path of triangles that exchange their partners (Berge 1957). Paths
// through odd rings, for which Edmonds needs blossoms, are not found: of a letter's 40 000 triangles that leaves some
// hundred alone, and the search stays near the triangle.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "droplet/surface/surface.h"
#include "mesh/triangle_pairs.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Corners of a quadrilateral are between this angle and its supplement; beyond them, subdividing it makes folds.
constexpr double kSmallestCorner = std::numbers::pi / 6.0;

double angleAt(const Vec3& at, const Vec3& from, const Vec3& to)
{
    const Vec3 u = from - at;
    const Vec3 v = to - at;
    return std::atan2(length(cross(u, v)), dot(u, v));
}

/// Largest deviation of a corner from 90° [rad]; nothing for a quadrilateral that is not good.
std::optional<double> deviation(const std::array<Vec3, 4>& corners)
{
    const auto& [a, b, c, d] = corners;
    // Corners over 180° show as a sum of angles.
    const double at_a = angleAt(a, b, c) + angleAt(a, c, d);
    const double at_c = angleAt(c, a, b) + angleAt(c, d, a);
    double worst = 0.0;
    for (const double angle : {at_a, angleAt(b, c, a), at_c, angleAt(d, a, c)}) {
        worst = std::max(worst, std::abs(angle - 0.5 * std::numbers::pi));
    }
    return worst <= 0.5 * std::numbers::pi - kSmallestCorner ? std::optional(worst) : std::nullopt;
}

/// Two triangles that may be joined.
struct Candidate {
    double deviation;  ///< [rad]
    std::array<std::uint32_t, 2> triangles;
};

class Pairing {
public:
    Pairing(std::span<const Triangle> triangles, const std::vector<Vec3>& vertices)
        : around_(triangles.size(), {kNone, kNone, kNone}), partner_(triangles.size(), kNone)
    {
        std::vector<Candidate> candidates = candidatesOf(triangles, vertices);
        std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
            return std::pair(a.deviation, a.triangles) < std::pair(b.deviation, b.triangles);
        });
        for (const Candidate& candidate : candidates) {
            const auto& pair = candidate.triangles;
            for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
                auto& around = around_[pair[k]];
                *std::find(around.begin(), around.end(), kNone) = pair[1 - k];
            }
            if (partner_[pair[0]] == kNone && partner_[pair[1]] == kNone) {
                join(pair[0], pair[1]);
            }
        }
        came_from_.resize(triangles.size(), kNone);
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            if (partner_[t] == kNone) {
                exchangeFrom(t);
            }
        }
    }

    /// The other half of a triangle; kNone if it stays alone.
    [[nodiscard]] std::uint32_t partner(std::uint32_t t) const { return partner_[t]; }

private:
    void join(std::uint32_t a, std::uint32_t b)
    {
        partner_[a] = b;
        partner_[b] = a;
    }

    static std::vector<Candidate> candidatesOf(std::span<const Triangle> triangles, const std::vector<Vec3>& vertices)
    {
        std::vector<Candidate> candidates;
        for (const auto& [one, other] : trianglePairs(triangles)) {
            const Triangle& t = triangles[one.triangle];
            const std::uint32_t facing = triangles[other.triangle][other.corner];
            const auto at = [&, corner = one.corner](std::uint32_t k) { return vertices[t[(corner + k) % 3]]; };
            // The common edge is the diagonal from a to c.
            if (const auto found = deviation({at(2), at(0), at(1), vertices[facing]})) {
                candidates.push_back({*found, {one.triangle, other.triangle}});
            }
        }
        return candidates;
    }

    /// Searches a path that begins and ends with triangles alone, and exchanges partners along it.
    void exchangeFrom(std::uint32_t start)
    {
        // Paths get longer where few are alone. Beyond this many triangles, next to none is found.
        constexpr std::size_t kMaxVisited = 2000;
        visited_.clear();
        const auto visit = [&](std::uint32_t t, std::uint32_t from) {
            came_from_[t] = from;
            visited_.push_back(t);
        };
        visit(start, start);
        bool is_found = false;
        for (std::size_t i = 0; i < visited_.size() && !is_found && visited_.size() < kMaxVisited; ++i) {
            const std::uint32_t t = visited_[i];  // alone, if partners before it are exchanged
            for (const std::uint32_t next : around_[t]) {
                if (next == kNone || next == start) {
                    continue;
                }
                if (partner_[next] == kNone) {
                    exchangeAlong(t, next, start);
                    is_found = true;
                    break;
                }
                if (const std::uint32_t freed = partner_[next];
                    came_from_[freed] == kNone && came_from_[next] == kNone) {
                    visit(freed, t);
                }
            }
        }
        for (const std::uint32_t t : visited_) {
            came_from_[t] = kNone;
        }
    }

    /// Joins the last two triangles of a path, and the former partners before them.
    void exchangeAlong(std::uint32_t t, std::uint32_t next, std::uint32_t start)
    {
        while (true) {
            const std::uint32_t left = partner_[t];
            join(t, next);
            if (t == start) {
                return;
            }
            next = left;
            t = came_from_[t];
        }
    }

    std::vector<std::array<std::uint32_t, 3>> around_;  ///< triangles that one may be joined with, best first
    std::vector<std::uint32_t> partner_;
    std::vector<std::uint32_t> came_from_;  ///< the triangle before in a search, whose partner was freed
    std::vector<std::uint32_t> visited_;
};

/// Orders triangles so that the first are the halves of quadrilaterals.
/// @return  number of quadrilaterals
std::size_t join(std::span<Triangle> triangles, const std::vector<Vec3>& vertices)
{
    const Pairing pairing(triangles, vertices);
    std::vector<Triangle> halves;
    std::vector<Triangle> alone;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t partner = pairing.partner(t);
        if (partner == kNone) {
            alone.push_back(triangles[t]);
        } else if (t < partner) {
            const Triangle& one = triangles[t];
            const Triangle& other = triangles[partner];
            const auto is_shared = [&](std::uint32_t v) {
                return std::find(other.begin(), other.end(), v) != other.end();
            };
            // abc begins after the corner that the triangles do not have in common.
            const auto own =
                static_cast<std::size_t>(std::find_if_not(one.begin(), one.end(), is_shared) - one.begin());
            const std::uint32_t a = one[(own + 2) % 3];
            const std::uint32_t c = one[(own + 1) % 3];
            const std::uint32_t d = *std::find_if(other.begin(), other.end(), [&](auto v) { return v != a && v != c; });
            halves.push_back({a, one[own], c});
            halves.push_back({a, c, d});
        }
    }
    std::copy(alone.begin(), alone.end(), std::copy(halves.begin(), halves.end(), triangles.begin()));
    return halves.size() / 2;
}

}  // namespace

void joinTriangles(Surface& surface)
{
    tbb::parallel_for(std::size_t{0}, surface.parts.size(), [&](std::size_t k) {
        SurfacePart& part = surface.parts[k];
        part.quads = join(std::span(surface.triangles).subspan(part.first_triangle, part.triangles), surface.vertices);
    });
}

}  // namespace droplet
