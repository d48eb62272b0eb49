// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Compensated sum: many small terms without loss by rounding (A. Neumaier, "Rundungsfehleranalyse einiger Verfahren
/// zur Summation endlicher Summen", ZAMM 54 (1974) 39).
struct CompensatedSum {
    double sum = 0.0;    ///< rounded sum
    double carry = 0.0;  ///< sum of the rounding errors

    /// Adds a term.
    void add(double term);
    /// Compensated value.
    [[nodiscard]] double value() const { return sum + carry; }

    friend bool operator==(const CompensatedSum&, const CompensatedSum&) = default;  ///< Compares all members.
};

}  // namespace droplet
