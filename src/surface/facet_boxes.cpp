// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/facet_boxes.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace droplet {

FacetBoxes::FacetBoxes(const std::vector<Facet>& facets, double tolerance)
    : order_(facets.size()), centres_(facets.size())
{
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::size_t i = 0; i < facets.size(); ++i) {
        centres_[i] = facets[i].flat[0] + facets[i].flat[1] + facets[i].flat[2];
    }
    build(facets, tolerance, 0, static_cast<std::uint32_t>(facets.size()));
}

void FacetBoxes::build(const std::vector<Facet>& facets, double tolerance, std::uint32_t begin, std::uint32_t end)
{
    const std::size_t self = nodes_.size();
    Node node;
    node.low = node.high = facets[order_[begin]].flat[0];
    Vec2 first = centres_[order_[begin]];
    Vec2 last = first;
    const auto widen = [](Vec2& low, Vec2& high, Vec2 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    };
    for (std::uint32_t i = begin; i < end; ++i) {
        widen(first, last, centres_[order_[i]]);
        for (const Vec2 p : facets[order_[i]].flat) {
            widen(node.low, node.high, p);
        }
    }
    node.low = node.low - Vec2{tolerance, tolerance};
    node.high = node.high + Vec2{tolerance, tolerance};
    nodes_.push_back(node);
    if (end - begin <= kLeaf) {
        nodes_[self].begin = begin;
        nodes_[self].end = end;
    } else {
        const bool by_x = last.x - first.x >= last.y - first.y;
        const auto key = [&](std::uint32_t i) { return by_x ? centres_[i].x : centres_[i].y; };
        const std::uint32_t middle = begin + (end - begin) / 2;
        const auto at = [this](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](std::uint32_t a, std::uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
        build(facets, tolerance, begin, middle);
        build(facets, tolerance, middle, end);
    }
    nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace droplet
