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

Hits findHits(const Surface& surface, const Atlas& atlas, const std::vector<Vec2>& flat,
              const std::function<bool(const Facet&, Vec2)>& is_there)
{
    struct Block {
        std::vector<Hit> hits;
        std::vector<std::size_t> cut;  ///< vertices over what is cut out
    };
    Hits hits;
    hits.starts.assign(flat.size() + 1, 0);
    hits.is_cut.assign(flat.size(), false);
    for (const Block& block : mapBlocks<Block>(flat.size(), [&](std::size_t begin, std::size_t end) {
             Block found;
             for (std::size_t v = begin; v < end; ++v) {
                 const Vec2 p = flat[surface.weld[v]];
                 for (Hit hit : atlas.at(p)) {
                     if (is_there && !is_there(atlas.facets[hit.facet], p)) {
                         found.cut.push_back(v);
                         continue;
                     }
                     hit.vertex = static_cast<std::uint32_t>(v);
                     found.hits.push_back(hit);
                 }
             }
             return found;
         })) {
        for (const Hit& hit : block.hits) {
            ++hits.starts[hit.vertex + 1];
        }
        hits.all.insert(hits.all.end(), block.hits.begin(), block.hits.end());
        for (const std::size_t v : block.cut) {
            hits.is_cut[v] = true;
        }
    }
    std::partial_sum(hits.starts.begin(), hits.starts.end(), hits.starts.begin());
    return hits;
}

std::vector<DropletPlacement> placeDroplets(const Hits& hits, const DropletNumbers& droplets)
{
    std::vector<DropletPlacement> placements(droplets.count);
    std::vector<std::optional<std::vector<std::uint32_t>>> common(droplets.count);
    std::vector<bool> is_cut(droplets.count, false);
    for (std::size_t v = 0; v < droplets.of.size(); ++v) {
        const std::uint32_t d = droplets.of[v];
        if (d == DropletNumbers::kNone) {
            continue;
        }
        auto& charts = common[d];
        is_cut[d] = is_cut[d] || hits.is_cut[v];
        if (hits.at(v).empty()) {
            placements[d].result = PlacementResult::Outside;
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
        DropletPlacement& placement = placements[d];
        if (placement.result == PlacementResult::Placed && common[d]->empty()) {
            placement.result = PlacementResult::Across;
        }
        if (placement.result == PlacementResult::Placed) {
            placement.chart = common[d]->front();
        } else if (is_cut[d]) {
            placement.result = PlacementResult::CutOut;
        }
    }
    return placements;
}

}  // namespace droplet
