// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/error.h"

namespace cli {

/// Exit codes of failures, as in the manual page. After SomeFailed, all that could be made is there.
enum class ExitCode { InternalError = 1, Usage = 2, BadInput = 3, BadOutput = 4, NoSuchDroplet = 5, SomeFailed = 6 };

/// Exit code that stands for an error of the library.
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
