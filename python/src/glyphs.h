// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace binding {

/// Adds droplets of text to the module.
void bindGlyphs(pybind11::module_& module);

}  // namespace binding
