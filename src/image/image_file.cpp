// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image_file.h"

#include <limits>
#include <new>

#include "image/image_header.h"

namespace droplet {

void throwOutOfMemory()
{
    throw Error(ErrorCode::InvalidInput, "the image needs more memory than is available");
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

}  // namespace droplet
