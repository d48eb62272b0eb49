// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "image/encoded_images.h"
#include "torture/corpus.h"
#include "torture/random.h"

namespace droplet::torture {
namespace {

struct Kind {
    const char* name;
    int colour_type;
    int channels;
    std::vector<int> bits;
};

const std::vector<Kind>& kinds()
{
    static const std::vector<Kind> all{
        {"grey", PNG_COLOR_TYPE_GRAY, 1, {1, 2, 4, 8, 16}},
        {"palette", PNG_COLOR_TYPE_PALETTE, 1, {1, 2, 4, 8}},
        {"rgb", PNG_COLOR_TYPE_RGB, 3, {8, 16}},
        {"grey_alpha", PNG_COLOR_TYPE_GRAY_ALPHA, 2, {8, 16}},
        {"rgba", PNG_COLOR_TYPE_RGBA, 4, {8, 16}},
    };
    return all;
}

/// Three kinds of samples: noise; mostly black noise; a soft disc in noise.
encoded::Raster raster(int side, int channels, int bits, int character, Random& random)
{
    encoded::Raster result{side, side, channels, bits, {}};
    for (int i = 0; i < side * side; ++i) {
        const int row = i / side;
        const double r = std::hypot(i % side - 0.5 * side, row - 0.47 * side);
        const double disc = 0.5 + 0.4 * (0.35 * side - r);
        for (int c = 0; c < channels; ++c) {
            const double noise = random.real();
            const double level = character == 0 ? noise : character == 1 ? std::pow(noise, 6.0) : disc + 0.2 * noise;
            const auto white = static_cast<double>(result.white());
            result.samples.push_back(static_cast<unsigned>(std::lround(white * std::clamp(level, 0.0, 1.0))));
        }
    }
    return result;
}

using Make = std::function<Item()>;

Item pngOf(const std::string& name, const encoded::Raster& samples, encoded::PngKind kind, bool transparent,
           Random& random)
{
    png_color_16 dry{};
    if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) {
        const auto byte = [&] { return static_cast<png_byte>(random.below(256)); };
        for (unsigned k = 0; k <= samples.white(); ++k) {
            kind.palette.push_back({byte(), byte(), byte()});
            if (transparent) {
                kind.palette_alpha.push_back(byte());
            }
        }
    } else if (transparent) {
        kind.transparent = &dry;
    }
    return {name, encodePng(samples, kind)};
}

void addPngs(std::vector<Make>& makes, const Kind& kind, int bits, bool interlaced, bool transparent)
{
    for (const int character : {0, 1, 2}) {
        const std::uint64_t seed = makes.size();
        makes.emplace_back([=] {
            Random random(seed);
            const encoded::Raster samples = raster(20 + random.below(30), kind.channels, bits, character, random);
            const std::string name = std::string(kind.name) + std::to_string(bits) + (interlaced ? "_interlaced" : "") +
                                     (transparent ? "_transparent" : "") + "_" + std::to_string(character) + ".png";
            return pngOf(name, samples, {kind.colour_type, interlaced, {}, {}, nullptr}, transparent, random);
        });
    }
}

void addJpegs(std::vector<Make>& makes, int channels, int quality)
{
    for (const int character : {0, 1, 2}) {
        const std::uint64_t seed = makes.size();
        makes.emplace_back([=] {
            Random random(seed);
            const encoded::Raster samples = raster(20 + random.below(60), channels, 8, character, random);
            encoded::JpegKind kind;
            kind.quality = quality;
            return Item{"jpeg" + std::to_string(channels) + "_quality" + std::to_string(quality) + "_" +
                            std::to_string(character) + ".jpg",
                        encodeJpeg(samples, kind)};
        });
    }
}

}  // namespace

Corpus encodedNoise()
{
    std::vector<Make> makes;
    for (const Kind& kind : kinds()) {
        for (const int bits : kind.bits) {
            for (const bool interlaced : {false, true}) {
                addPngs(makes, kind, bits, interlaced, false);
                // Formats with alpha have no other transparency.
                if (kind.channels % 2 == 1) {
                    addPngs(makes, kind, bits, interlaced, true);
                }
            }
        }
    }
    for (const int channels : {1, 3}) {
        for (const int quality : {1, 10, 30, 60, 90}) {
            addJpegs(makes, channels, quality);
        }
    }
    const std::size_t count = makes.size();
    return {"encoded noise", count, [makes = std::move(makes)](std::size_t index) { return makes[index](); }};
}

}  // namespace droplet::torture
