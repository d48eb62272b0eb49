// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clipper unites polygons on integers, after B. R. Vatti, "A generic solution to polygon clipping" (1992). Its loops
// may touch at points, also because it rounds crossings. If they do, all loops are shrunk slightly.

#include "type/contour_union.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <polyclipping/clipper.hpp>
#include <tuple>
#include <utility>

#include "droplet/error.h"

namespace droplet {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

__extension__ using Wide = __int128;

/// Integers per em. An em has at most 2¹⁴ font units; if their number is a power of two, units, halves and quarters are
/// exact. Coordinates of single glyphs are below 2³⁰, up to which Clipper multiplies in 64 bits.
constexpr double kGrid = 67108864.0;

/// Distance below which vertices are merged [grid]: 2⁻²³ em is an effect of rounding, not a drawn detail.
constexpr double kMerge = 8.0;

/// Gap between sides that touched [grid]; each side moves by half of it.
constexpr double kGap = 16384.0;

IntPoint minus(const IntPoint& a, const IntPoint& b)
{
    return {a.X - b.X, a.Y - b.Y};
}

int turn(const IntPoint& a, const IntPoint& b)
{
    const Wide cross = static_cast<Wide>(a.X) * b.Y - static_cast<Wide>(a.Y) * b.X;
    return cross > 0 ? 1 : (cross < 0 ? -1 : 0);
}

/// Edge of one of several loops.
struct Edge {
    IntPoint from;
    IntPoint to;
    std::size_t loop = 0;
    std::size_t index = 0;

    [[nodiscard]] auto left() const { return std::min(from.X, to.X); }
    [[nodiscard]] auto right() const { return std::max(from.X, to.X); }
    [[nodiscard]] auto low() const { return std::min(from.Y, to.Y); }
    [[nodiscard]] auto high() const { return std::max(from.Y, to.Y); }
};

/// Whether two edges with intersecting boxes have a common point.
bool intersect(const Edge& a, const Edge& b)
{
    const IntPoint along_a = minus(a.to, a.from);
    const IntPoint along_b = minus(b.to, b.from);
    return turn(along_a, minus(b.from, a.from)) * turn(along_a, minus(b.to, a.from)) <= 0 &&
           turn(along_b, minus(a.from, b.from)) * turn(along_b, minus(a.to, b.from)) <= 0;
}

/// Whether the second of two consecutive edges runs back along the first.
bool turnsBack(const Edge& first, const Edge& second)
{
    const IntPoint a = minus(first.to, first.from);
    const IntPoint b = minus(second.to, second.from);
    return turn(a, b) == 0 && static_cast<Wide>(a.X) * b.X + static_cast<Wide>(a.Y) * b.Y < 0;
}

/// Whether loops cross or touch one another or themselves.
bool touchAnywhere(const Paths& loops)
{
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        for (std::size_t i = 0; i < loops[k].size(); ++i) {
            edges.push_back({loops[k][i], loops[k][(i + 1) % loops[k].size()], k, i});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.left() < b.left(); });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& a = edges[i];
        for (std::size_t j = i + 1; j < edges.size() && edges[j].left() <= a.right(); ++j) {
            const Edge& b = edges[j];
            if (b.low() > a.high() || b.high() < a.low()) {
                continue;
            }
            const std::size_t count = loops[a.loop].size();
            const bool then = a.loop == b.loop && (a.index + 1) % count == b.index;
            const bool before = a.loop == b.loop && (b.index + 1) % count == a.index;
            if (then || before ? turnsBack(then ? a : b, then ? b : a) : intersect(a, b)) {
                return true;
            }
        }
    }
    return false;
}

Paths combined(ClipperLib::ClipType how, const Paths& contours, const Paths& others = {})
{
    ClipperLib::Clipper clipper;
    Paths result;
    if (!clipper.AddPaths(contours, ClipperLib::ptSubject, true)) {
        return result;  // there are only points and lines
    }
    clipper.AddPaths(others, ClipperLib::ptClip, true);
    if (!clipper.Execute(how, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero)) {
        throw Error(ErrorCode::InvalidInput, "the contours cannot be united");
    }
    return result;
}

Paths united(const Paths& contours)
{
    return combined(ClipperLib::ctUnion, contours);
}

