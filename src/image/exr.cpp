// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/exr.h"

#include <new>
#include <string>

#include "droplet/error.h"
#include "image/open_codecs.h"

namespace droplet {
std::vector<std::byte> encodeExr(const FloatPixels& pixels)
{
    const OpenCodecs& codecs = openCodecs();
    if (codecs.encode_exr == nullptr) {
        throw Error(ErrorCode::OutputFailed,
                    "OpenEXR images are written with OpenCV, which must be installed (Debian's package "
                    "libopencv-imgcodecs406): " +
                        codecs.problem);
    }
    DropletPicture file{};
    const DropletOutcome outcome =
        codecs.encode_exr(pixels.values.data(), pixels.width, pixels.height, pixels.channels, &file);
    if (outcome == DropletOutcome::OutOfMemory) {
        throw std::bad_alloc();
    }
    if (outcome != DropletOutcome::Decoded) {
        throw Error(ErrorCode::OutputFailed, std::string("OpenCV cannot encode an OpenEXR image: ") + file.problem);
    }
    const auto* const bytes = static_cast<const std::byte*>(file.pixels);
    std::vector<std::byte> result(bytes, bytes + file.width);
    codecs.release(&file);
    return result;
}

}  // namespace droplet
