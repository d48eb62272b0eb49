// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace droplet {

/// Speed of a vehicle over time: linear between rows, constant before the first row and after the last row.
struct DriveCycle {
    std::vector<double> times{0.0};   ///< [s], ascending, finite; at least one
    std::vector<double> speeds{0.0};  ///< [m/s], ≥ 0, finite; one for each time

    /// Speed at any time [m/s].
    /// @param time  [s]
    [[nodiscard]] double speedAt(double time) const;

    /// Mean acceleration between two times [m/s²].
    /// @param from  [s]
    /// @param to    [s], > from
    [[nodiscard]] double meanAcceleration(double from, double to) const;

    /// Checks both lists.
    /// @throws Error InvalidArgument if a value is out of its range or the lengths differ
    void validate() const;

    friend bool operator==(const DriveCycle&, const DriveCycle&) = default;  ///< Compares all members.
};

/// Drive cycle with a constant speed.
/// @param speed  [m/s], ≥ 0
DriveCycle constantSpeed(double speed);

}  // namespace droplet
