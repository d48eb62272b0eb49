// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "batch_item.h"
#include "batch_options.h"

namespace cli {

/// Refuses a batch that would destroy what it reads or makes: two outputs in one place would each be lost or mixed with
/// the other; an output in an input's place would replace it.
/// @throws droplet::Error InvalidArgument
void refuseClashes(const std::vector<BatchItem>& items, const BatchOptions& options);

}  // namespace cli
