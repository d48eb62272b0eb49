// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/surface/material.h"

namespace cli {

/// Many droplets on one picture.
struct ContactSheet {
    std::string path;
    droplet::Material material = droplet::Material::Water;
    bool one_scale = false;             ///< as large beside one another as they are; else each fills its tile
    std::vector<std::string> droplets;  ///< files, in their order; their names are the captions
};

/// Reads every droplet again and draws it at the size at which it is shown, smaller the more there are, several at one
/// time; writes nothing if there are none. The bytes do not depend on the number of threads.
/// @param drawn           told after every droplet how many are drawn, by one thread at a time
/// @throws droplet::Error InvalidInput, OutputFailed
void writeContactSheet(const ContactSheet& sheet, const droplet::OutputOptions& options,
                       const std::function<void(std::size_t)>& drawn);

}  // namespace cli
