// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace binding {

/// Adds the class Windshield, which advances with its caller's frames.
void bindWindshield(pybind11::module_& module);

}  // namespace binding
