// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>
#include <string>
#include <string_view>

#include "droplet/error.h"
#include "droplet/liquid2d_io/read_scene.h"
#include "fuzz/targets.h"

namespace droplet {

void fuzzScene(std::span<const std::byte> bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    try {
        parseFluidScene(text, "/nowhere/fuzz.toml").validate();
    } catch (const Error& error) {
        const std::string said = error.what();
        if (error.code() != ErrorCode::InvalidInput || said.find('\n') != std::string::npos) {
            throw std::logic_error("refused as \"" + said + '"');
        }
    }
}

}  // namespace droplet
