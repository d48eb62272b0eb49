// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace droplet {

inline constexpr double kStandardGravity = 9.81;  ///< default gravity [m/s²]; the CODATA value is 9.80665

/// A liquid in air.
struct Liquid {
    std::string name = "water";       ///< name in reports
    double surface_tension = 0.0728;  ///< σ [N/m], > 0
    double density = 998.2;           ///< ρ [kg/m³], ≥ 0

    friend bool operator==(const Liquid&, const Liquid&) = default;  ///< Compares all members.

    /// Checks that every field is in its documented range.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// All liquids known by name, water first; values at 20 °C, with their sources in src/liquid.cpp.
const std::vector<Liquid>& liquids();

/// Finds a liquid by its name.
/// @param name    lower case, as in liquids()
/// @throws Error  InvalidArgument, with the list of known names
const Liquid& liquidNamed(std::string_view name);

/// Capillary length √(σ/(ρ|g|)) [m]: gravity flattens droplets that are larger. Empty for a liquid without weight.
/// @param liquid   valid
/// @param gravity  any sign [m/s²]
std::optional<double> capillaryLength(const Liquid& liquid, double gravity);

}  // namespace droplet
