// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace binding {

/// Turns droplet::Error into exceptions of droplet_shape._errors.
void registerErrors();

}  // namespace binding
