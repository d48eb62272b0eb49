// SPDX-License-Identifier: GPL-3.0-or-later
// M. Tang, M. Lee, Y. J. Kim, "Interactive Hausdorff distance computation for general polygonal models" (2009): the
// distance of a point p from one triangle U is a convex function of p, so that on a piece of the first surface it is
// largest at a corner, and no point of the piece is farther from the second surface than the farthest corner is from
// U. Pieces whose bound is over what some point is known to have are cut, the largest bound first.
//
// Where to cut is ours: along the sides of the nearest U, seen along its normal, for the bound is exact on pieces that
// have their nearest points in one triangle. Halving alone needs pieces as small as the distance where two sheets lie
// close to each other.
#include "surface/hausdorff.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace droplet {
namespace {

constexpr double kRoundOff = 1e-12;   // of distances between points within [−1, 1]³, with three digits to spare
constexpr std::size_t kBatch = 4096;  // pieces cut between two looks at the bounds, whatever the number of threads

struct Sample {
    Vec3 at;
    NearestTriangles::Found found;
};

struct Piece {
    std::array<Sample, 3> corners;
    Sample centre;
    double upper = 0.0;
    unsigned generation = 0;
};

Sample sampled(Vec3 at, const NearestTriangles& to, std::uint32_t guess)
{
    return {at, to.nearest(at, guess)};
}

double largestFrom(const Piece& piece, const Corners3& triangle)
{
    double largest = 0.0;
    for (const Sample& corner : piece.corners) {
        largest = std::max(largest, distance(corner.at, triangle));
    }
    return largest;
}

// Lowers the piece's bound; its centre is asked for only where that might pay.
void bound(Piece& piece, const NearestTriangles& to, double settled)
{
    const auto& corners = piece.corners;
    for (const Sample& corner : corners) {
        piece.upper = std::min(piece.upper, largestFrom(piece, to.triangles()[corner.found.triangle]));
        if (piece.upper <= settled) {
            piece.centre = corners[0];
            return;
        }
    }
    piece.centre =
        sampled((1.0 / 3.0) * (corners[0].at + corners[1].at + corners[2].at), to, corners[0].found.triangle);
    piece.upper = std::min(piece.upper, largestFrom(piece, to.triangles()[piece.centre.found.triangle]));
    double radius = 0.0;
    for (const Sample& corner : corners) {
        radius = std::max(radius, length(corner.at - piece.centre.at));
    }
    piece.upper = std::min(piece.upper, piece.centre.found.distance + radius);
}

// Signed distances of a piece's corners from the plane it is to be cut by.
std::optional<std::array<double, 3>> sidesOfCut(const Piece& piece, const NearestTriangles& to)
{
    constexpr unsigned kHalveEvery = 4;  // so that pieces shrink to nothing whatever the triangles
    constexpr double kLeast = 1e-9;      // of the piece on either side
    if (piece.generation % kHalveEvery == kHalveEvery - 1) {
        return std::nullopt;
    }
    const std::uint32_t nearest = piece.centre.found.triangle;
    const Corners3& triangle = to.triangles()[nearest];
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        size = std::max(size, length(piece.corners[(k + 1) % 3].at - piece.corners[k].at));
    }
    std::optional<std::array<double, 3>> best;
    double farthest = kLeast * size;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 outward = cross(triangle[(k + 1) % 3] - triangle[k], to.facet(nearest));
        const double scale = length(outward);
        if (!(scale > 0.0)) {
            continue;
        }
        std::array<double, 3> sides{};
        for (std::size_t i = 0; i < 3; ++i) {
            sides[i] = dot(piece.corners[i].at - triangle[k], outward) / scale;
        }
        const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
        if (*most > farthest && *least < -kLeast * size) {
            farthest = *most;
            best = sides;
        }
    }
    return best;
}

// The plane through a corner and the middle of the longest side.
std::array<double, 3> sidesOfHalves(const Piece& piece)
{
    std::size_t longest = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double size = length(piece.corners[(k + 1) % 3].at - piece.corners[k].at);
        if (size > most) {
            most = size;
            longest = k;
        }
    }
    std::array<double, 3> sides{};
    sides[longest] = -1.0;
    sides[(longest + 1) % 3] = 1.0;
    return sides;
}

struct Cut {
    std::array<Piece, 3> pieces;
    std::size_t count = 0;
    Sample farthest;
};

