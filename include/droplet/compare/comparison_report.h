// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/compare/compare.h"

namespace droplet {

/// Largest differences of two surfaces that count as the same. Each is optional; with any of them, topology must be the
/// same, too.
struct Tolerances {
    std::optional<double> distance;  ///< largest distance of a point of one surface from the other [m]
    std::optional<double> volume;    ///< difference of the volumes, as a share of the first one
    std::optional<double> normals;   ///< root mean square angle between normals [rad]

    /// Whether there is any tolerance.
    [[nodiscard]] bool any() const { return distance || volume || normals; }
};

/// Lists the differences over a tolerance, one line each. Empty: the surfaces count as the same. The upper bound of the
/// distance decides; CompareOptions::tolerance makes this decision exact.
std::vector<std::string> exceeded(const Comparison& comparison, const Tolerances& tolerances);

/// Comparison of two files, with its result.
struct ComparisonReport {
    std::string path_a;                 ///< first file, as given
    std::string path_b;                 ///< second file, as given
    Comparison comparison;              ///< result
    Tolerances tolerances;              ///< as given
    std::vector<std::string> exceeded;  ///< differences over a tolerance
    std::vector<std::string> warnings;  ///< one line each
};

/// Writes a comparison as JSON with the schema `droplet-shape.compare/1`: all keys, in a fixed order, angles in
/// degrees, the rest in SI units. The same comparison gives the same bytes. After an error the stream is in a failed
/// state.
void writeComparison(std::ostream& out, const ComparisonReport& report);

}  // namespace droplet
