// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>

namespace cli {

/// Beginning of a program's log, up to 4096 bytes.
std::string logText(std::FILE* log);

/// First line of a program's log, without the addresses that ffmpeg's messages contain: [mp4 @ 0x55d0c0de]. They differ
/// from run to run.
std::string firstLine(std::FILE* log);

}  // namespace cli
