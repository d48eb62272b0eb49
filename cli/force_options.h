// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "droplet/units.h"
#include "droplet/wind/forces.h"
#include "option_values.h"

namespace cli {

inline constexpr Range kContactAngle{droplet::Dimension::Angle, droplet::kDegree, 179.0 * droplet::kDegree,
                                     "from 1deg to 179deg"};

/// Declares the options of liquid, air and coating: --contact-angle, --viscosity-factor, --kinetic-fraction,
/// --drag-coefficient, --boundary-layer, --profile-exponent, --air-density, --liquid, --surface-tension, --density,
/// --gravity.
/// @param model  receives most of them by CommandLine::read()
void declareForces(CommandLine& line, droplet::ForceModel& model);

/// Reads the others, after CommandLine::read().
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
void readForces(const CommandLine& line, droplet::ForceModel& model);

}  // namespace cli
