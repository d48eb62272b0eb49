// SPDX-License-Identifier: GPL-3.0-or-later
//
// Insertion order: N. Amenta, S. Choi and G. Rote, "Incremental constructions con BRIO" (2003). If the points of a
// smooth loop were inserted in their order along it, each would rebuild a part of the triangulation as large as all of
// it.

#include "mesh/triangulation.h"

#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <cstddef>
#include <numeric>
#include <utility>

#include "droplet/error.h"

namespace droplet {

Inserted insert(Triangulation& triangulation, const std::vector<std::vector<Vec2>>& polygons,
                const std::vector<Vec2>& points)
{
    std::vector<Triangulation::Point> all;
    for (const std::vector<Vec2>& polygon : polygons) {
        for (const Vec2 p : polygon) {
            all.emplace_back(p.x, p.y);
        }
    }
    for (const Vec2 p : points) {
        all.emplace_back(p.x, p.y);
    }
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    using Traits = CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::Pointer_property_map<Triangulation::Point>::type>;
    CGAL::spatial_sort(order.begin(), order.end(), Traits(CGAL::make_property_map(all)));
    std::vector<VertexHandle> vertices(all.size());
    Triangulation::Face_handle hint;
    for (const std::size_t i : order) {
        vertices[i] = triangulation.insert(all[i], hint);
        hint = vertices[i]->face();
    }
    if (triangulation.number_of_vertices() != all.size()) {
        throwCrossing();
    }
    Inserted inserted;
    auto next = vertices.begin();
    for (const std::vector<Vec2>& polygon : polygons) {
        const auto end = next + static_cast<std::ptrdiff_t>(polygon.size());
        inserted.loops.emplace_back(next, end);
        next = end;
    }
    inserted.points.assign(next, vertices.end());
    try {
        for (const std::vector<VertexHandle>& loop : inserted.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                triangulation.insert_constraint(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
            }
        }
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
        throwCrossing();
    }
    return inserted;
}

void throwCrossing()
{
    throw Error(ErrorCode::InvalidArgument, "loops of a footprint must not cross or touch");
}

void markDomain(Triangulation& triangulation)
{
    for (auto f = triangulation.all_faces_begin(); f != triangulation.all_faces_end(); ++f) {
        f->set_in_domain(false);
        f->tds_data().clear();
    }
    // From the unbounded face inward; a constraint separates inside and outside.
    std::vector<Triangulation::Face_handle> outside{triangulation.infinite_face()};
    std::vector<Triangulation::Face_handle> inside;
    bool is_inside = false;
    outside.front()->tds_data().mark_processed();
    while (!outside.empty()) {
        std::vector<Triangulation::Face_handle> stack = std::move(outside);
        outside.clear();
        for (const auto& f : stack) {
            f->set_in_domain(is_inside);
        }
        while (!stack.empty()) {
            const Triangulation::Face_handle f = stack.back();
            stack.pop_back();
            for (int i = 0; i < 3; ++i) {
                const Triangulation::Face_handle neighbour = f->neighbor(i);
                if (!neighbour->tds_data().is_clear()) {
                    continue;
                }
                if (f->is_constrained(i)) {
                    outside.push_back(neighbour);
                    continue;
                }
                neighbour->tds_data().mark_processed();
                neighbour->set_in_domain(is_inside);
                stack.push_back(neighbour);
            }
        }
        // A face may be reached from several sides.
        std::vector<Triangulation::Face_handle> fresh;
        for (const auto& f : outside) {
            if (f->tds_data().is_clear()) {
                f->tds_data().mark_processed();
                fresh.push_back(f);
            }
        }
        outside = std::move(fresh);
        is_inside = !is_inside;
    }
}

}  // namespace droplet
