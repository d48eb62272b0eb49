// SPDX-License-Identifier: GPL-3.0-or-later
// What a page cannot do: start programs, load libraries, decode pictures that its browser decodes.
#include <dlfcn.h>

#include "droplet/error.h"
#include "droplet/io/page.h"
#include "image/codecs.h"
#include "image/exr.h"

namespace droplet {
namespace {

[[noreturn]] void refusePicture()
{
    throw Error(ErrorCode::InvalidInput, "not a PNG image; decode it and give its pixels as RGBA");
}

}  // namespace

Image decodeJpeg(std::span<const std::byte>, const ImageHeader&)
{
    refusePicture();
}

Image decodeSvg(std::span<const std::byte>, const DecodeOptions&)
{
    refusePicture();
}

Image decodeWithOpenCv(std::span<const std::byte>, ImageFormat, const DecodeOptions&)
{
    refusePicture();
}

std::optional<FloatImage> decodeFloatsWithOpenCv(std::span<const std::byte>, ImageFormat, std::size_t, bool)
{
    refusePicture();
}

bool hasPage() noexcept
{
    return false;
}

}  // namespace droplet
