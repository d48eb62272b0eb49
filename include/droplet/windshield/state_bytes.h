// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "droplet/windshield/windshield.h"

namespace droplet {

/// Exact bytes of a complete state.
std::string bytesOf(const WindshieldState& state);

/// State from its bytes.
/// @param bytes   bytes of bytesOf()
/// @param name    name of the source for error messages
/// @throws Error  InvalidInput if the bytes are damaged, cut off or not a state
WindshieldState stateFromBytes(std::string_view bytes, const std::string& name);

}  // namespace droplet
