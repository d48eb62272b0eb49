// SPDX-License-Identifier: GPL-3.0-or-later
// OpenCV's codecs where they are linked with the program.
#include "image/open_codecs.h"

namespace droplet {

const OpenCodecs& openCodecs()
{
    static const OpenCodecs codecs{dropletDecode, dropletEncodeExr, dropletRelease, {}};
    return codecs;
}

}  // namespace droplet
