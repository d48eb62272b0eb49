// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "surface/charts.h"

namespace droplet {

/// Tree of bounding boxes of triangles, split at the median of their centres. Finds triangles that may contain a point.
class FacetBoxes {
public:
    FacetBoxes() = default;
    /// Builds the tree.
    /// @param tolerance  largest distance of a point outside a triangle
    FacetBoxes(const std::vector<Facet>& facets, double tolerance);

    /// Calls visit_facet(number) for every triangle whose box contains the point, and for some others.
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

    /// Node in depth-first order: its children follow it, and `skip` is the next node after them.
    struct Node {
        Vec2 low;
        Vec2 high;
        std::uint32_t begin = 0;  ///< triangles of a leaf; empty range otherwise
        std::uint32_t end = 0;
        std::uint32_t skip = 0;
    };

    void build(const std::vector<Facet>& facets, double tolerance, std::uint32_t begin, std::uint32_t end);

    std::vector<std::uint32_t> order_;
    std::vector<Vec2> centres_;
    std::vector<Node> nodes_;
};

}  // namespace droplet
