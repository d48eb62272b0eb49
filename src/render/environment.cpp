// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/environment.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

#include "drawing/tone.h"
#include "droplet/error.h"
#include "image/image.h"
#include "image/image_file.h"

namespace droplet {

void Environment::validate() const
{
    if (width < 1 || height < 1 ||
        radiance.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        throw Error(ErrorCode::InvalidArgument, "environment holds " + std::to_string(radiance.size()) +
                                                    " pixels, must be width " + std::to_string(width) + " * height " +
                                                    std::to_string(height) + ", both at least 1");
    }
    float max = 0.0F;
    for (const std::array<float, 3>& pixel : radiance) {
        for (const float light : pixel) {
            if (!(light >= 0.0F && std::isfinite(light))) {
                throw Error(ErrorCode::InvalidArgument, "environment's light must be finite and at least 0");
            }
            max = std::max(max, light);
        }
    }
    if (max == 0.0F) {
        throw Error(ErrorCode::InvalidArgument, "environment must not be black all over");
    }
}

Environment readEnvironment(const std::filesystem::path& path, std::size_t max_pixels)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) {
        try {
            Environment environment;
            if (auto floats = decodeFloatImage(encoded, max_pixels, true)) {
                environment = {floats->width, floats->height, std::move(floats->colour)};
                for (std::array<float, 3>& pixel : environment.radiance) {
                    for (float& light : pixel) {
                        light = std::max(light, 0.0F);  // resampling can undershoot beside the sun
                    }
                }
            } else {
                const Picture picture = decodePicture(encoded, max_pixels);
                environment = {picture.width, picture.height, {}};
                const auto& levels = displayLevels();
                for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
                    environment.radiance.push_back(
                        {levels[picture.rgb[i]], levels[picture.rgb[i + 1]], levels[picture.rgb[i + 2]]});
                }
            }
            try {
                environment.validate();
            } catch (const Error& error) {
                throw Error(ErrorCode::InvalidInput, error.what());
            }
            return environment;
        } catch (const std::bad_alloc&) {
            throwOutOfMemory();
        }
    });
}

}  // namespace droplet
