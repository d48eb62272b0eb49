// SPDX-License-Identifier: GPL-3.0-or-later
// The trees of src/rays by CGAL, as Embree is no WebAssembly.
#include "rays/triangle_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

#include "rays/ray_tree.h"

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

/// Walk of a ray through the tree, in which its end comes nearer.
struct Cast {
    Vec3 direction;
    Vec3 inverse;  ///< of each coordinate
    double end;
    const std::vector<Corners3>& triangles;
    const std::function<bool(std::uint32_t)>& takes;
    std::optional<std::uint32_t> first = {};

    [[nodiscard]] static bool go_further() { return true; }
    /// T. Möller and B. Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
    void intersection(Vec3 origin, const Primitive& triangle)
    {
        constexpr double kEdge = 1e-9;  // no ray passes between two triangles by rounding
        const auto& [a, b, c] = triangles[triangle.id()];
        const Vec3 across = cross(direction, c - a);
        const Vec3 along = cross(origin - a, b - a);
        const double volume = dot(b - a, across);
        const double u = dot(origin - a, across) / volume;
        const double v = dot(direction, along) / volume;
        const double way = dot(c - a, along) / volume;
        if (u >= -kEdge && v >= -kEdge && u + v <= 1.0 + kEdge && way >= 0.0 && (first ? way < end : way <= end) &&
            (!takes || takes(triangle.id()))) {
            end = way;
            first = triangle.id();
        }
    }
    [[nodiscard]] bool do_intersect(Vec3 origin, const CGAL::AABB_node<Traits>& node) const
    {
        const CGAL::Bbox_3 box = node.bbox();
        double from = 0.0;
        double to = end;
        // Of a ray in the plane of a side, a way is not a number, which max() and min() ignore in their second place.
        const auto cut = [&](double low, double high, double begin, double factor) {
            const double one = factor * (low - kRounding - begin);
            const double other = factor * (high + kRounding - begin);
            from = std::max(from, std::min(one, other));
            to = std::min(to, std::max(one, other));
        };
        cut(box.xmin(), box.xmax(), origin.x, inverse.x);
        cut(box.ymin(), box.ymax(), origin.y, inverse.y);
        cut(box.zmin(), box.zmax(), origin.z, inverse.z);
        return from <= to * (1.0 + kRounding) + kRounding;
    }
};

struct BoxTree {
    std::vector<std::uint32_t> triangles;
    Tree tree;

    /// @param corners  must stay where they are
    explicit BoxTree(const std::vector<Corners3>& corners) : triangles(corners.size())
    {
        std::generate(triangles.begin(), triangles.end(), [k = 0U]() mutable { return k++; });
        tree.insert(triangles.begin(), triangles.end(), corners.data());
        tree.build();
    }
};

/// With coordinates of floats, as Embree has them.
Vec3 rounded(Vec3 p)
{
    return {static_cast<double>(static_cast<float>(p.x)), static_cast<double>(static_cast<float>(p.y)),
            static_cast<double>(static_cast<float>(p.z))};
}

std::vector<Corners3> rounded(std::vector<Corners3> triangles)
{
    for (Corners3& corners : triangles) {
        for (Vec3& p : corners) {
            p = rounded(p);
        }
    }
    return triangles;
}

}  // namespace

struct TriangleTree::Boxes : BoxTree {
    using BoxTree::BoxTree;
};

TriangleTree::TriangleTree(const std::vector<Corners3>& triangles) : boxes_(std::make_unique<Boxes>(triangles)) {}

TriangleTree::~TriangleTree() = default;

void TriangleTree::visit(Vec3 p, double radius, const std::function<double(std::uint32_t)>& visit) const
{
    Search search{visit, radius};
    boxes_->tree.traversal(p, search);
}

struct RayTree::Scene {
    std::vector<Corners3> triangles;
    BoxTree boxes{triangles};
};

RayTree::RayTree(const std::vector<Corners3>& triangles) : scene_(new Scene{rounded(triangles)}) {}

RayTree::~RayTree() = default;
RayTree::RayTree(RayTree&& other) noexcept = default;

std::optional<std::uint32_t> RayTree::first(Vec3 origin, Vec3 direction, double end,
                                            const std::function<bool(std::uint32_t)>& takes) const
{
    const Vec3 d = rounded(direction);
    Cast cast{d, {1.0 / d.x, 1.0 / d.y, 1.0 / d.z}, end, scene_->triangles, takes};
    scene_->boxes.tree.traversal(rounded(origin), cast);
    return cast.first;
}

}  // namespace droplet
