// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/sheet_contact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace droplet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;

/// Least upward part of a normal that no rounding makes.
constexpr double kUpward = 1e-6;

/// Whether a sheet is a graph over the plane: nowhere is it upright or upside down, and its rim does not cross itself,
/// so that its projection covers every place once.
bool isGraph(const SheetMesh& sheet)
{
    return std::all_of(sheet.triangles.begin(), sheet.triangles.end(), [&](const Triangle& t) {
        const Vec3 normal = areaVector(sheet.places, t);
        return normal.z > kUpward * length(normal);
    });
}

}  // namespace

std::optional<SheetContact> firstContact(const std::vector<const SheetMesh*>& sheets,
                                         const std::vector<std::size_t>& clusters)
{
    if (sheets.size() == 1 && isGraph(*sheets.front())) {
        return std::nullopt;
    }
    Mesh mesh;
    std::vector<std::size_t> first_face;  // of every sheet
    for (const SheetMesh* sheet : sheets) {
        const auto first = static_cast<std::uint32_t>(mesh.number_of_vertices());
        first_face.push_back(mesh.number_of_faces());
        for (const Vec3& p : sheet->places) {
            mesh.add_vertex({p.x, p.y, p.z});
        }
        for (const Triangle& t : sheet->triangles) {
            mesh.add_face(Mesh::Vertex_index(first + t[0]), Mesh::Vertex_index(first + t[1]),
                          Mesh::Vertex_index(first + t[2]));
        }
    }
    std::vector<std::pair<Face, Face>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
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
