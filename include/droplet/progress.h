// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace droplet {

/// Stages from a picture to a file, in order.
enum class Stage { Read, Trace, Triangulate, Assemble, Solve, Loft, Write };

/// Name of a stage in reports.
const char* name(Stage stage);

/// Callback at the start of every stage, on the calling thread. The library reads no clock; a callback that reads one
/// can measure the stages.
using Progress = std::function<void(Stage stage)>;

}  // namespace droplet
