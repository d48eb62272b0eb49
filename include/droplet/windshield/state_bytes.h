// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "droplet/windshield/windshield.h"

namespace droplet {

/// The whole state, exactly; and back again.
/// @throws Error InvalidInput, naming `name`, where it is no such state or cut off
std::string bytesOf(const WindshieldState& state);
WindshieldState stateFromBytes(std::string_view bytes, const std::string& name);

}  // namespace droplet