/// Area that contours wind around, from the lengths of horizontal lines in it.
double areaInside(const Paths& contours)
{
    constexpr int kLines = 1024;
    auto low = contours.front().front().Y;
    auto high = low;
    for (const Path& contour : contours) {
        for (const IntPoint& p : contour) {
            low = std::min(low, p.Y);
            high = std::max(high, p.Y);
        }
    }
    const double step = static_cast<double>(high - low) / kLines;
    double sum = 0.0;
    std::vector<std::pair<double, int>> crossings;
    for (int k = 0; k < kLines; ++k) {
        const double y = static_cast<double>(low) + (k + 0.5) * step;
        crossings.clear();
        for (const Path& contour : contours) {
            for (std::size_t i = 0; i < contour.size(); ++i) {
                const IntPoint& a = contour[i];
                const IntPoint& b = contour[(i + 1) % contour.size()];
                const auto ay = static_cast<double>(a.Y);
                const auto by = static_cast<double>(b.Y);
                if ((ay <= y) != (by <= y)) {
                    crossings.emplace_back(
                        static_cast<double>(a.X) + (y - ay) / (by - ay) * static_cast<double>(b.X - a.X),
                        ay <= y ? 1 : -1);
                }
            }
        }
        std::sort(crossings.begin(), crossings.end());
        int winding = 0;
        for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
            winding += crossings[i].second;
            sum += winding != 0 ? crossings[i + 1].first - crossings[i].first : 0.0;
        }
    }
    return sum * step;
}

double areaOf(const Paths& loops)
{
    double sum = 0.0;
    for (const Path& loop : loops) {
        sum += ClipperLib::Area(loop);
    }
    return sum;
}

/// Rotates paths by 90°, so that Clipper sweeps in another direction.
Paths rotated(Paths paths)
{
    for (Path& path : paths) {
        for (IntPoint& p : path) {
            p = {-p.Y, p.X};
        }
    }
    return paths;
}

/// Results of Clipper with their area, in one of four directions: it may fail in some of them if many sides touch or
/// coincide.
/// @param sets     paths that an operation takes
/// @param area     area of all results together
/// @param enough   error of the area that ends the search; otherwise, the best of four results is returned
/// @param operate  makes results from sets of paths
template <typename Operation>
std::vector<Paths> bestDirection(std::vector<Paths> sets, double area, double enough, const Operation& operate)
{
    double min = std::numeric_limits<double>::infinity();
    std::vector<Paths> best;
    for (int quarters = 0; quarters < 4 && min > enough; ++quarters) {
        std::vector<Paths> results = operate(sets);
        double sum = 0.0;
        for (const Paths& result : results) {
            sum += areaOf(result);
        }
        const double off = std::abs(sum - area);
        for (int back = quarters; back % 4 != 0; ++back) {
            std::transform(results.begin(), results.end(), results.begin(), rotated);
        }
        if (off < 0.999 * min) {
            min = off;
            best = std::move(results);
        }
        std::transform(sets.begin(), sets.end(), sets.begin(), rotated);
    }
    return best;
}

/// Best of four unions in different directions.
Paths bestUnion(Paths contours)
{
    contours.erase(std::remove_if(contours.begin(), contours.end(), [](const Path& path) { return path.empty(); }),
                   contours.end());
    if (contours.empty()) {
        return contours;
    }
    const double area = areaInside(contours);
    return bestDirection({std::move(contours)}, area, 0.0,
                         [](const std::vector<Paths>& sets) { return std::vector<Paths>{united(sets[0])}; })
        .front();
}

bool isNear(const IntPoint& a, const IntPoint& b, double merge)
{
    const IntPoint d = minus(a, b);
    return std::hypot(static_cast<double>(d.X), static_cast<double>(d.Y)) < merge;
}

/// Removes vertices of a loop that are too near to the one before, or on the line through their neighbours.
Path cleaned(const Path& loop, double merge)
{
    Path result;
    const auto on_line = [&](const IntPoint& next) {
        return result.size() > 1 &&
               turn(minus(result.back(), *std::prev(result.end(), 2)), minus(next, result.back())) == 0;
    };
    for (const IntPoint& p : loop) {
        if (!result.empty() && isNear(result.back(), p, merge)) {
            continue;
        }
        while (on_line(p)) {
            result.pop_back();
        }
        result.push_back(p);
    }
    while (result.size() > 1 && isNear(result.back(), result.front(), merge)) {
        result.pop_back();
    }
    while (result.size() > 2 && on_line(result.front())) {
        result.pop_back();
    }
    while (result.size() > 2 && turn(minus(result.front(), result.back()), minus(result[1], result.front())) == 0) {
        result.erase(result.begin());
    }
    return result;
}

void clean(Paths& loops, double merge)
{
    for (Path& loop : loops) {
        loop = cleaned(loop, merge);
    }
    loops.erase(std::remove_if(loops.begin(), loops.end(), [](const Path& loop) { return loop.size() < 3; }),
                loops.end());
}

