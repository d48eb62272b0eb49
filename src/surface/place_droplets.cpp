// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/place_droplets.h"

#include <numeric>
#include <optional>

#include "blocks.h"
#include "union_find.h"

namespace droplet {

DropletNumbers numberDroplets(const Surface& surface)
{
    UnionFind sets(surface.vertices.size());
    for (std::uint32_t v = 0; v < surface.weld.size(); ++v) {
        sets.join(v, surface.weld[v]);
    }
    for (const Triangle& t : surface.triangles) {
        sets.join(t[0], t[1]);
        sets.join(t[1], t[2]);
    }
    constexpr std::uint32_t kNone = DropletNumbers::kNone;
    std::vector<std::uint32_t> number(surface.vertices.size(), kNone);
    DropletNumbers droplets;
    for (const Triangle& t : surface.triangles) {
        std::uint32_t& own = number[sets.find(t[0])];
        own = own == kNone ? droplets.count++ : own;
    }
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        droplets.of.push_back(number[sets.find(v)]);
    }
    return droplets;
}

Hits findHits(const Surface& surface, const Atlas& atlas, const std::vector<Vec2>& flat)
{
    Hits hits;
    hits.starts.assign(flat.size() + 1, 0);
    for (const std::vector<Hit>&block :
         mapBlocks<std::vector<Hit>>(flat.size(), [&](std::size_t begin, std::size_t end) {
             std::vector<Hit> found;
             for (std::size_t v = begin; v < end; ++v) {
                 for (Hit hit : atlas.at(flat[surface.weld[v]])) {
                     hit.vertex = static_cast<std::uint32_t>(v);
                     found.push_back(hit);
                 }
             }
             return found;
         })) {
        for (const Hit& hit : block) {
            ++hits.starts[hit.vertex + 1];
        }
        hits.all.insert(hits.all.end(), block.begin(), block.end());
    }
    std::partial_sum(hits.starts.begin(), hits.starts.end(), hits.starts.begin());
    return hits;
}

std::vector<DropletPlacement> placeDroplets(const Hits& hits, const DropletNumbers& droplets)
{
    std::vector<DropletPlacement> placements(droplets.count);
    std::vector<std::optional<std::vector<std::uint32_t>>> common(droplets.count);
    for (std::size_t v = 0; v < droplets.of.size(); ++v) {
        if (droplets.of[v] == DropletNumbers::kNone) {
            continue;
        }
        DropletPlacement& placement = placements[droplets.of[v]];
        auto& charts = common[droplets.of[v]];
        if (hits.at(v).empty()) {
            placement.result = PlacementResult::Outside;
        } else if (!charts) {
            charts.emplace();
            for (const Hit& hit : hits.at(v)) {
                charts->push_back(hit.chart);
            }
        } else {
            std::erase_if(*charts, [&](std::uint32_t chart) { return hits.on(v, chart) == nullptr; });
        }
    }
    for (std::uint32_t d = 0; d < droplets.count; ++d) {
        if (placements[d].result == PlacementResult::Outside) {
            continue;
        }
        if (common[d]->empty()) {
            placements[d].result = PlacementResult::Across;
        } else {
            placements[d].chart = common[d]->front();
        }
    }
    return placements;
}

}  // namespace droplet
