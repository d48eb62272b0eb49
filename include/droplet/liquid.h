// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace droplet {

inline constexpr double kStandardGravity = 9.81;  ///< [m/s²], the house's default, not the CODATA 9.80665

/// A liquid in air.
struct Liquid {
    std::string name = "water";
    double surface_tension = 0.0728;  ///< σ [N/m], > 0
    double density = 998.2;           ///< ρ [kg/m³], ≥ 0

    /// Guarantees: returns only when every field is in its documented range.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// The liquids known by name, water first; values at 20 °C, their sources beside them in the source file.
const std::vector<Liquid>& liquids();

/// The liquid of that name.
/// @param name    lower case, as in liquids()
/// @throws Error  InvalidArgument, listing the names known
const Liquid& liquidNamed(std::string_view name);

/// √(σ/(ρ|g|)), the length beyond which gravity tells [m]; empty where the liquid weighs nothing.
/// @param gravity  of either sign [m/s²]
std::optional<double> capillaryLength(const Liquid& liquid, double gravity);

}  // namespace droplet
