// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/surface/material.h"

namespace cli {

/// Many droplets on one picture.
struct ContactSheet {
    std::string path;
    droplet::Material material = droplet::Material::Water;
    std::vector<std::string> droplets;  ///< files, in their order; their names are the captions
};

/// Reads every droplet again and draws it, smaller the more there are; writes nothing if there are none.
/// @throws droplet::Error InvalidInput, OutputFailed
void writeContactSheet(const ContactSheet& sheet, const droplet::OutputOptions& options);

}  // namespace cli
