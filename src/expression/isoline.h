// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/outline/outline.h"
#include "field.h"

namespace droplet {

/// Lines along which a field has the value kIso, with greater values on their left.
///
/// Guarantees: lines are closed and cross neither themselves nor one another. Where two corners of a square of the grid
/// are inside, diagonally, the mean of the four decides whether they are connected.
std::vector<Loop> isolines(const Field& field);

}  // namespace droplet
