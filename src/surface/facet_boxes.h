// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "surface/charts.h"

namespace droplet {

/// Boxes of triangles, halved by their centres until few are left: for a point, the triangles that may hold it.
class FacetBoxes {
public:
    FacetBoxes() = default;
    /// @param hair  how far outside of a triangle a point may lie
    FacetBoxes(const std::vector<Facet>& facets, double hair);

    /// Calls visit_facet(number) for every triangle in whose box the point lies, and others.
    template <class Visit>
    void visit(Vec2 p, const Visit& visit_facet) const
    {
        for (std::uint32_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            const bool inside = p.x >= node.low.x && p.x <= node.high.x && p.y >= node.low.y && p.y <= node.high.y;
            for (std::uint32_t i = node.begin; inside && i < node.end; ++i) {
                visit_facet(order_[i]);
            }
            n = inside ? n + 1 : node.skip;
        }
    }

private:
    static constexpr std::uint32_t kLeaf = 4;  // triangles

    /// In depth-first order: a node is followed by its children; `skip` is the next that is none of them.
    struct Node {
        Vec2 low;
        Vec2 high;
        std::uint32_t begin = 0;  ///< of a leaf's triangles; none otherwise
        std::uint32_t end = 0;
        std::uint32_t skip = 0;
    };

    void build(const std::vector<Facet>& facets, double hair, std::uint32_t begin, std::uint32_t end);

    std::vector<std::uint32_t> order_;
    std::vector<Vec2> centres_;
    std::vector<Node> nodes_;
};

}  // namespace droplet
