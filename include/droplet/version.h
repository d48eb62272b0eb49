// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

inline constexpr const char* kVersion = "0.3.0";  ///< version of this library

}  // namespace droplet
