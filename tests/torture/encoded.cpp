// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "footprint/encoded_images.h"
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

/// Samples of three characters: noise throughout; noise in which most is black; a soft disc in noise.
encoded::Raster raster(int side, int channels, int bits, int character, Random& random)
{
    encoded::Raster result{side, side, channels, bits, {}};
    for (int i = 0; i < side * side; ++i) {
        const double r = std::hypot(i % side - 0.5 * side, i / side - 0.47 * side);
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

}  // namespace

Corpus encodedNoise()
{
    struct Wish {
        Kind kind;
        int bits;
        bool interlaced;
        bool transparent;
        int character;
    };
    std::vector<Wish> wishes;
    for (const Kind& kind : kinds()) {
        for (const int bits : kind.bits) {
            for (const bool interlaced : {false, true}) {
                for (const bool transparent : {false, true}) {
                    for (const int character : {0, 1, 2}) {
                        if (!transparent || kind.channels % 2 == 1) {
                            wishes.push_back({kind, bits, interlaced, transparent, character});
                        }
                    }
                }
            }
        }
    }
    const std::size_t count = wishes.size();
    return {"encoded noise", count, [wishes = std::move(wishes)](std::size_t index) {
                const Wish& wish = wishes[index];
                Random random(index);
                const encoded::Raster samples =
                    raster(20 + random.below(30), wish.kind.channels, wish.bits, wish.character, random);
                encoded::PngKind kind{wish.kind.colour_type, wish.interlaced, {}, {}, nullptr};
                png_color_16 transparent{};
                if (wish.kind.colour_type == PNG_COLOR_TYPE_PALETTE) {
                    const auto byte = [&] { return static_cast<png_byte>(random.below(256)); };
                    for (unsigned k = 0; k <= samples.white(); ++k) {
                        kind.palette.push_back({byte(), byte(), byte()});
                        if (wish.transparent) {
                            kind.palette_alpha.push_back(byte());
                        }
                    }
                } else if (wish.transparent) {
                    kind.transparent = &transparent;
                }
                const std::string name = std::string(wish.kind.name) + std::to_string(wish.bits) +
                                         (wish.interlaced ? "_interlaced" : "") +
                                         (wish.transparent ? "_transparent" : "") + "_" +
                                         std::to_string(wish.character);
                return Item{name, encodePng(samples, kind)};
            }};
}

}  // namespace droplet::torture
