// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>
#include <tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace binding {

/// Lets other threads of Python run, and limits the number of threads of the library, until the end of its scope.
class Work {
public:
    /// @param threads  empty for all cores
    explicit Work(const std::optional<std::size_t>& threads)
    {
        if (threads) {
            limit_.emplace(tbb::global_control::max_allowed_parallelism, *threads);
        }
    }

private:
    pybind11::gil_scoped_release release_;
    std::optional<tbb::global_control> limit_;
};

}  // namespace binding
