// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/image/height_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "image/image.h"
#include "image/image_file.h"
#include "number_text.h"

namespace droplet {

void HeightMap::validate() const
{
    if (width < 1 || height < 1) {
        throw Error(ErrorCode::InvalidInput, "height map size " + std::to_string(width) + " x " +
                                                 std::to_string(height) + " must be at least 1 x 1");
    }
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t pixels = columns * static_cast<std::size_t>(height);
    if (levels.size() != pixels) {
        throw Error(ErrorCode::InvalidInput, "height map holds " + std::to_string(levels.size()) +
                                                 " levels, must be width * height = " + std::to_string(pixels));
    }
    const auto wrong = std::find_if(levels.begin(), levels.end(), [](float level) { return !std::isfinite(level); });
    if (wrong != levels.end()) {
        const auto index = static_cast<std::size_t>(wrong - levels.begin());
        throw Error(ErrorCode::InvalidInput, "height map holds " + numberText(*wrong) + " at pixel (" +
                                                 std::to_string(index % columns) + ", " +
                                                 std::to_string(index / columns) + "); heights must be finite");
    }
}

HeightMap decodeHeightMap(std::span<const std::byte> encoded, std::size_t max_pixels)
{
    try {
        HeightMap map;
        if (auto floats = decodeFloatImage(encoded, max_pixels)) {
            map = {floats->width, floats->height, std::move(floats->samples), true};
        } else {
            Image image = decodeImage(encoded, {.max_pixels = max_pixels});
            map = {image.width, image.height, {}, false};
            const std::vector<std::uint16_t> luma = lumaOverBlack(std::move(image));
            map.levels.resize(luma.size());
            std::transform(luma.begin(), luma.end(), map.levels.begin(),
                           [](std::uint16_t level) { return static_cast<float>(level) / 65535.0F; });
        }
        map.validate();
        return map;
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

HeightMap readHeightMap(const std::filesystem::path& path, std::size_t max_pixels)
{
    return fromImageFile(
        path, [max_pixels](std::span<const std::byte> encoded) { return decodeHeightMap(encoded, max_pixels); });
}

}  // namespace droplet
