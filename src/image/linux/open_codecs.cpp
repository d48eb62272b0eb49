// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/open_codecs.h"

#include <dlfcn.h>

#include "image/installed.h"

namespace droplet {
namespace {

OpenCodecs opened()
{
    OpenCodecs codecs;
    const auto path = installedFile(DROPLET_CODECS);
    // It is never closed, because OpenCV's registrations stay.
    void* const module = path ? dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL) : nullptr;
    if (module == nullptr) {
        codecs.problem = path ? dlerror() : DROPLET_CODECS " is missing";
        return codecs;
    }
    codecs.decode = reinterpret_cast<DropletDecode*>(dlsym(module, "dropletDecode"));
    codecs.encode_exr = reinterpret_cast<DropletEncodeExr*>(dlsym(module, "dropletEncodeExr"));
    codecs.release = reinterpret_cast<DropletRelease*>(dlsym(module, "dropletRelease"));
    return codecs;
}

}  // namespace

const OpenCodecs& openCodecs()
{
    static const OpenCodecs codecs = opened();
    return codecs;
}

}  // namespace droplet
