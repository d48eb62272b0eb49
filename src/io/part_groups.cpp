// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/part_groups.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "droplet/error.h"
#include "io/dry_surface.h"

namespace droplet {
namespace {

/// Indices of the surface's parts by the number of their droplet.
std::vector<std::size_t> partsInOrder(const Surface& surface, std::size_t droplets)
{
    std::vector<std::size_t> order(surface.parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return surface.parts[a].droplet < surface.parts[b].droplet; });
    if (order.empty() || surface.parts[order.back()].droplet >= droplets) {
        throw Error(ErrorCode::InvalidArgument, "options.droplets has " + std::to_string(droplets) +
                                                    " entries; the surface must have parts, for these droplets alone");
    }
    return order;
}

}  // namespace

std::vector<Look> looksOf(const std::vector<FileDroplet>& droplets)
{
    std::vector<Look> looks;
    looks.reserve(droplets.size());
    for (const FileDroplet& droplet : droplets) {
        looks.push_back(droplet.look);
    }
    return looks;
}

std::vector<PartGroup> groupParts(const Surface& surface, const Grouping& grouping)
{
    const bool is_each = grouping.nodes == Nodes::Each;
    if (is_each && grouping.droplets.empty()) {
        throw Error(ErrorCode::InvalidArgument, "options.droplets is empty; Nodes::Each needs one for every droplet");
    }
    if (isDry(surface)) {
        return {};
    }
    if (grouping.droplets.empty()) {
        return {{lookOf(grouping.material)}};
    }
    std::vector<PartGroup> groups;
    for (const std::size_t k : partsInOrder(surface, grouping.droplets.size())) {
        const FileDroplet& droplet = grouping.droplets[surface.parts[k].droplet];
        const auto same = is_each ? groups.end()
                                  : std::find_if(groups.begin(), groups.end(),
                                                 [&](const PartGroup& group) { return group.look == droplet.look; });
        if (same != groups.end()) {
            same->parts.push_back(k);
        } else {
            groups.push_back({droplet.look, is_each ? std::optional(droplet) : std::nullopt, {k}});
        }
    }
    return groups;
}

}  // namespace droplet
