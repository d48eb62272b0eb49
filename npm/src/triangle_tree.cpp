// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of src/rays/triangle_tree.cpp by CGAL, as Embree is no WebAssembly.
#include "rays/triangle_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

namespace droplet {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

/// A triangle, as CGAL's trees have them.
class Primitive {
public:
    using Id = std::uint32_t;
    using Point = Kernel::Point_3;
    using Datum = Kernel::Triangle_3;
    using Shared_data = const Corners3*;

    Primitive() = default;
    template <typename Iterator>
    Primitive(Iterator id, Shared_data) : id_(*id)
    {
    }

    static Shared_data construct_shared_data(Shared_data triangles) { return triangles; }
    [[nodiscard]] Id id() const { return id_; }
    [[nodiscard]] Datum datum(Shared_data triangles) const
    {
        const auto& [a, b, c] = triangles[id_];
        return {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
    }
    [[nodiscard]] Point reference_point(Shared_data triangles) const
    {
        const Vec3 a = triangles[id_][0];
        return {a.x, a.y, a.z};
    }

private:
    Id id_ = 0;
};

using Traits = CGAL::AABB_traits<Kernel, Primitive>;
using Tree = CGAL::AABB_tree<Traits>;

/// Rounding of the distances of boxes.
constexpr double kRounding = 1e-14;

/// Walk through the tree, in which the radius shrinks.
struct Search {
    const std::function<double(std::uint32_t)>& visit;
    double radius;

    [[nodiscard]] static bool go_further() { return true; }
    void intersection(Vec3, const Primitive& triangle) { radius = std::min(radius, visit(triangle.id())); }
    [[nodiscard]] bool do_intersect(Vec3 p, const CGAL::AABB_node<Traits>& node) const
    {
        const CGAL::Bbox_3 box = node.bbox();
        const auto gap = [](double x, double low, double high) { return std::max({0.0, low - x, x - high}); };
        const Vec3 away{gap(p.x, box.xmin(), box.xmax()), gap(p.y, box.ymin(), box.ymax()),
                        gap(p.z, box.zmin(), box.zmax())};
        return length(away) <= radius * (1.0 + kRounding) + kRounding;
    }
};

std::vector<std::uint32_t> indices(std::size_t count)
{
    std::vector<std::uint32_t> all(count);
    std::generate(all.begin(), all.end(), [k = 0U]() mutable { return k++; });
    return all;
}

}  // namespace

struct TriangleTree::Boxes {
    std::vector<std::uint32_t> triangles;
    Tree tree;
};

TriangleTree::TriangleTree(const std::vector<Corners3>& triangles)
    : boxes_(std::make_unique<Boxes>(Boxes{indices(triangles.size()), {}}))
{
    boxes_->tree.insert(boxes_->triangles.begin(), boxes_->triangles.end(), triangles.data());
    boxes_->tree.build();
}

TriangleTree::~TriangleTree() = default;

void TriangleTree::visit(Vec3 p, double radius, const std::function<double(std::uint32_t)>& visit) const
{
    Search search{visit, radius};
    boxes_->tree.traversal(p, search);
}

}  // namespace droplet
