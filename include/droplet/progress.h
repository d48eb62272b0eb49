// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace droplet {

/// The stages from a picture to a file, in order.
enum class Stage { Read, Trace, Triangulate, Assemble, Solve, Loft, Write };

/// The name a stage has in reports.
const char* name(Stage stage);

/// Called from the calling thread whenever a stage begins. Whoever wants to know how long
/// stages take reads a clock there; the library reads none.
using Progress = std::function<void(Stage stage)>;

}  // namespace droplet
