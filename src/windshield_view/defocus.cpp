// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/defocus.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace droplet {
namespace {

/// Type of sums over a row; in float, bright pixels would hide dark ones.
using Sum = double __attribute__((vector_size(32)));

constexpr int kBand = 64;  // rows in a block of work for one thread

/// Index of the pixel that the mirrored picture shows.
int mirroredIndex(int at, int count)
{
    const int period = 2 * count;
    const int within = ((at % period) + period) % period;
    return within < count ? within : period - 1 - within;
}

/// Halves a picture; each pixel is the mean of four.
LightPicture halved(const LightPicture& from)
{
    LightPicture to{(from.width + 1) / 2, (from.height + 1) / 2, {}};
    to.light.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
    tbb::parallel_for(tbb::blocked_range<int>(0, to.height, kBand), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const Float4* const upper = from.light.data() + static_cast<std::ptrdiff_t>(2 * y) * from.width;
            const Float4* const lower = 2 * y + 1 < from.height ? upper + from.width : upper;
            Float4* const row = to.light.data() + static_cast<std::ptrdiff_t>(y) * to.width;
            for (int x = 0; x < to.width; ++x) {
                const int left = 2 * x;
                const int right = std::min(left + 1, from.width - 1);
                row[x] = float4(0.25F) * ((upper[left] + upper[right]) + (lower[left] + lower[right]));
            }
        }
    });
    return to;
}

/// Enlarges a picture by a factor, linear between pixels.
LightPicture enlarged(const LightPicture& from, int factor, int width, int height)
{
    LightPicture to{width, height, {}};
    to.light.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const float scale = 1.0F / static_cast<float>(factor);
    // Pixels before and after a place, and the weight of the latter.
    const auto between = [&](int at, int count) {
        const float place = std::max(scale * (static_cast<float>(at) + 0.5F) - 0.5F, 0.0F);
        const int first = std::min(static_cast<int>(place), count - 1);
        return std::tuple(first, std::min(first + 1, count - 1), place - static_cast<float>(first));
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, height, kBand), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const auto [top, bottom, below] = between(y, from.height);
            const Float4* const upper = from.light.data() + static_cast<std::ptrdiff_t>(top) * from.width;
            const Float4* const lower = from.light.data() + static_cast<std::ptrdiff_t>(bottom) * from.width;
            for (int x = 0; x < width; ++x) {
                const auto [left, right, share] = between(x, from.width);
                const Float4 above = upper[left] + float4(share) * (upper[right] - upper[left]);
                const Float4 under = lower[left] + float4(share) * (lower[right] - lower[left]);
                to.light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
                    above + float4(below) * (under - above);
            }
        }
    });
    return to;
}

/// Half the mean width of a disc in each row of pixels, from top to bottom [px].
std::vector<double> rowsOf(double radius)
{
    // ∫ √(r² − y²) dy
    const auto area = [&](double y) {
        const double at = std::clamp(y, -radius, radius);
        return 0.5 * (at * std::sqrt(radius * radius - at * at) + radius * radius * std::asin(at / radius));
    };
    const int reach = static_cast<int>(std::ceil(radius - 0.5));
    std::vector<double> rows;
    for (int k = -reach; k <= reach; ++k) {
        rows.push_back(area(k + 0.5) - area(k - 0.5));
    }
    return rows;
}

/// Means over discs; exact for the share of each row that a disc covers.
LightPicture discMeans(const LightPicture& from, double radius)
{
    const std::vector<double> half_widths = rowsOf(radius);
    const int reach = static_cast<int>(half_widths.size() / 2);
    const int margin = reach + 2;  // columns beyond each edge
    double area = 0.0;
    for (const double half : half_widths) {
        area += 2.0 * half;
    }
    const double share = 1.0 / area;
    LightPicture to{from.width, from.height, {}};
    to.light.resize(from.light.size());
    const auto stride = static_cast<std::size_t>(from.width) + 2 * static_cast<std::size_t>(margin) + 1;
    tbb::parallel_for(0, (from.height + kBand - 1) / kBand, [&](int band) {
        const int top = band * kBand;
        const int bottom = std::min(top + kBand, from.height);
        // Prefix sums of each row.
        std::vector<Sum> sums(stride * static_cast<std::size_t>(bottom - top + 2 * reach));
        for (int y = top - reach; y < bottom + reach; ++y) {
            const Float4* const row =
                from.light.data() + static_cast<std::ptrdiff_t>(mirroredIndex(y, from.height)) * from.width;
            Sum* const up_to = sums.data() + stride * static_cast<std::size_t>(y - top + reach);
            up_to[0] = Sum{};
            for (int x = -margin; x < from.width + margin; ++x) {
                const int at = x < 0 || x >= from.width ? mirroredIndex(x, from.width) : x;
                up_to[x + margin + 1] = up_to[x + margin] + __builtin_convertvector(row[at], Sum);
            }
        }
        std::vector<Sum> means(static_cast<std::size_t>(from.width));
        for (int y = top; y < bottom; ++y) {
            std::fill(means.begin(), means.end(), Sum{});
            for (std::size_t k = 0; k < half_widths.size(); ++k) {
                const double beyond = half_widths[k] - 0.5;  // without the pixel itself
                const double whole = std::floor(beyond);
                const double part = beyond - whole;
                const Sum inner = Sum{1.0, 1.0, 1.0, 1.0} * (share * (1.0 - part));
                const Sum outer = Sum{1.0, 1.0, 1.0, 1.0} * (share * part);
                const Sum* const up_to = sums.data() + stride * (static_cast<std::size_t>(y - top) + k);
                const auto n = static_cast<std::ptrdiff_t>(whole);
                const Sum* const right = up_to + margin + 1 + n;
                const Sum* const left = up_to + margin - n;
                for (int x = 0; x < from.width; ++x) {
                    means[static_cast<std::size_t>(x)] +=
                        inner * (right[x] - left[x]) + outer * (right[x + 1] - left[x - 1]);
                }
            }
            std::transform(means.begin(), means.end(), to.light.begin() + static_cast<std::ptrdiff_t>(y) * from.width,
                           [](const Sum& mean) { return __builtin_convertvector(mean, Float4); });
        }
    });
    return to;
}

}  // namespace

LightPicture defocused(LightPicture sharp, float diameter)
{
    // A large disc is computed on a smaller picture, where it is still smooth.
    constexpr double kLargest = 12.0;
    double radius = 0.5 * static_cast<double>(diameter);
    if (radius < 0.05) {
        return sharp;
    }
    const int width = sharp.width;
    const int height = sharp.height;
    int factor = 1;
    while (radius > kLargest) {
        sharp = halved(sharp);
        radius *= 0.5;
        factor *= 2;
    }
    if (factor == 1) {
        return discMeans(sharp, radius);
    }
    // Halving and enlarging spread light, too: their variance, 1/4 px², adds to that of a disc, r²/4.
    return enlarged(discMeans(sharp, std::sqrt(radius * radius - 1.0)), factor, width, height);
}

}  // namespace droplet
