// SPDX-License-Identifier: GPL-3.0-or-later
#include "tails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface_kernel.h"

namespace droplet {
namespace {

/// Particles at most so far apart are one body [spacings].
constexpr double kLink = 1.5;
/// A droplet this far from all others has its whole tail.
constexpr double kFree = 3.5;
/// A droplet whose weakest link is this short has its whole tail.
constexpr double kTight = 1.25;
constexpr int kPieces = 8;
constexpr double kSwept = 0.91;

constexpr std::uint32_t kUnknown = 0;
constexpr std::uint32_t kBulk = 1;

/// Detached droplets: sorted particles of each.
struct Droplets {
    std::vector<std::uint32_t> of;  ///< sorted particles: kBulk or 2 + number of the droplet
    std::vector<std::vector<std::uint32_t>> members;
};

template <typename Visit>
void forNeighbours(const ParticleCells& cells, std::uint32_t i, int reach, const Visit& visit)
{
    const std::uint32_t place = cells.place[i];
    const int cx = static_cast<int>(place % kTileCells) % kTileSide;
    const int cy = static_cast<int>(place % kTileCells) / kTileSide;
    cells.rows(place / kTileCells, cx - reach, cx + reach, cy - reach, cy + reach,
               [&](std::uint32_t first, std::uint32_t last, float dx, float dy) {
                   for (std::uint32_t j = first; j < last; ++j) {
                       const double x = static_cast<double>(cells.x[j] + dx - cells.x[i]);
                       const double y = static_cast<double>(cells.y[j] + dy - cells.y[i]);
                       visit(j, x * x + y * y);
                   }
               });
}

Droplets findDroplets(const TailInput& input, std::size_t limit)
{
    const ParticleCells& cells = input.cells;
    Droplets result;
    result.of.assign(cells.particle.size(), kUnknown);
    for (std::uint32_t i = 0; i < cells.particle.size(); ++i) {
        const std::uint32_t p = cells.place[i];
        if ((input.full[p / kTileCells] >> (p % kTileCells) & 1U) != 0) {
            result.of[i] = kBulk;
        }
    }
    std::vector<std::uint32_t> queue;
    for (std::uint32_t start = 0; start < cells.particle.size(); ++start) {
        if (result.of[start] != kUnknown) {
            continue;
        }
        const auto mark = static_cast<std::uint32_t>(result.members.size() + 2);
        queue.assign(1, start);
        result.of[start] = mark;
        bool is_bulk = false;
        for (std::size_t k = 0; k < queue.size() && !is_bulk; ++k) {
            forNeighbours(cells, queue[k], 2, [&](std::uint32_t j, double d2) {
                if (d2 > kLink * kLink) {
                    return;
                }
                if (result.of[j] == kBulk) {
                    is_bulk = true;
                } else if (result.of[j] == kUnknown) {
                    result.of[j] = mark;
                    queue.push_back(j);
                }
            });
            is_bulk = is_bulk || queue.size() > limit;
        }
        if (is_bulk) {
            for (const std::uint32_t j : queue) {
                result.of[j] = kBulk;
            }
        } else {
            result.members.push_back(queue);
        }
    }
    return result;
}

/// Longest link of the shortest tree that joins all points (Prim).
double weakestLink(const std::vector<Vec2>& points)
{
    std::vector<double> reach(points.size(), std::numeric_limits<double>::infinity());
    std::vector<char> joined(points.size(), 0);
    std::size_t at = 0;
    double weakest = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k) {
        joined[at] = 1;
        std::size_t nearest = points.size();
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (joined[j] == 0) {
                reach[j] = std::min(reach[j], length(points[j] - points[at]));
                if (nearest == points.size() || reach[j] < reach[nearest]) {
                    nearest = j;
                }
            }
        }
        weakest = std::max(weakest, reach[nearest]);
        at = nearest;
    }
    return weakest;
}

/// Way of the centroid over the last `duration`, latest first [spacings].
std::vector<Vec2> wayOf(const TailInput& input, const std::vector<std::uint32_t>& members, double duration)
{
    const double scale = 1.0 / input.frame.spacing;
    const double share = 1.0 / static_cast<double>(members.size());
    std::vector<Vec2> way;
    const std::vector<double>& times = input.state.times;
    for (std::size_t k = 0; k < times.size(); ++k) {
        Vec2 sum{};
        for (const std::uint32_t m : members) {
            const std::uint32_t i = input.cells.particle[m];
            const auto& known = input.state.particles[input.memory[i]].way;
            Vec2 p = k == 0 || known.empty() ? input.frame.position[i] : known[std::min(k, known.size() - 1)];
            if (k > 0 && k >= known.size()) {
                // Before it was born it came as it moves now.
                const std::size_t last = known.empty() ? 0 : known.size() - 1;
                p = p - (times[last] - times[k]) * input.frame.velocity[i];
            }
            sum = sum + p;
        }
        way.push_back(scale * share * sum);
        if (k > 0 && times[0] - times[k] >= duration) {
            const double t = (times[k - 1] - (times[0] - duration)) / (times[k - 1] - times[k]);
            way[k] = way[k - 1] + t * (way[k] - way[k - 1]);
            break;
        }
    }
    return way;
}

double lengthOf(const std::vector<Vec2>& way)
{
    double sum = 0.0;
    for (std::size_t k = 1; k < way.size(); ++k) {
        sum += length(way[k] - way[k - 1]);
    }
    return sum;
}

