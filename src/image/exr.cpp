// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"

#include <dlfcn.h>

#include <new>
#include <string>

#include "droplet/error.h"
#include "image/codec_module.h"
#include "image/installed.h"

namespace droplet {
namespace {

/// The module, opened at first use. It is never closed, because OpenCV's registrations stay.
struct Encoder {
    Encoder()
    {
        const auto path = installedFile(DROPLET_CODECS);
        void* const module = path ? dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL) : nullptr;
        if (module == nullptr) {
            problem = path ? dlerror() : DROPLET_CODECS " is missing";
            return;
        }
        encode = reinterpret_cast<DropletEncodeExr*>(dlsym(module, "dropletEncodeExr"));
        release = reinterpret_cast<DropletRelease*>(dlsym(module, "dropletRelease"));
    }

    DropletEncodeExr* encode = nullptr;
    DropletRelease* release = nullptr;
    std::string problem;
};

}  // namespace

std::vector<std::byte> encodeExr(const FloatPixels& pixels)
{
    static const Encoder encoder;
    if (encoder.encode == nullptr || encoder.release == nullptr) {
        throw Error(ErrorCode::OutputFailed,
                    "OpenEXR images are written with OpenCV, which must be installed (Debian's package "
                    "libopencv-imgcodecs406): " +
                        encoder.problem);
    }
    DropletPicture file{};
    const DropletOutcome outcome =
        encoder.encode(pixels.values.data(), pixels.width, pixels.height, pixels.channels, &file);
    if (outcome == DropletOutcome::OutOfMemory) {
        throw std::bad_alloc();
    }
    if (outcome != DropletOutcome::Decoded) {
        throw Error(ErrorCode::OutputFailed, std::string("OpenCV cannot encode an OpenEXR image: ") + file.problem);
    }
    const auto* const bytes = static_cast<const std::byte*>(file.pixels);
    std::vector<std::byte> result(bytes, bytes + file.width);
    encoder.release(&file);
    return result;
}

}  // namespace droplet
