// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/domain/domain.h"

namespace droplet::bench {

/// Domain whose loops have points about `spacing` [m] apart, for other meshers. All points are on the old loops, and
/// all corners are kept.
Domain resampled(const Domain& domain, double spacing);

}  // namespace droplet::bench
