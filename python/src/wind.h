// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace binding {

/// Adds wind tunnel, windshield, flow and dew to the module.
void bindWind(pybind11::module_& module);

}  // namespace binding