/// Points at equal distances along the first `total` of a way.
std::array<Vec2, kPieces + 1> evenly(const std::vector<Vec2>& way, double total)
{
    std::array<Vec2, kPieces + 1> points{};
    points[0] = way[0];
    std::size_t k = 1;
    double before = 0.0;
    for (std::size_t p = 1; p <= kPieces; ++p) {
        const double at = total * static_cast<double>(p) / kPieces;
        double piece = length(way[k] - way[k - 1]);
        while (before + piece < at && k + 1 < way.size()) {
            before += piece;
            ++k;
            piece = length(way[k] - way[k - 1]);
        }
        const double t = piece > 0.0 ? std::min(1.0, (at - before) / piece) : 0.0;
        points[p] = way[k - 1] + t * (way[k] - way[k - 1]);
    }
    return points;
}

}  // namespace

double tailProfile(double u, double slope)
{
    const double h00 = (1.0 + 2.0 * u) * (1.0 - u) * (1.0 - u);
    const double h10 = u * (1.0 - u) * (1.0 - u);
    const double h11 = u * u * (u - 1.0);
    return std::max(0.0, h00 - slope * h10 - (2.0 - slope) * h11);
}

TailRadius::TailRadius(double slope)
{
    constexpr int kLengths = 24;
    constexpr int kStations = 64;
    constexpr int kDiscs = 48;
    std::array<double, kDiscs + 1> g{};
    for (int d = 0; d <= kDiscs; ++d) {
        g[static_cast<std::size_t>(d)] = tailProfile(static_cast<double>(d) / kDiscs, slope);
    }
    for (int k = 0; k <= kLengths; ++k) {
        // Area of the tail of length q around a head of radius 1.
        const double t = static_cast<double>(k) / kLengths;
        const double q = 32.0 * t * t;
        const double step = (q + 2.0) / kStations;
        double area = 0.0;
        for (int s = 0; s < kStations; ++s) {
            // Cosine stations follow the round head.
            const double a = std::numbers::pi * (s + 0.5) / kStations;
            const double x = -1.0 + 0.5 * (q + 2.0) * (1.0 - std::cos(a));
            double widest = 0.0;
            for (int d = 0; d <= kDiscs; ++d) {
                const double r = g[static_cast<std::size_t>(d)];
                const double off = x - q * d / kDiscs;
                widest = std::max(widest, r * r - off * off);
            }
            area += 2.0 * std::sqrt(widest) * 0.5 * std::numbers::pi * std::sin(a) * step;
        }
        const double radius = k == 0 ? 1.0 : std::min(1.0, std::sqrt(std::numbers::pi / area));
        length_.push_back(q * radius);
        radius_.push_back(radius);
    }
}

double TailRadius::operator()(double length) const
{
    const auto after = std::upper_bound(length_.begin(), length_.end(), length);
    if (after == length_.end()) {
        return radius_.back();
    }
    const auto k = static_cast<std::size_t>(after - length_.begin());
    const double t = (length - length_[k - 1]) / (length_[k] - length_[k - 1]);
    return radius_[k - 1] + t * (radius_[k] - radius_[k - 1]);
}

Tails tailsOf(const TailInput& input, const ExpressionOptions& options)
{
    Tails tails;
    if (options.tail_length <= 0.0 || options.max_tail <= 0.0 || input.state.times.size() < 2) {
        return tails;
    }
    const Droplets droplets = findDroplets(input, static_cast<std::size_t>(options.droplet_size));
    const TailRadius radius_of(options.tail_slope);
    const double scale = 1.0 / input.frame.spacing;
    for (std::size_t d = 0; d < droplets.members.size(); ++d) {
        const std::vector<std::uint32_t>& members = droplets.members[d];
        double gap = kFree;
        std::vector<Vec2> points;
        for (const std::uint32_t m : members) {
            forNeighbours(input.cells, m, 4, [&](std::uint32_t j, double d2) {
                if (droplets.of[j] != d + 2) {
                    gap = std::min(gap, std::sqrt(d2));
                }
            });
            points.push_back(scale * input.frame.position[input.cells.particle[m]]);
        }
        const double freedom = smoothRamp(gap, kLink, kFree) * smoothRamp(weakestLink(points), kLink, kTight);
        if (freedom <= 0.0) {
            continue;
        }
        const std::vector<Vec2> way = wayOf(input, members, options.tail_length);
        const double droplet_radius = kParticleRadius * std::sqrt(static_cast<double>(members.size()));
        const double tail = freedom * std::min(lengthOf(way), options.max_tail * droplet_radius);
        if (tail < 1e-6) {
            continue;
        }
        const double r = radius_of(tail / droplet_radius);
        const auto skeleton = evenly(way, tail);
        // Swept discs reach as far as their foremost points, so they are smaller than those of the body.
        const double swept = members.size() == 1 ? 1.0 : kSwept;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const Vec2 offset = r * (points[k] - way[0]);
            tails.heads.push_back({members[k], way[0] + offset, r});
            for (int p = 0; p < kPieces; ++p) {
                const double a = tailProfile(static_cast<double>(p) / kPieces, options.tail_slope);
                const double b = tailProfile(static_cast<double>(p + 1) / kPieces, options.tail_slope);
                tails.pieces.push_back({skeleton[static_cast<std::size_t>(p)] + swept * a * offset,
                                        skeleton[static_cast<std::size_t>(p) + 1] + swept * b * offset,
                                        r * kParticleRadius * a, r * kParticleRadius * b});
            }
        }
    }
    return tails;
}

}  // namespace droplet
