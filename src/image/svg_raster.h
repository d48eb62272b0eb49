// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "number_text.h"

namespace droplet {

/// Grid of pixels over a page. It is exactly as wide as the page, and less than a pixel higher.
struct SvgRaster {
    int width = 1;
    int height = 1;
    double scale = 1.0;  ///< pixels per CSS px
};

/// Grid over a page of a width and a height [CSS px], with so many pixels on its longer side if its limits allow;
/// none if the page is too narrow for any.
inline std::optional<SvgRaster> svgRaster(double page_width, double page_height, int long_side, std::size_t max_pixels)
{
    constexpr int kMaxSide = 32767;  // limit of Cairo's images
    // A very narrow page is drawn larger than requested instead of as a row of pixels.
    constexpr double kShortSide = 16.0;
    const double max = static_cast<double>(max_pixels);
    const double wanted = std::clamp(long_side, 1, kMaxSide);
    double scale = std::max(wanted / std::max(page_width, page_height),
                            std::min(kShortSide, wanted) / std::min(page_width, page_height));
    scale = std::min({scale, kMaxSide / std::max(page_width, page_height), std::sqrt(max / page_width / page_height)});
    double width = std::max(1.0, std::round(page_width * scale));
    const auto height = [&] {
        constexpr double kRounding = 1e-6;
        return std::max(1.0, std::ceil(page_height / page_width * width - kRounding));
    };
    while (width > 1.0 && (width * height() > max || height() > kMaxSide)) {
        width -= 1.0;
    }
    if (!(height() <= kMaxSide && width * height() <= max)) {
        return std::nullopt;
    }
    return SvgRaster{static_cast<int>(width), static_cast<int>(height()), width / page_width};
}

/// Why there is no grid.
inline std::string tooNarrow(double page_width, double page_height, std::size_t max_pixels)
{
    return "has a page of " + numberText(page_width) + " x " + numberText(page_height) +
           ", too narrow to be drawn in " + std::to_string(max_pixels) + " pixels";
}

}  // namespace droplet
