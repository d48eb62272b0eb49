// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "droplet/mask/mask.h"

namespace binding {

/// Mask with its origin.
struct Mask {
    droplet::Mask mask;
    std::string path;                 ///< as given; of an array: array
    std::optional<double> threshold;  ///< as given to read_mask
};

/// Mask from a Mask, or from an array of two dimensions, rows from the top.
/// @param from             an array of bool, integers or floating-point numbers of any width. Of two levels, the higher
///                         one is liquid. More levels are coverage: floating-point numbers from 0 to 1, integers from 0
///                         to the largest of uint8 or uint16
/// @throws droplet::Error  InvalidArgument: other shape or type, an empty array, numbers out of range
Mask maskOf(const pybind11::handle& from);

/// A PNG with the pixels of an array of three dimensions: rows from the top, columns, and red, green, blue, and maybe
/// alpha, of uint8.
/// @throws droplet::Error  InvalidArgument: other shape or type, an empty array
std::string pngOf(const pybind11::handle& from);

/// Adds masks to the module.
void bindMask(pybind11::module_& module);

}  // namespace binding
