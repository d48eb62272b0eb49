// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides whether levels are those of a mask. Robust figures in the spirit of N. Otsu, "A threshold selection method
// from gray-level histograms" (1979): the distance of the two classes' levels in units of their spread.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "mask/edges.h"
#include "mask/segmentation.h"

namespace droplet {
namespace {

constexpr int kLevels = 256;
constexpr int kMiddle = 1 << 15;

/// Levels of one class, off the rims.
class Levels {
public:
    void add(std::uint16_t level)
    {
        ++count_[level >> 8];
        ++total_;
    }
    [[nodiscard]] std::uint64_t total() const { return total_; }
    [[nodiscard]] double quantile(double share) const
    {
        const auto wanted = share * static_cast<double>(total_);
        double seen = 0.0;
        int level = 0;
        for (; level + 1 < kLevels; ++level) {
            seen += static_cast<double>(count_[static_cast<std::size_t>(level)]);
            if (seen > wanted) {
                break;
            }
        }
        return level / (kLevels - 1.0);
    }

private:
    std::array<std::uint64_t, kLevels> count_{};
    std::uint64_t total_ = 0;
};

/// Statistics of a mask along its rows and columns.
class Survey {
public:
    explicit Survey(const LevelView& plane) : plane_(plane)
    {
        // The blur of a picture that is slightly out of focus.
        reach_ = std::max(4, std::min(plane.width, plane.height) / 100);
        constexpr int kLines = 512;
        for (int y = 0; y < plane.height; y += 1 + plane.height / kLines) {
            line(static_cast<std::ptrdiff_t>(y) * plane.width, 1, plane.width);
        }
        for (int x = 0; x < plane.width; x += 1 + plane.width / kLines) {
            line(x, plane.width, plane.height);
        }
    }

    [[nodiscard]] bool hasRim() const { return crossings_ > 0; }

    /// Share of the rim at which the level changes, within reach, by half of the range from dry to liquid.
    [[nodiscard]] double sharp() const { return static_cast<double>(sharp_) / static_cast<double>(crossings_); }

    /// Distance of the classes' levels in units of their spread.
    [[nodiscard]] double separation() const
    {
        constexpr std::uint64_t kMinSamples = 64;
        if (off_rim_[0].total() < kMinSamples || off_rim_[1].total() < kMinSamples) {
            return std::numeric_limits<double>::infinity();
        }
        constexpr double kRounding = 0.02;
        double spread = kRounding;
        for (const Levels& levels : off_rim_) {
            spread += 0.5 * (levels.quantile(0.84) - levels.quantile(0.16));
        }
        return (off_rim_[1].quantile(0.5) - off_rim_[0].quantile(0.5)) / spread;
    }

    /// Share of fully dry or fully liquid pixels, in the class with the smaller share.
    [[nodiscard]] double plateaus() const
    {
        const auto share = [&](std::size_t k) {
            return static_cast<double>(full_[k]) / static_cast<double>(std::max<std::uint64_t>(1, pixels_[k]));
        };
        return std::min(share(0), share(1));
    }

    /// Share of isolated pixels of the other class, in the class with the smaller share. Drawings have dots in one
    /// class; noise makes them in both.
    [[nodiscard]] double grains() const
    {
        const auto share = [&](std::size_t k) {
            return static_cast<double>(grains_[k]) / static_cast<double>(std::max<std::uint64_t>(1, pixels_[k]));
        };
        return std::min(share(0), share(1));
    }

private:
    [[nodiscard]] std::uint16_t at(std::ptrdiff_t index) const { return plane_.levels[index]; }
    [[nodiscard]] std::size_t classOf(std::ptrdiff_t index) const { return at(index) >= kMiddle ? 1 : 0; }

    void line(std::ptrdiff_t first, std::ptrdiff_t step, int count)
    {
        int begin = 0;
        for (int i = 1; i <= count; ++i) {
            if (i < count && classOf(first + i * step) == classOf(first + (i - 1) * step)) {
                continue;
            }
            run(first, step, begin, i);
            if (i < count) {
                crossing(first, step, i, count);
            }
            begin = i;
        }
    }

    void run(std::ptrdiff_t first, std::ptrdiff_t step, int begin, int end)
    {
        const std::size_t kind = classOf(first + begin * step);
        pixels_[kind] += static_cast<std::uint64_t>(end - begin);
        for (int i = begin; i < end; ++i) {
            full_[kind] += std::abs(at(first + i * step) - (kind == 1 ? 2 * kMiddle : 0)) < kMiddle / 5 ? 1U : 0U;
        }
        for (int i = begin + reach_; i < end - reach_; ++i) {
            off_rim_[kind].add(at(first + i * step));
        }
        if (end - begin == 1 && isIsolated(first + begin * step)) {
            ++grains_[1 - kind];
        }
    }

