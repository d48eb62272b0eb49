// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace binding {

/// Adds the difference of surfaces to the module.
void bindComparison(pybind11::module_& module);

}  // namespace binding
