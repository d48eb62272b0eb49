// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours are compared by their distance in CIE 1976 L*a*b*.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "mask/segmentation.h"

namespace droplet {
namespace {

using Rgb = cv::Vec3f;  ///< each channel from 0 to 1

/// Distance up to which colours count as the same: about eight just noticeable steps, and less than the distance
/// between two of the named primaries.
constexpr float kMaxDistance = 20.0F;

/// Alpha below which a pixel's colour is unreliable.
constexpr std::uint16_t kMinAlpha = 1 << 14;

/// Colours of an image without their weight by alpha.
class Colours {
public:
    explicit Colours(const Image& image) : image_(image) {}

    [[nodiscard]] std::uint16_t alpha(std::size_t i) const { return image_.alpha.empty() ? 65535 : image_.alpha[i]; }
    [[nodiscard]] Rgb at(std::size_t i) const
    {
        const float whole =
            image_.premultiplied ? 255.0F * static_cast<float>(std::max<int>(1, alpha(i))) / 65535.0F : 255.0F;
        const auto& colour = image_.colour[i];
        return {std::min(1.0F, static_cast<float>(colour[0]) / whole),
                std::min(1.0F, static_cast<float>(colour[1]) / whole),
                std::min(1.0F, static_cast<float>(colour[2]) / whole)};
    }

private:
    const Image& image_;
};

/// Image that is 255 where a pixel has nearly the colour.
cv::Mat similarPixels(const Image& image, const CssColour& colour)
{
    cv::Mat wanted(1, 1, CV_32FC3, cv::Scalar(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0));
    cv::cvtColor(wanted, wanted, cv::COLOR_RGB2Lab);
    const Rgb target = wanted.at<Rgb>(0, 0);
    const Colours colours(image);
    cv::Mat found(image.height, image.width, CV_8UC1, cv::Scalar(0));
    tbb::parallel_for(0, image.height, [&](int y) {
        const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
        cv::Mat row(1, image.width, CV_32FC3);
        for (int x = 0; x < image.width; ++x) {
            row.at<Rgb>(0, x) = colours.at(first + static_cast<std::size_t>(x));
        }
        cv::cvtColor(row, row, cv::COLOR_RGB2Lab);
        for (int x = 0; x < image.width; ++x) {
            const bool is_same = cv::norm(row.at<Rgb>(0, x) - target) <= kMaxDistance;
            found.at<std::uint8_t>(y, x) =
                is_same && colours.alpha(first + static_cast<std::size_t>(x)) >= kMinAlpha ? 255 : 0;
        }
    });
    return found;
}

/// Image that is 255 where a pixel has the colour. If all of the picture is similar, as labels are that count from 0,
/// it must be exactly that colour.
cv::Mat pixelsOf(const Image& image, const CssColour& colour)
{
    cv::Mat similar = similarPixels(image, colour);
    const std::array<std::uint8_t, 3> wanted{colour.red, colour.green, colour.blue};
    const auto& exact = image.colour;
    if (cv::countNonZero(similar) < static_cast<int>(similar.total()) ||
        std::find(exact.begin(), exact.end(), wanted) == exact.end()) {
        return similar;
    }
    std::transform(exact.begin(), exact.end(), similar.begin<std::uint8_t>(),
                   [&](const auto& pixel) { return pixel == wanted ? 255 : 0; });
    return similar;
}

}  // namespace

std::string commonColours(const Image& image)
{
    struct Bin {
        std::size_t count = 0;
        std::array<std::size_t, 3> sum{};
    };
    constexpr std::size_t kMax = 4;
    std::vector<Bin> bins(4096);
    std::size_t total = 0;
    const Colours colours(image);
    for (std::size_t i = 0; i < image.colour.size(); ++i) {
        if (colours.alpha(i) < kMinAlpha) {
            continue;
        }
        const Rgb colour = 255.0F * colours.at(i);
        std::size_t bin = 0;
        for (int c = 0; c < 3; ++c) {
            bin = 16 * bin + static_cast<std::size_t>(colour[c]) / 16;
        }
        ++bins[bin].count;
        ++total;
        for (std::size_t c = 0; c < 3; ++c) {
            bins[bin].sum[c] += static_cast<std::size_t>(std::lround(colour[static_cast<int>(c)]));
        }
    }
    std::stable_sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.count > b.count; });
    std::string list;
    for (std::size_t k = 0; k < kMax && bins[k].count > 0; ++k) {
        const auto mean = [&](std::size_t c) { return static_cast<std::uint8_t>(bins[k].sum[c] / bins[k].count); };
        list += fmt::format("{}{} ({:.0f} %)", k == 0 ? "" : ", ", text(CssColour{mean(0), mean(1), mean(2)}),
                            100.0 * static_cast<double>(bins[k].count) / static_cast<double>(total));
    }
    return list.empty() ? "none, all of it is transparent" : list;
}

