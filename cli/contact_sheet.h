// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/render/object_stand.h"
#include "droplet/surface/material.h"

namespace cli {

/// Contact sheet: many droplets on one picture.
struct ContactSheet {
    std::string path;
    droplet::Material material = droplet::Material::Water;
    bool one_scale = false;             ///< draw all droplets at one scale; otherwise each fills its tile
    std::vector<std::string> droplets;  ///< files, in the order of the tiles; their names are the captions
    std::shared_ptr<const droplet::ObjectStand> object =
        {};  ///< in each of these files, below its droplets; null: none
};

/// Reads all droplets from their files, draws them in parallel, and writes the sheet, if there is at least one. The
/// more droplets, the smaller the tiles. The bytes do not depend on the number of threads.
/// @param drawn           called after every droplet with the number of drawn ones, by one thread at a time
/// @throws droplet::Error InvalidInput, OutputFailed
void writeContactSheet(const ContactSheet& sheet, const droplet::OutputOptions& options,
                       const std::function<void(std::size_t)>& drawn);

}  // namespace cli
