// SPDX-License-Identifier: GPL-3.0-or-later
// J. Rabin, G. Peyré, J. Delon, M. Bernot, "Wasserstein barycenter and its application to texture mixing", SSVM 2011;
// N. Bonneel, J. Rabin, G. Peyré, H. Pfister, "Sliced and Radon Wasserstein barycenters of measures", JMIV 2015.
// Targets for each particle follow J. Madill, D. Mould, "Target particle control of smoke simulation", GI 2013, and
// driven liquids L. Shi, Y. Yu, "Taming liquids for rapidly changing targets", SCA 2005, which match shapes otherwise.
#include "droplet/morph/morph_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "liquid2d/near_points.h"
#include "liquid2d/region.h"
#include "require.h"

namespace droplet {
namespace {

using Indices = std::vector<std::uint32_t>;

Vec2 meanOf(const std::vector<Vec2>& points)
{
    Vec2 sum;
    for (const Vec2 point : points) {
        sum = sum + point;
    }
    return 1.0 / static_cast<double>(points.size()) * sum;
}

void sortAlong(Vec2 direction, const std::vector<Vec2>& points, std::span<std::uint32_t> order)
{
    std::vector<std::pair<double, std::uint32_t>> keys;
    keys.reserve(order.size());
    for (const std::uint32_t i : order) {
        keys.emplace_back(dot(direction, points[i]), i);
    }
    std::sort(keys.begin(), keys.end());
    std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
}

Indices upTo(std::size_t count)
{
    Indices indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
}

/// Moves points along slices towards the distribution of the targets.
std::vector<Vec2> moved(std::vector<Vec2> points, const std::vector<Vec2>& targets)
{
    constexpr int kRounds = 24;
    constexpr int kSlices = 4;  // directions whose mean is one step
    constexpr double kTurn = std::numbers::pi / kSlices;
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    Indices from = upTo(points.size());
    Indices to = from;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<Vec2> steps(points.size());
        for (int slice = 0; slice < kSlices; ++slice) {
            const double angle = kTurn * (slice + std::fmod(golden * round, 1.0));
            const Vec2 direction{std::cos(angle), std::sin(angle)};
            sortAlong(direction, points, from);
            sortAlong(direction, targets, to);
            for (std::size_t k = 0; k < from.size(); ++k) {
                const double step = dot(direction, targets[to[k]] - points[from[k]]);
                steps[from[k]] = steps[from[k]] + 2.0 / kSlices * step * direction;
            }
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i] = points[i] + steps[i];
        }
    }
    return points;
}

/// Pairs two sets of points of nearly the same distribution.
class Halving {
public:
    Halving(const std::vector<Vec2>& points, const std::vector<Vec2>& targets, Indices& partner)
        : points_(points), targets_(targets), partner_(partner)
    {
        Indices from = upTo(points.size());
        Indices to = from;
        halve(from, to, false);
    }

private:
    void halve(std::span<std::uint32_t> from, std::span<std::uint32_t> to, bool turned)
    {
        if (from.empty()) {
            return;
        }
        if (from.size() == 1) {
            partner_[from[0]] = to[0];
            return;
        }
        // Lattices have no rows at this angle, so that rounding does not decide which half takes a point.
        const double angle = 0.3217 + (turned ? 0.5 * std::numbers::pi : 0.0);
        const Vec2 direction{std::cos(angle), std::sin(angle)};
        sortAlong(direction, points_, from);
        sortAlong(direction, targets_, to);
        const std::size_t middle = from.size() / 2;
        halve(from.first(middle), to.first(middle), !turned);
        halve(from.subspan(middle), to.subspan(middle), !turned);
    }

    const std::vector<Vec2>& points_;
    const std::vector<Vec2>& targets_;
    Indices& partner_;
};

/// Neighbours of each of some points.
std::vector<Indices> neighboursOf(const std::vector<Vec2>& points)
{
    constexpr std::size_t kCount = 13;  // with the point itself
    const NearPoints near(points);
    std::vector<Indices> neighbours(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const NearPoints::Neighbour& found : near.nearest(points[i], kCount)) {
            if (found.index != i) {
                neighbours[i].push_back(found.index);
            }
        }
    }
    return neighbours;
}

