// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"
#include "droplet/wind/forces.h"

namespace cli {

/// Liquid, air and coating: --contact-angle, --viscosity-factor, --kinetic-fraction, --drag-coefficient,
/// --boundary-layer, --profile-exponent, --air-density, --liquid, --surface-tension, --density, --gravity.
void declareForces(CommandLine& line);

/// A model with what the options say in place of its own.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
droplet::ForceModel readForces(const CommandLine& line, droplet::ForceModel model);

}  // namespace cli
