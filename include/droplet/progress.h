// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace droplet {

/// Stages from a picture to a file, in order.
enum class Stage { Read, Trace, Triangulate, Assemble, Solve, Loft, Write };

/// Name of a stage in reports.
const char* name(Stage stage);

/// Callback at the start of every stage, with share 0, and during a long solve with the share of the wanted amounts
/// that is reached, 0 … 1: of several droplets the mean, rising in steps of 0.01 or more, the last one excepted. Calls
/// come one after another; those with a share may come from another thread. The library reads no clock; a callback that
/// reads one can measure the stages.
using Progress = std::function<void(Stage stage, double share)>;

}  // namespace droplet
