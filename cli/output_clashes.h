// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "batch_item.h"
#include "batch_options.h"

namespace cli {

/// Refuses a batch in which two outputs have the same path, or an output would replace an input.
/// @throws droplet::Error InvalidArgument
void refuseClashes(const std::vector<BatchItem>& items, const BatchOptions& options);

}  // namespace cli
