// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_core.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace droplet {
namespace {

/// Lattice points stay this many edges away from the rim. At 1/√3 ≈ 0.577 and more, every point of a lattice triangle's
/// circumdisc is nearer to one of its corners than the rim is, so that the triangle is Delaunay; with 0.65 the smallest
/// angles between the lattice and the rim are 27° to 32° on discs and type.
constexpr double kClearance = 0.65;

/// Layers of points between two halvings of the density: edges then grow by about half their length per edge.
constexpr int kLayersPerLevel = 2;

/// One row of triangles between lattice rows r and r + 1, by the columns of their horizontal edges.
struct TriangleRow {
    LatticeRegion::Row up;    ///< edge in row r, apex above
    LatticeRegion::Row down;  ///< edge in row r + 1, apex below

    [[nodiscard]] std::size_t size() const
    {
        std::size_t count = 0;
        for (const LatticeRegion::Row* row : {&up, &down}) {
            for (const ColumnInterval& i : *row) {
                count += static_cast<std::size_t>(i.end - i.begin);
            }
        }
        return count;
    }
};

/// Column of the apex over or under a horizontal edge that begins at column 0 of a row.
constexpr std::int32_t apexOf(std::int32_t row)
{
    return leftOf(row) + 1;
}

/// The triangles all three corners of which belong to a region.
TriangleRow trianglesAbove(const LatticeRegion& region, std::int32_t row)
{
    const LatticeRegion::Row& low = region.row(row);
    const LatticeRegion::Row& high = region.row(row + 1);
    return {common(shifted(low, 0, 1), shifted(high, -apexOf(row))),
            common(shifted(high, 0, 1), shifted(low, -apexOf(row + 1)))};
}

LatticeRegion without(const LatticeRegion& region, const LatticeRegion& removed)
{
    std::vector<LatticeRegion::Row> rows;
    for (std::int32_t r = region.firstRow(); r < region.endRow(); ++r) {
        rows.push_back(minus(region.row(r), removed.row(r)));
    }
    return {region.firstRow(), std::move(rows)};
}

std::vector<Site> sitesOf(const LatticeRegion& region)
{
    std::vector<Site> sites;
    for (std::int32_t r = region.firstRow(); r < region.endRow(); ++r) {
        for (const ColumnInterval& i : region.row(r)) {
            for (std::int32_t c = i.begin; c < i.end; ++c) {
                sites.push_back({r, c});
            }
        }
    }
    return sites;
}

void appendPoints(std::vector<Vec2>& points, const LatticeRegion& region, double edge)
{
    for (const Site& site : sitesOf(region)) {
        points.push_back(latticePoint(edge, site.row, site.column));
    }
}

constexpr std::int32_t ceilHalf(std::int32_t n)
{
    return n >= 0 ? (n + 1) / 2 : -(-n / 2);
}

/// The points of a region that belong to the lattice of twice the edge, in that lattice's rows and columns.
LatticeRegion everySecond(const LatticeRegion& region)
{
    const std::int32_t first = ceilHalf(region.firstRow());
    const std::int32_t end = ceilHalf(region.endRow());
    std::vector<LatticeRegion::Row> rows;
    for (std::int32_t r = first; r < end; ++r) {
        // Row r of the coarse lattice has its column c at column 2c + (r odd) of row 2r.
        const std::int32_t odd = r % 2 == 0 ? 0 : 1;
        LatticeRegion::Row row;
        for (const ColumnInterval& i : region.row(2 * r)) {
            const ColumnInterval half{ceilHalf(i.begin - odd), ceilHalf(i.end - odd)};
            if (half.begin < half.end) {
                row.push_back(half);
            }
        }
        rows.push_back(std::move(row));
    }
    return {first, std::move(rows)};
}

}  // namespace

LatticeCore::LatticeCore(const std::vector<std::vector<Vec2>>& polygons, double edge)
    : edge_(edge),
      clear_(pointsInside(polygons, edge, kClearance * edge)),
      fixed_(eroded(clear_), 0),
      regular_(eroded(fixed_.region())),
      seam_grid_(without(fixed_.region(), regular_), 0),
      seam_(sitesOf(seam_grid_.region()))
{
}

std::vector<Vec2> LatticeCore::loosePoints() const
{
    std::vector<Vec2> points;
    appendPoints(points, without(clear_, fixed_.region()), edge_);
    return points;
}

std::vector<std::uint32_t> LatticeCore::seamNumbers() const
{
    std::vector<std::uint32_t> numbers;
    for (const Site& site : seam_) {
        numbers.push_back(fixed_.at(site));
    }
    return numbers;
}

