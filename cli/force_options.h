// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "droplet/wind/forces.h"

namespace cli {

/// Declares the options of liquid, air and coating: --contact-angle, --viscosity-factor, --kinetic-fraction,
/// --drag-coefficient, --boundary-layer, --profile-exponent, --air-density, --liquid, --surface-tension, --density,
/// --gravity.
void declareForces(CommandLine& line);

/// Force model in which the given options replace the values of `model`.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
droplet::ForceModel readForces(const CommandLine& line, droplet::ForceModel model);

}  // namespace cli