std::optional<Segmented> segmentColour(const Image& image, const CssColour& colour)
{
    const cv::Mat found = pixelsOf(image, colour);
    if (cv::countNonZero(found) == 0) {
        return std::nullopt;
    }
    constexpr int kReach = 3;  // for the colours on either side of a rim [px]
    cv::Mat inside;
    cv::erode(found, inside, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
    cv::Mat beside;
    cv::dilate(found, beside, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
    cv::Mat near;
    cv::dilate(beside, near, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));

    const Colours colours(image);
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    };
    /// Share of the colour in a pixel at a rim: its place on the line from the other side's colour.
    const auto share = [&](int x, int y) {
        const bool is_same = found.at<std::uint8_t>(y, x) > 0;
        const Rgb here = colours.at(index(x, y));
        Rgb own(0, 0, 0);
        float count = 0.0F;
        const auto around = [&](auto visit) {
            for (int v = std::max(0, y - kReach); v <= std::min(image.height - 1, y + kReach); ++v) {
                for (int u = std::max(0, x - kReach); u <= std::min(image.width - 1, x + kReach); ++u) {
                    visit(u, v);
                }
            }
        };
        for (const cv::Mat& known : {inside, found}) {
            around([&](int u, int v) {
                if (known.at<std::uint8_t>(v, u) > 0) {
                    own += colours.at(index(u, v));
                    count += 1.0F;
                }
            });
            if (count > 0.0F) {
                break;
            }
        }
        if (count == 0.0F) {
            return 0.0F;
        }
        own /= count;
        constexpr float kMaxOffset = 0.25F;  // relative to the line's length
        float best = std::numeric_limits<float>::max();
        float result = is_same ? 1.0F : 0.0F;
        bool only_transparent = true;
        around([&](int u, int v) {
            if (beside.at<std::uint8_t>(v, u) > 0 || colours.alpha(index(u, v)) < kMinAlpha) {
                return;
            }
            only_transparent = false;
            const Rgb other = colours.at(index(u, v));
            const Rgb way = own - other;
            const float square = way.dot(way);
            if (square < 1e-4F) {
                return;
            }
            const float along = std::clamp((here - other).dot(way) / square, 0.0F, 1.0F);
            const float off = static_cast<float>(cv::norm(here - other - along * way)) / std::sqrt(square);
            if (off < kMaxOffset && off < best) {
                best = off;
                result = along;
            }
        });
        return only_transparent && colours.alpha(index(x, y)) < kMinAlpha ? 1.0F : result;
    };

    Segmented result;
    result.confidence = 1.0;
    result.coverage = {image.width, image.height, {}};
    result.coverage.levels.resize(image.colour.size());
    tbb::parallel_for(0, image.height, [&](int y) {
        for (int x = 0; x < image.width; ++x) {
            const float covered = inside.at<std::uint8_t>(y, x) > 0 ? 1.0F
                                  : near.at<std::uint8_t>(y, x) > 0 ? share(x, y)
                                                                    : 0.0F;
            result.coverage.levels[index(x, y)] =
                static_cast<std::uint16_t>(std::lround(covered * static_cast<float>(colours.alpha(index(x, y)))));
        }
    });
    return result;
}

}  // namespace droplet