std::vector<std::array<std::uint32_t, 2>> LatticeCore::boundary() const
{
    const LatticeRegion& fixed = fixed_.region();
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::uint32_t k = 0; k < seam_.size(); ++k) {
        const auto [r, c] = seam_[k];
        const std::int32_t left = leftOf(r);
        // The six neighbours, counter-clockwise from the right; every edge is met once from its lower or left end.
        const std::array<Site, 5> around{
            {{r - 1, c + left + 1}, {r, c + 1}, {r + 1, c + left + 1}, {r + 1, c + left}, {r, c - 1}}};
        for (std::size_t i = 1; i <= 3; ++i) {
            const auto [row, column] = around[i];
            const bool one_side = fixed.contains(around[i - 1].row, around[i - 1].column);
            const bool other_side = fixed.contains(around[i + 1].row, around[i + 1].column);
            if (one_side != other_side && fixed.contains(row, column)) {
                edges.push_back({k, seam_grid_.at({row, column})});
            }
        }
    }
    return edges;
}

void LatticeCore::appendTo(PlanarMesh& mesh) const
{
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const LatticeRegion& fixed = fixed_.region();
    mesh.lattice.edge = edge_;
    mesh.vertices.resize(first + fixed_.end());
    for (std::int32_t r = fixed.firstRow(); r < fixed.endRow(); ++r) {
        for (const ColumnInterval& i : fixed.row(r)) {
            mesh.lattice.runs.push_back(
                {r, i.begin, first + fixed_.at({r, i.begin}), static_cast<std::uint32_t>(i.end - i.begin)});
        }
    }
    tbb::parallel_for(std::size_t{0}, mesh.lattice.runs.size(), [&](std::size_t k) {
        const LatticeRun& run = mesh.lattice.runs[k];
        for (std::uint32_t i = 0; i < run.count; ++i) {
            mesh.vertices[run.vertex + i] = latticePoint(edge_, run.row, run.column + static_cast<std::int32_t>(i));
        }
    });

    // First the triangles at the seam, then the regular ones: whoever asks for all but the regular has them in front.
    const auto rows = static_cast<std::size_t>(fixed.endRow() - fixed.firstRow());
    std::vector<TriangleRow> seam(rows);
    std::vector<TriangleRow> regular(rows);
    tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t k) {
        const std::int32_t r = fixed.firstRow() + static_cast<std::int32_t>(k);
        const TriangleRow all = trianglesAbove(fixed, r);
        regular[k] = trianglesAbove(regular_, r);
        seam[k] = {minus(all.up, regular[k].up), minus(all.down, regular[k].down)};
    });
    for (const std::vector<TriangleRow>* part : {&seam, &regular}) {
        mesh.lattice.first_regular_triangle = static_cast<std::uint32_t>(mesh.triangles.size());
        std::vector<std::size_t> starts{mesh.triangles.size()};
        for (const TriangleRow& row : *part) {
            starts.push_back(starts.back() + row.size());
        }
        mesh.triangles.resize(starts.back());
        tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t k) {
            const std::int32_t r = fixed.firstRow() + static_cast<std::int32_t>(k);
            Triangle* out = mesh.triangles.data() + starts[k];
            for (const ColumnInterval& i : (*part)[k].up) {
                std::uint32_t a = first + fixed_.at({r, i.begin});
                std::uint32_t b = first + fixed_.at({r + 1, i.begin + apexOf(r)});
                for (std::int32_t c = i.begin; c < i.end; ++c, ++a, ++b) {
                    *out++ = {a, a + 1, b};
                }
            }
            for (const ColumnInterval& i : (*part)[k].down) {
                std::uint32_t a = first + fixed_.at({r + 1, i.begin});
                std::uint32_t b = first + fixed_.at({r, i.begin + apexOf(r + 1)});
                for (std::int32_t c = i.begin; c < i.end; ++c, ++a, ++b) {
                    *out++ = {b, a + 1, a};
                }
            }
        });
    }
}

std::size_t countTriangles(const LatticeRegion& region)
{
    std::size_t count = 0;
    for (std::int32_t r = region.firstRow(); r < region.endRow(); ++r) {
        count += trianglesAbove(region, r).size();
    }
    return count;
}

std::size_t countClearPoints(const std::vector<std::vector<Vec2>>& polygons, double edge)
{
    return pointsInside(polygons, edge, kClearance * edge).size();
}

std::vector<Vec2> gradedPoints(const std::vector<std::vector<Vec2>>& polygons, double edge, int longest)
{
    std::vector<Vec2> points;
    LatticeRegion region = pointsInside(polygons, edge, kClearance * edge);
    for (; longest > 1; longest /= 2) {
        LatticeRegion inside = region;
        for (int layer = 0; layer < kLayersPerLevel; ++layer) {
            inside = eroded(inside);
        }
        appendPoints(points, without(region, inside), edge);
        region = everySecond(inside);
        edge *= 2.0;
    }
    appendPoints(points, region, edge);
    return points;
}

}  // namespace droplet
