// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "windshield_options.h"

namespace cli {

/// Parameters of a run: the options with the content of their files.
struct WindshieldPlan {
    droplet::WindshieldParameters parameters;
    std::size_t frames = 0;
    std::size_t steps = 1;  ///< time steps per frame
    double step = 0.0;      ///< time step [s]
    std::vector<std::string> warnings;
};

/// Number of frames, at least one; empty if the drive cycle decides it.
std::optional<std::size_t> frameCount(const WindshieldOptions& options);

/// Reads the options' files and makes the plan.
/// @throws droplet::Error InvalidArgument, InvalidInput
WindshieldPlan planOf(const WindshieldOptions& options);

/// Runs a function that may reject the glass, and puts the name of its file before the error message.
template <typename Function>
void forGlass(const WindshieldOptions& options, const Function& function)
{
    try {
        function();
    } catch (const droplet::Error& error) {
        if (!options.surface) {
            throw;
        }
        throw droplet::Error(droplet::ErrorCode::InvalidInput,
                             *options.surface + ": cannot be used as a windshield: " + error.what());
    }
}

}  // namespace cli
