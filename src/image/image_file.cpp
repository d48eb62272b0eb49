// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image_file.h"

#include <limits>
#include <new>

#include "droplet/image/picture_format.h"
#include "image/image_header.h"

namespace droplet {

void throwOutOfMemory()
{
    // The image is not to blame, so it is no Error; OpenCV's exception for lack of memory becomes that of the language.
    throw std::bad_alloc();
}

std::vector<std::byte> readImageFile(const std::filesystem::path& path)
{
    try {
        return readBytes(path, std::numeric_limits<std::size_t>::max(),
                         [](const Bytes& bytes) { return imageFormat(bytes).has_value(); });
    } catch (const Damage& damage) {
        throw Error(ErrorCode::InvalidInput, "cannot read " + shown(path) + ": " + damage.what());
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

std::optional<std::string> whyNoPicture(const std::filesystem::path& path)
{
    try {
        (void)knownFormat(readImageFile(path));
        return std::nullopt;
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace droplet
