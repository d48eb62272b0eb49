// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace binding {

/// Adds sequences of droplets to the module.
void bindAnimation(pybind11::module_& module);

}  // namespace binding
