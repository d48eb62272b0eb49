// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>
#include <string>
#include <string_view>

#include "droplet/error.h"
#include "droplet/mask/mask.h"
#include "fuzz/targets.h"

namespace droplet {

void fuzzSvg(std::span<const std::byte> bytes)
{
    // fuzz_mask covers files that are not SVG.
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    if (std::string_view(text, bytes.size()).find("<svg") == std::string_view::npos) {
        return;
    }
    MaskOptions options;
    options.channel = Channel::Alpha;
    options.max_pixels = std::size_t{1} << 16;
    options.vector_long_side = 64;
    options.vector_seconds = 1.0;
    options.vector_memory = std::size_t{128} << 20;
    try {
        decodeMask(bytes, options).validate();
    } catch (const Error& error) {
        const std::string said = error.what();
        if (error.code() != ErrorCode::InvalidInput || said.empty() || said.find('\n') != std::string::npos) {
            throw std::logic_error("refused as \"" + said + '"');
        }
    }
}

}  // namespace droplet