Cut cut(const Piece& piece, const NearestTriangles& to, double settled)
{
    const std::array<double, 3> sides = sidesOfCut(piece, to).value_or(sidesOfHalves(piece));
    // The piece's outline with the points where the plane cuts it: one on each of two sides, or a corner and one. There
    // are corners on both sides of it.
    std::array<Sample, 5> outline;
    std::size_t count = 0;
    Cut result;
    result.farthest = piece.centre;
    std::array<std::size_t, 2> cuts{};
    std::size_t cut_count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (sides[k] == 0.0) {
            cuts[cut_count++] = count;
        }
        outline[count++] = piece.corners[k];
        if ((sides[k] < 0.0 && sides[next] > 0.0) || (sides[k] > 0.0 && sides[next] < 0.0)) {
            const double t = sides[k] / (sides[k] - sides[next]);
            const Vec3 at = (1.0 - t) * piece.corners[k].at + t * piece.corners[next].at;
            cuts[cut_count++] = count;
            outline[count] = sampled(at, to, piece.centre.found.triangle);
            if (outline[count].found.distance > result.farthest.found.distance) {
                result.farthest = outline[count];
            }
            ++count;
        }
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        Piece& child = result.pieces[result.count++];
        child.corners = {outline[a % count], outline[b % count], outline[c % count]};
        child.upper = piece.upper;
        child.generation = piece.generation + 1;
        bound(child, to, settled);
        if (child.centre.found.distance > result.farthest.found.distance) {
            result.farthest = child.centre;
        }
    };
    const auto fan = [&](std::size_t from, std::size_t until) {
        for (std::size_t k = from + 1; k < until; ++k) {
            add(from, k, k + 1);
        }
    };
    fan(cuts[0], cuts[1]);
    fan(cuts[1], cuts[0] + count);
    return result;
}

}  // namespace

HausdorffBounds hausdorff(const std::vector<Corners3>& from, const NearestTriangles& to,
                          const HausdorffOptions& options)
{
    struct Farther {
        bool operator()(const Piece& a, const Piece& b) const { return a.upper < b.upper; }
    };
    Sample farthest;
    farthest.found.distance = -1.0;
    const auto meet = [&farthest](const Sample& sample) {
        if (sample.found.distance > farthest.found.distance) {
            farthest = sample;
        }
    };
    double dismissed = 0.0;  // the largest bound that was good enough
    const auto settled = [&] {
        const double lower = std::max(farthest.found.distance, 0.0);
        double line = lower / (1.0 - options.share);
        if (options.tolerance && lower <= *options.tolerance) {
            line = std::min(line, *options.tolerance);
        }
        return std::max(line, lower + kRoundOff);
    };
    std::vector<Piece> open;  // a heap
    const auto keep = [&](const Piece& piece, double line) {
        if (piece.upper > line) {
            open.push_back(piece);
            std::push_heap(open.begin(), open.end(), Farther());
        } else {
            dismissed = std::max(dismissed, piece.upper);
        }
    };

    // Corners first, all of them: what is known of the lower bound spares work on the upper one.
    for (std::size_t begin = 0; begin < from.size(); begin += 16 * kBatch) {
        const std::size_t count = std::min(16 * kBatch, from.size() - begin);
        std::vector<Piece> pieces(count);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const auto& range) {
            std::uint32_t guess = 0;
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                pieces[i].upper = std::numeric_limits<double>::infinity();
                for (std::size_t k = 0; k < 3; ++k) {
                    pieces[i].corners[k] = sampled(from[begin + i][k], to, guess);
                    guess = pieces[i].corners[k].found.triangle;
                }
            }
        });
        for (const Piece& piece : pieces) {
            std::for_each(piece.corners.begin(), piece.corners.end(), meet);
        }
        const double line = settled();
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { bound(pieces[i], to, line); });
        for (const Piece& piece : pieces) {
            meet(piece.centre);
        }
        const double later_line = settled();
        for (const Piece& piece : pieces) {
            keep(piece, later_line);
        }
    }

    std::vector<Piece> batch;
    std::vector<Cut> cuts;
    for (std::size_t looked_at = from.size(); !open.empty() && looked_at < options.most_pieces;) {
        const double line = settled();
        batch.clear();
        while (!open.empty() && open.front().upper > line && batch.size() < kBatch) {
            std::pop_heap(open.begin(), open.end(), Farther());
            batch.push_back(open.back());
            open.pop_back();
        }
        if (batch.empty()) {
            break;
        }
        cuts.assign(batch.size(), {});
        tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) { cuts[i] = cut(batch[i], to, line); });
        for (const Cut& one : cuts) {
            meet(one.farthest);
            looked_at += one.count;
        }
        const double next_line = settled();
        for (const Cut& one : cuts) {
            for (std::size_t k = 0; k < one.count; ++k) {
                keep(one.pieces[k], next_line);
            }
        }
    }
    HausdorffBounds result;
    result.lower = farthest.found.distance;
    result.upper = std::max({result.lower, dismissed, open.empty() ? 0.0 : open.front().upper});
    result.at = farthest.at;
    result.nearest = farthest.found.point;
    return result;
}

}  // namespace droplet
