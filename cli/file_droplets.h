// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/io/report.h"
#include "droplet/surface/material.h"
#include "materials_file.h"

namespace cli {

/// How files show droplets.
struct FileLooks {
    droplet::Material material = droplet::Material::Water;  ///< of all, before colours and `materials`
    droplet::Nodes nodes = droplet::Nodes::One;
    const std::optional<Materials>& materials;
};

/// Names, looks and figures of the droplets in files. Empty if all are alike and need no names.
/// @param droplets  of the report; their colours become their looks
/// @param warnings  receives warnings about the file of materials
std::vector<droplet::FileDroplet> fileDroplets(const std::vector<droplet::DropletReport>& droplets,
                                               const FileLooks& looks, std::vector<std::string>& warnings);

}  // namespace cli
