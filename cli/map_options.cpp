// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_options.h"

#include <filesystem>
#include <string>

namespace cli {

bool areMapsExr(const CommandLine& line, const std::vector<const char*>& belonging, const char* allowed)
{
    const auto maps = line.value("--maps");
    for (const char* option : belonging) {
        if (line.value(option) && !maps) {
            refuse(std::string(option) + " needs --maps");
        }
    }
    if (!maps) {
        return false;
    }
    const std::string ending = std::filesystem::path(maps->text).extension().string();
    if (ending != ".png" && ending != ".exr") {
        refuse(*maps, allowed);
    }
    if (ending == ".exr" && line.value("--map-thickness")) {
        refuse("--map-thickness needs --maps with .png: .exr has metres");
    }
    return ending == ".exr";
}

}  // namespace cli
