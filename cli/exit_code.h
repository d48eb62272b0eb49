// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/error.h"

namespace cli {

/// The exit codes of the manual page that stand for a kind of failure.
enum class ExitCode { InternalError = 1, Usage = 2, BadInput = 3, BadOutput = 4, NoSuchDroplet = 5 };

inline ExitCode exitCodeOf(droplet::ErrorCode code)
{
    switch (code) {
        case droplet::ErrorCode::InvalidArgument:
            return ExitCode::Usage;
        case droplet::ErrorCode::InvalidInput:
            return ExitCode::BadInput;
        case droplet::ErrorCode::OutputFailed:
            return ExitCode::BadOutput;
        case droplet::ErrorCode::NoSuchDroplet:
            return ExitCode::NoSuchDroplet;
    }
    return ExitCode::InternalError;
}

}  // namespace cli