    [[nodiscard]] bool isIsolated(std::ptrdiff_t index) const
    {
        const std::ptrdiff_t x = index % plane_.width;
        const std::ptrdiff_t y = index / plane_.width;
        if (x == 0 || y == 0 || x + 1 == plane_.width || y + 1 == plane_.height) {
            return false;
        }
        for (std::ptrdiff_t v = -1; v <= 1; ++v) {
            for (std::ptrdiff_t u = -1; u <= 1; ++u) {
                if ((u != 0 || v != 0) && classOf(index + v * plane_.width + u) == classOf(index)) {
                    return false;
                }
            }
        }
        return true;
    }

    void crossing(std::ptrdiff_t first, std::ptrdiff_t step, int i, int count)
    {
        std::uint16_t min = std::numeric_limits<std::uint16_t>::max();
        std::uint16_t max = 0;
        for (int k = std::max(0, i - reach_); k < std::min(count, i + reach_); ++k) {
            min = std::min(min, at(first + k * step));
            max = std::max(max, at(first + k * step));
        }
        ++crossings_;
        sharp_ += max - min >= kMiddle ? 1 : 0;
    }

    LevelView plane_;
    int reach_ = 4;
    std::uint64_t crossings_ = 0;
    std::uint64_t sharp_ = 0;
    std::array<Levels, 2> off_rim_;
    std::array<std::uint64_t, 2> pixels_{};
    std::array<std::uint64_t, 2> full_{};
    std::array<std::uint64_t, 2> grains_{};
};

double ramp(double value, double from, double to)
{
    return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

/// Share of the picture in regions whose rim has no edge, measured on a small copy.
double softRegions(const LevelView& plane)
{
    const cv::Mat levels = workingImage(plane);
    cv::Mat soft;
    cv::GaussianBlur(levels, soft, {}, 1.0);
    cv::Mat is_liquid = soft >= 0.5;
    const int reach = std::max(3, std::min(soft.cols, soft.rows) / 100);
    const LocalRange range = localRange(soft, reach);
    const cv::Mat is_edge = range.max - range.min >= 0.4;
    const cv::Mat before = is_liquid.clone();
    dropRegionsWithoutEdge(is_liquid, is_edge, 0);
    return cv::mean(before != is_liquid)[0] / 255.0;
}

}  // namespace

MaskLikeness maskLikeness(const LevelView& coverage, bool is_original)
{
    constexpr int kTooSmall = 128;
    if (std::min(coverage.width, coverage.height) < kTooSmall) {
        return {1.0, true, true};
    }
    const Survey survey(coverage);
    if (!survey.hasRim()) {
        return {};
    }
    constexpr double kSharp = 0.97;
    constexpr double kEverywhere = 0.995;
    const double sharp = survey.sharp();
    double confidence = ramp(sharp, 0.7, kSharp) * ramp(survey.separation(), 2.5, 6.0) *
                        (1.0 - 0.8 * ramp(survey.grains(), 0.0005, 0.003));
    if (confidence > 0.0 && sharp < kEverywhere) {
        confidence *= 1.0 - 0.8 * ramp(softRegions(coverage), 0.0005, 0.003);
    }
    // Soft edges between two levels can also be those of a mask.
    constexpr double kBimodal = 0.55;
    const double min = is_original && survey.plateaus() >= kBimodal ? 0.5 : 0.0;
    return {std::max(min, confidence), true, sharp >= kSharp};
}

bool isDrawn(const LevelView& luma)
{
    constexpr int kLines = 128;
    constexpr double kMinFlatShare = 0.4;
    const std::ptrdiff_t wide = std::max(8, std::min(luma.width, luma.height) / 16);
    std::ptrdiff_t flat = 0;
    std::ptrdiff_t total = 0;
    for (int y = 0; y < luma.height; y += 1 + luma.height / kLines) {
        const std::uint16_t* const row = luma.levels + static_cast<std::ptrdiff_t>(y) * luma.width;
        const std::uint16_t* const end = row + luma.width;
        for (const std::uint16_t* from = row; from != end;) {
            const std::uint16_t* const to =
                std::find_if(from, end, [&](std::uint16_t level) { return level != *from; });
            flat += to - from >= wide ? to - from : 0;
            from = to;
        }
        total += luma.width;
    }
    return static_cast<double>(flat) >= kMinFlatShare * static_cast<double>(total);
}

}  // namespace droplet