/// Makes loops larger, or smaller if `by` is negative.
Paths offset(Paths loops, double by)
{
    // Clipper expects that the first of the lowest loops is an outer one, but a hole may touch its outer loop there.
    std::stable_partition(loops.begin(), loops.end(), ClipperLib::Orientation);
    constexpr double kMiter = 4.0;
    ClipperLib::ClipperOffset offset(kMiter);
    offset.AddPaths(loops, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
    Paths result;
    offset.Execute(result, by);
    return result;
}

/// Parts of an area that are wider than twice a length.
Paths wide(const Paths& loops, double half)
{
    return offset(offset(loops, -half), half);
}

/// Separates loops: closes gaps of rounding, then shrinks all loops by half the gap.
Paths separated(const Paths& loops)
{
    // Rounding may make sides touch again; with another gap it may not.
    constexpr int kAttempts = 4;
    double gap = kGap;
    for (int attempt = 0; attempt < kAttempts; ++attempt, gap *= 1.5) {
        Paths result = offset(offset(loops, kMerge), -kMerge - 0.5 * gap);
        clean(result, 0.25 * gap);
        if (!touchAnywhere(result)) {
            return result;
        }
    }
    throw Error(ErrorCode::InvalidInput, "contours touch and cannot be separated");
}

Paths rounded(const std::vector<Contour>& contours)
{
    Paths paths;
    for (const Contour& contour : contours) {
        Path path;
        for (const Vec2 p : contour) {
            path.emplace_back(std::llround(p.x * kGrid), std::llround(p.y * kGrid));
        }
        paths.push_back(std::move(path));
    }
    return paths;
}

Contour contourOf(const Path& path)
{
    Contour contour;
    for (const IntPoint& p : path) {
        contour.push_back({static_cast<double>(p.X) / kGrid, static_cast<double>(p.Y) / kGrid});
    }
    return contour;
}

std::vector<Contour> contoursOf(const Paths& paths)
{
    std::vector<Contour> contours;
    std::transform(paths.begin(), paths.end(), std::back_inserter(contours), contourOf);
    return contours;
}

}  // namespace

United unite(const std::vector<Contour>& contours, double speck)
{
    const Paths paths = rounded(contours);
    Paths loops = united(paths);
    clean(loops, kMerge);
    if (touchAnywhere(loops)) {
        loops = bestUnion(paths);
        clean(loops, kMerge);
        loops = separated(loops);
    }
    United result;
    for (const Path& loop : loops) {
        if (std::abs(ClipperLib::Area(loop)) < speck * kGrid * kGrid) {
            ++result.specks;
            continue;
        }
        // Loops start at their leftmost point, so that the result does not depend on Clipper's order.
        const auto first = std::min_element(loop.begin(), loop.end(), [](const IntPoint& a, const IntPoint& b) {
            return std::tie(a.X, a.Y) < std::tie(b.X, b.Y);
        });
        Path turned(first, loop.end());
        turned.insert(turned.end(), loop.begin(), first);
        result.loops.push_back(contourOf(turned));
    }
    std::sort(result.loops.begin(), result.loops.end(), [](const Contour& a, const Contour& b) {
        return std::tie(a.front().x, a.front().y) < std::tie(b.front().x, b.front().y);
    });
    return result;
}

std::vector<Contour> enclosed(const std::vector<Contour>& contours)
{
    return contoursOf(bestUnion(rounded(contours)));
}

Parts divide(const std::vector<Contour>& area, const std::vector<Contour>& by, double narrow)
{
    constexpr double kRounding = 1e-6 * kGrid * kGrid;  // crossings are rounded, which changes areas a little
    constexpr double kTooMuch = 1e-4 * kGrid * kGrid;
    const Paths paths = rounded(area);
    const double whole = areaOf(paths);
    std::vector<Paths> parts =
        bestDirection({paths, rounded(by)}, whole, kRounding, [](const std::vector<Paths>& sets) {
            return std::vector<Paths>{combined(ClipperLib::ctIntersection, sets[0], sets[1]),
                                      combined(ClipperLib::ctDifference, sets[0], sets[1])};
        });
    if (std::abs(areaOf(parts[0]) + areaOf(parts[1]) - whole) > kTooMuch) {
        throw Error(ErrorCode::InvalidInput, "areas of colour overlap and cannot be divided");
    }
    Paths slivers;
    if (narrow > 0.0 && !parts[0].empty()) {
        const double half = 0.5 * narrow * kGrid;
        slivers = combined(ClipperLib::ctDifference, parts[1], wide(parts[1], half));
        slivers = combined(ClipperLib::ctIntersection, slivers, wide(paths, half));
        std::erase_if(slivers, [](const Path& path) { return std::abs(ClipperLib::Area(path)) < kRounding; });
        if (!slivers.empty()) {
            parts[1] = combined(ClipperLib::ctDifference, parts[1], slivers);
        }
    }
    return {contoursOf(parts[0]), contoursOf(slivers), contoursOf(parts[1])};
}

}  // namespace droplet
