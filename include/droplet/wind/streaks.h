// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Film that running droplets leave behind: as wide as they are, it breaks up into still droplets.
struct Streaks {
    double film = 0.0;      ///< thickness [m], ≥ 0; 0: no film, as on water-repellent glass
    double spacing = 4e-3;  ///< mean distance of the still droplets [m], at least 0.1 mm

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

}  // namespace droplet
