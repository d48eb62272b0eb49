// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "dew_run.h"
#include "droplet/surface/material.h"
#include "files.h"
#include "preview.h"

namespace cli {

/// Output files of the pictures of an object with droplets, which are drawn when they are written; all arguments must
/// live until then.
/// @param material  of the droplets
std::vector<OutputFile> dewPictures(const Dew& dew, const PreviewOptions& options, droplet::Material material);

}  // namespace cli
