// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <string>
#include <string_view>

namespace droplet {

/// Physical dimension of a quantity.
enum class Dimension {
    Length,
    Area,
    Volume,
    Angle,
    SurfaceTension,
    Density,
    Acceleration,
    Speed,
    Duration,
    Rainfall,
    Viscosity
};

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< [rad]
inline constexpr double kMillimetre = 1e-3;                  ///< [m]
inline constexpr double kMicrolitre = 1e-9;                  ///< [m³]
inline constexpr double kMillimetrePerHour = 1e-3 / 3600.0;  ///< [m/s]

/// Reads a quantity with its unit, such as `30uL`, `4 mm`, `45deg`, `72.8mN/m`. A number without a unit is an error,
/// because any unit could be meant.
/// @param text       finite number and a unit, with at most one space between
/// @param dimension  expected dimension, with its units: Length nm um mm cm m in; Area um2 mm2 cm2 m2;
///                   Volume nL uL mL L mm3 cm3 m3; Angle deg rad; SurfaceTension mN/m N/m dyn/cm;
///                   Density kg/m3 g/cm3 g/mL; Acceleration m/s2 mm/s2 g (kStandardGravity); Speed mm/s m/s km/h mph;
///                   Duration ms s min h; Rainfall mm/h in/h; Viscosity mPa.s Pa.s. `µ` is read as `u`, `³`/`²` as
///                   `3`/`2`, `°` as `deg`
/// @return           finite value in SI units: m, m², m³, rad, N/m, kg/m³, m/s², m/s (also for rainfall), s, Pa·s
/// @throws Error     InvalidArgument, with the text, the allowed units and an example
double parseQuantity(std::string_view text, Dimension dimension);

/// Lists the units of a dimension for a message: `nL, uL, mL, L, mm3, cm3 or m3`.
std::string unitsOf(Dimension dimension);

}  // namespace droplet
