// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "shape/sheet_newton.h"

namespace droplet {

/// Limits of a predicted step: no triangle turns by more than 22°.
inline constexpr MotionLimits kPredicted{0.927, 0.4, 2.5};
/// Limits of Newton's method from a start that no tangent predicts.
inline constexpr NewtonLimits kSettling{.steps = 14, .shifted_steps = 8, .worn = 0.4, .factorisations = 40};
/// Relative residual of equilibria on the way to the final triangles, which change them by more. With 1e-9 the 255
/// silhouettes took a quarter longer, and ended within 1 % of the same volumes.
inline constexpr double kOnTheWay = 1e-5;
/// Angle of a triangle, over that when it was made, below which it is moved along the sheet, or made anew.
inline constexpr double kWorn = 0.7;
/// Smallest step, over the whole way, most work, in factorisations, and smoothings of triangles that stay.
inline constexpr double kKeptStep = 0.03;
inline constexpr double kKeptWork = 60.0;
inline constexpr int kRelaxations = 5;

}  // namespace droplet
