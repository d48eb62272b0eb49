// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "commands.h"
#include "dew_command.h"
#include "flow_command.h"
#include "liquid2d_command.h"
#include "morph_command.h"
#include "wind_tunnel_command.h"
#include "windshield_command.h"

namespace cli {

std::span<const Command> motionCommands()
{
    static constexpr std::array kCommands{Command{"dew", runDew},
                                          Command{"flow", runFlow},
                                          Command{"liquid2d", runLiquid2d},
                                          Command{"morph", runMorph},
                                          Command{"wind-tunnel", runWindTunnel},
                                          Command{"windshield", runWindshield}};
    return kCommands;
}

}  // namespace cli
