// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/sheet_contact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace droplet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;

/// Least upward part of a normal that no rounding makes.
constexpr double kUpward = 1e-6;
/// Triangles beside each other in a cell of the grid that finds what is above others.
constexpr double kInCell = 2.0;
/// Most cells along a side.
constexpr double kMostCells = 4096.0;

/// Box around a triangle, seen from above.
struct Shadow {
    Vec2 low;
    Vec2 high;

    Shadow(const std::vector<Vec3>& vertices, const Triangle& t) : low{vertices[t[0]].x, vertices[t[0]].y}, high(low)
    {
        for (const std::uint32_t v : t) {
            low = {std::min(low.x, vertices[v].x), std::min(low.y, vertices[v].y)};
            high = {std::max(high.x, vertices[v].x), std::max(high.y, vertices[v].y)};
        }
    }
};

/// Faces that may touch others: those above or below one that does not face up. Where all face up, sheets cover every
/// place once; and where one breaks through another from below, it does so through its lower side, too.
std::vector<Face> facesNearFolds(const std::vector<const CapillarySurface*>& sheets)
{
    std::vector<Shadow> shadows;
    std::vector<std::uint8_t> is_upward;
    Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 high = -1.0 * low;
    double width = 0.0;
    for (const CapillarySurface* sheet : sheets) {
        for (const Triangle& t : sheet->triangles) {
            const Vec3 normal = areaVector(sheet->vertices, t);
            is_upward.push_back(normal.z > kUpward * length(normal) ? 1 : 0);
            const Shadow& shadow = shadows.emplace_back(sheet->vertices, t);
            low = {std::min(low.x, shadow.low.x), std::min(low.y, shadow.low.y)};
            high = {std::max(high.x, shadow.high.x), std::max(high.y, shadow.high.y)};
            width += std::max(shadow.high.x - shadow.low.x, shadow.high.y - shadow.low.y);
        }
    }
    std::vector<Face> faces;
    if (std::find(is_upward.begin(), is_upward.end(), 0) == is_upward.end()) {
        return faces;
    }
    const double extent = std::max(high.x - low.x, high.y - low.y);
    const double cell = std::max(kInCell * width / static_cast<double>(shadows.size()), extent / kMostCells);
    const auto columns = static_cast<std::size_t>((high.x - low.x) / cell) + 1;
    const auto rows = static_cast<std::size_t>((high.y - low.y) / cell) + 1;
    std::vector<std::uint8_t> is_folded(columns * rows, 0);
    /// Calls use() for the cells of a shadow, until it returns true.
    const auto any_cell = [&](const Shadow& shadow, const auto& use) {
        const auto first = static_cast<std::size_t>((shadow.low.x - low.x) / cell);
        const auto last = static_cast<std::size_t>((shadow.high.x - low.x) / cell);
        const auto top = static_cast<std::size_t>((shadow.high.y - low.y) / cell);
        for (auto row = static_cast<std::size_t>((shadow.low.y - low.y) / cell); row <= top; ++row) {
            for (std::size_t column = first; column <= last; ++column) {
                if (use(is_folded[row * columns + column])) {
                    return true;
                }
            }
        }
        return false;
    };
    for (std::size_t k = 0; k < shadows.size(); ++k) {
        if (is_upward[k] == 0) {
            any_cell(shadows[k], [](std::uint8_t& cell_folded) {
                cell_folded = 1;
                return false;
            });
        }
    }
    for (std::size_t k = 0; k < shadows.size(); ++k) {
        if (any_cell(shadows[k], [](std::uint8_t cell_folded) { return cell_folded != 0; })) {
            faces.emplace_back(static_cast<Face::size_type>(k));
        }
    }
    return faces;
}

}  // namespace

std::optional<SheetContact> firstContact(const std::vector<const CapillarySurface*>& sheets,
                                         const std::vector<std::size_t>& clusters)
{
    const std::vector<Face> faces = facesNearFolds(sheets);
    if (faces.empty()) {
        return std::nullopt;
    }
    Mesh mesh;
    std::vector<std::size_t> first_face;  // of every sheet
    for (const CapillarySurface* sheet : sheets) {
        const auto first = static_cast<std::uint32_t>(mesh.number_of_vertices());
        first_face.push_back(mesh.number_of_faces());
        for (const Vec3& p : sheet->vertices) {
            mesh.add_vertex({p.x, p.y, p.z});
        }
        for (const Triangle& t : sheet->triangles) {
            mesh.add_face(Mesh::Vertex_index(first + t[0]), Mesh::Vertex_index(first + t[1]),
                          Mesh::Vertex_index(first + t[2]));
        }
    }
    std::vector<std::pair<Face, Face>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(faces, mesh, std::back_inserter(pairs));
    const auto sheet_of = [&](Face face) {
        const auto after = std::upper_bound(first_face.begin(), first_face.end(), static_cast<std::size_t>(face));
        return static_cast<std::size_t>(after - first_face.begin()) - 1;
    };
    if (!clusters.empty()) {
        std::erase_if(pairs, [&](const auto& pair) {
            const std::size_t a = sheet_of(pair.first);
            const std::size_t b = sheet_of(pair.second);
            return a != b && clusters[a] == clusters[b];
        });
    }
    if (pairs.empty()) {
        return std::nullopt;
    }
    for (auto& [one, other] : pairs) {
        if (other < one) {
            std::swap(one, other);
        }
    }
    const auto [one, other] = *std::min_element(pairs.begin(), pairs.end());
    Vec3 centre;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(one))) {
        const auto& p = mesh.point(v);
        centre = centre + (1.0 / 3.0) * Vec3{p.x(), p.y(), p.z()};
    }
    return SheetContact{sheet_of(one), sheet_of(other), centre};
}

}  // namespace droplet