/// Exchanges partners while that shortens the sum of squares.
void exchange(const std::vector<Vec2>& sources, const std::vector<Vec2>& targets, Indices& partner)
{
    constexpr int kSweeps = 60;
    constexpr std::size_t kThird = 6;  // neighbours tried as the third of three
    const std::vector<Indices> near_source = neighboursOf(sources);
    const std::vector<Indices> near_target = neighboursOf(targets);
    Indices owner(partner.size());
    for (std::uint32_t i = 0; i < partner.size(); ++i) {
        owner[partner[i]] = i;
    }
    bool changed = true;
    const auto exchange_two = [&](std::uint32_t i, std::uint32_t j) {
        // Of |a − p|² + |b − q|² against |a − q|² + |b − p|² only the mixed products differ.
        const Vec2 way = targets[partner[j]] - targets[partner[i]];
        const Vec2 aside = sources[j] - sources[i];
        const double gain = -dot(way, aside);
        if (gain > 0.0 && gain * gain > 1e-24 * dot(way, way) * dot(aside, aside)) {
            std::swap(partner[i], partner[j]);
            owner[partner[i]] = i;
            owner[partner[j]] = j;
            changed = true;
        }
    };
    // Moves the target of j to i, of k to j, of i to k.
    const auto exchange_three = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        if (k == i || k == j || i == j) {
            return;
        }
        const Vec2 p = targets[partner[i]];
        const Vec2 q = targets[partner[j]];
        const Vec2 r = targets[partner[k]];
        const double gain = dot(sources[i], q - p) + dot(sources[j], r - q) + dot(sources[k], p - r);
        if (gain > 1e-12 * (dot(q - p, q - p) + dot(r - q, r - q))) {
            const std::uint32_t first = partner[i];
            partner[i] = partner[j];
            partner[j] = partner[k];
            partner[k] = first;
            for (const std::uint32_t of : {i, j, k}) {
                owner[partner[of]] = of;
            }
            changed = true;
        }
    };
    Indices candidates;
    bool threes = false;  // pairs first, which cost less time
    for (int sweep = 0; sweep < kSweeps && (changed || !threes); ++sweep) {
        threes = !changed;
        changed = false;
        for (std::uint32_t i = 0; i < partner.size(); ++i) {
            candidates = near_source[i];
            for (const std::uint32_t t : near_target[partner[i]]) {
                candidates.push_back(owner[t]);
            }
            for (const std::uint32_t j : candidates) {
                exchange_two(i, j);
                for (std::size_t n = 0; threes && n < std::min(kThird, near_source[j].size()); ++n) {
                    exchange_three(i, j, near_source[j][n]);
                }
            }
        }
    }
}

/// Pushes points that are closer than `distance` apart, inside of a region.
void spread(const Region& region, double distance, std::vector<Vec2>& points)
{
    constexpr int kSteps = 6;
    const Interior interior(region);
    for (int step = 0; step < kSteps; ++step) {
        const NearPoints near(points);
        std::vector<Vec2> next = points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (const NearPoints::Neighbour& found : near.nearest(points[i], 7)) {
                const double away = std::sqrt(found.squared);
                if (found.index != i && away > 0.0 && away < distance) {
                    next[i] = next[i] + 0.25 * (distance / away - 1.0) * (points[i] - points[found.index]);
                }
            }
            next[i] = interior.contains(next[i]) ? next[i] : points[i];
        }
        points = std::move(next);
    }
}

}  // namespace

std::vector<Vec2> sampleRegion(const Region& region, std::size_t count)
{
    const double area = momentsOf(region).area;
    require(std::isfinite(area) && area > 0.0, "region.area", area, "finite and more than 0 m²");
    require(count > 0, "count", count, "at least 1");
    // Thin regions hold fewer points of a lattice than their area tells.
    double coarse = 2.0 * std::sqrt(area / static_cast<double>(count));
    double fine = 0.5 * coarse;
    std::vector<Vec2> points = latticeIn(region, fine);
    for (int k = 0; points.size() < count; ++k) {
        require(k < 12, "region", "too thin", "wide enough for its points");
        coarse = fine;
        fine *= 0.75;
        points = latticeIn(region, fine);
    }
    for (int k = 0; k < 24 && points.size() > count; ++k) {
        const double middle = 0.5 * (fine + coarse);
        std::vector<Vec2> some = latticeIn(region, middle);
        if (some.size() < count) {
            coarse = middle;
        } else {
            fine = middle;
            points = std::move(some);
        }
    }
    const std::size_t surplus = points.size() - count;
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if ((i + 1) * surplus / points.size() == i * surplus / points.size()) {
            kept.push_back(points[i]);
        }
    }
    const double hexagonal = std::sqrt(2.0 / std::sqrt(3.0));
    spread(region, hexagonal * std::sqrt(area / static_cast<double>(count)), kept);
    return kept;
}

std::vector<std::uint32_t> assignTargets(const std::vector<Vec2>& sources, const std::vector<Vec2>& targets)
{
    require(sources.size() == targets.size(), "targets.size()", targets.size(), "that of sources");
    require(sources.size() <= std::numeric_limits<std::uint32_t>::max(), "sources.size()", sources.size(),
            "at most 4294967295");
    if (sources.empty()) {
        return {};
    }
    // A translation of all points leaves the best pairs as they are.
    const Vec2 shift = meanOf(targets) - meanOf(sources);
    std::vector<Vec2> points = sources;
    for (Vec2& point : points) {
        point = point + shift;
    }
    Indices partner(points.size());
    Halving(moved(points, targets), targets, partner);
    exchange(points, targets, partner);
    return partner;
}

}  // namespace droplet
