// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_droplets.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace cli {

std::vector<droplet::FileDroplet> fileDroplets(const std::vector<droplet::DropletReport>& droplets,
                                               const FileLooks& looks, std::vector<std::string>& warnings)
{
    std::vector<droplet::FileDroplet> all;
    const bool by_colour = std::any_of(droplets.begin(), droplets.end(), [](const auto& each) { return each.colour; });
    if (looks.nodes == droplet::Nodes::One && !looks.materials && !by_colour) {
        return all;
    }
    std::vector<droplet::Look> own(droplets.size(), droplet::lookOf(looks.material));
    for (std::size_t k = 0; k < droplets.size(); ++k) {
        if (const auto& colour = droplets[k].colour) {
            own[k] = inColour(std::move(own[k]), *colour);
            own[k].name = droplet::fileName(*colour);
        }
    }
    if (looks.materials) {
        for (std::string& warning : applyMaterials(*looks.materials, own)) {
            warnings.push_back(std::move(warning));
        }
    }
    std::map<std::string, std::size_t> counts;
    for (std::size_t k = 0; k < droplets.size(); ++k) {
        const droplet::DropletReport& each = droplets[k];
        const std::string kind = each.colour ? droplet::fileName(*each.colour) : "droplet";
        all.push_back({fmt::format("{}_{}", kind, ++counts[kind]), own[k], each.figures.volume,
                       each.figures.contact_angle.mean, each.figures.height_max, each.pressure});
    }
    return all;
}

}  // namespace cli
