// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "image/codec_module.h"

namespace droplet {

/// The functions of the module of image codecs; null if it cannot be opened.
struct OpenCodecs {
    DropletDecode* decode = nullptr;
    DropletEncodeExr* encode_exr = nullptr;
    DropletRelease* release = nullptr;
    std::string problem;  ///< why it cannot be opened; else empty
};

/// The module, opened at the first call.
const OpenCodecs& openCodecs();

}  // namespace droplet
