// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "windshield_options.h"

namespace cli {

/// What a run plays: the options with what their files hold.
struct WindshieldPlan {
    droplet::WindshieldParameters parameters;
    std::size_t frames = 0;
    std::size_t steps = 1;  ///< for each frame
    double step = 0.0;      ///< [s]
    std::vector<std::string> warnings;
};

/// @throws droplet::Error InvalidArgument, InvalidInput
WindshieldPlan planOf(const WindshieldOptions& options);

/// Runs what may find the glass unfit, and puts its file's or option's name before the complaint.
template <typename Function>
void forGlass(const WindshieldOptions& options, const Function& function)
{
    try {
        function();
    } catch (const droplet::Error& error) {
        if (options.surface) {
            throw droplet::Error(droplet::ErrorCode::InvalidInput, *options.surface + ": as a glass: " + error.what());
        }
        throw droplet::Error(error.code(),
                             std::string("--glass-width, --eye-distance, --eye, --look-at: ") + error.what());
    }
}

}  // namespace cli
