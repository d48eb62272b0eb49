// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Becomes the program of what moves.
/// @param argv            the program's name, a command of that program, and its arguments
/// @throws droplet::Error InvalidArgument: it is missing
[[noreturn]] void becomeMotion(const char* const* argv);

}  // namespace cli
