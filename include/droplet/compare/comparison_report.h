// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/compare/compare.h"

namespace droplet {

/// How far two surfaces may differ and still count as the same. Each is asked for or not; with any of them, topology
/// must be the same.
struct Tolerances {
    std::optional<double> distance;  ///< largest, of either surface's points from the other [m]
    std::optional<double> volume;    ///< share of the first one's volume
    std::optional<double> normals;   ///< rms angle between normals [rad]

    [[nodiscard]] bool any() const { return distance || volume || normals; }
};

/// What of two surfaces differs by more than a tolerance, a line each; empty: they count as the same. A distance does
/// when its upper bound is over the tolerance; compare with CompareOptions::tolerance so that this is the truth.
std::vector<std::string> exceeded(const Comparison& comparison, const Tolerances& tolerances);

/// A comparison of two files and what came of it.
struct ComparisonReport {
    std::string path_a;  ///< as given
    std::string path_b;  ///< as given
    Comparison comparison;
    Tolerances tolerances;
    std::vector<std::string> exceeded;
    std::vector<std::string> warnings;
};

/// Writes a comparison as JSON, schema `droplet-shape.compare/1`: every key always present, in a fixed order, angles in
/// degrees, the rest in SI units. The same comparison gives the same bytes.
///
/// The stream is left failed if it did not take everything.
void writeComparison(std::ostream& out, const ComparisonReport& report);

}  // namespace droplet
