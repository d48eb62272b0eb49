// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/footprint/domain.h"

namespace droplet::bench {

/// A domain whose loops have points about `spacing` apart, all of them on the old loops and every corner among them:
/// what other programs are given to mesh [m].
Domain resampled(const Domain& domain, double spacing);

}  // namespace droplet::bench
