// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "torture/trial.h"

namespace droplet::torture {

/// How items are worked on.
struct WorkOptions {
    std::size_t workers = 1;      ///< processes at a time
    double processor_limit = 20;  ///< an item that takes more is ended [s of processor time]
    double patience = 120;        ///< so is one that does not end in this time [s]
};

/// Runs work(0) … work(count − 1), each once, in processes of their own.
///
/// A process that is ended, by a fault or by a limit, takes only the item it was at with it, which is given the
/// verdict Failed; another process goes on with the next.
/// @param work  called in a child process; may crash
/// @param done  called here, with every index once, in any order
void workThrough(std::size_t count, const std::function<Verdict(std::size_t index)>& work,
                 const std::function<void(std::size_t index, const Verdict& verdict)>& done,
                 const WorkOptions& options);

}  // namespace droplet::torture
