// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace droplet {

/// A vehicle's speed over time: linear between rows, the first one's before them and the last one's after.
struct DriveCycle {
    std::vector<double> times{0.0};   ///< [s], rising, finite; at least one
    std::vector<double> speeds{0.0};  ///< [m/s], ≥ 0, finite; as many

    /// @param time  [s], any
    /// @return      [m/s]
    [[nodiscard]] double speedAt(double time) const;

    /// @param from, to  [s], from < to
    /// @return          mean acceleration from one time to the other [m/s²]
    [[nodiscard]] double meanAcceleration(double from, double to) const;

    /// Guarantees: returns only when the invariants hold.
    /// @throws Error InvalidArgument
    void validate() const;

    friend bool operator==(const DriveCycle&, const DriveCycle&) = default;
};

/// The same speed always.
/// @param speed  [m/s], ≥ 0
DriveCycle constantSpeed(double speed);

}  // namespace droplet
