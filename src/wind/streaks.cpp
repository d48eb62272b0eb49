// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind/streaks.h"

#include <cmath>

#include "require.h"

namespace droplet {

void Streaks::validate() const
{
    require(film >= 0.0 && std::isfinite(film), "streaks.film", film, "finite and at least 0 m");
    require(spacing >= 1e-4 && std::isfinite(spacing), "streaks.spacing", spacing, "finite and at least 1e-4 m");
}

}  // namespace droplet
