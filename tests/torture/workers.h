// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "torture/trial.h"

namespace droplet::torture {

/// Options of the worker processes.
struct WorkOptions {
    std::size_t workers = 1;      ///< number of processes
    double processor_limit = 20;  ///< limit per item [s of processor time]
    double patience = 120;        ///< limit per item [s of real time]
};

/// Runs work(0) … work(count − 1), each once, in child processes.
///
/// If a fault or a limit ends a process, only its current item gets the verdict Failed; another process continues with
/// the next item.
/// @param work  called in a child process; may crash
/// @param done  called in this process, once per index, in any order
void workThrough(std::size_t count, const std::function<Verdict(std::size_t index)>& work,
                 const std::function<void(std::size_t index, const Verdict& verdict)>& done,
                 const WorkOptions& options);

}  // namespace droplet::torture
