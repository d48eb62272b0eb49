// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mask/clean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "require.h"

namespace droplet {
namespace {

constexpr std::uint16_t kFull = std::numeric_limits<std::uint16_t>::max();

/// The coverage as an OpenCV image that shares its memory.
cv::Mat imageOf(Mask& mask)
{
    return {mask.height, mask.width, CV_16UC1, mask.coverage.data()};
}

/// Gaussian blur of standard deviation `sigma` px. Wide blurs work on a smaller image, so that their cost stays small.
cv::Mat blurred(const cv::Mat& image, double sigma)
{
    constexpr double kWidest = 16.0;
    cv::Mat result;
    const double factor = std::ceil(sigma / kWidest);
    if (factor <= 1.0) {
        cv::GaussianBlur(image, result, {}, sigma, sigma, cv::BORDER_REPLICATE);
        return result;
    }
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels / factor))); };
    cv::Mat small;
    cv::resize(image, small, {side(image.cols), side(image.rows)}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, sigma / factor, sigma / factor, cv::BORDER_REPLICATE);
    cv::resize(small, result, image.size(), 0, 0, cv::INTER_LINEAR);
    return result;
}

void smooth(Mask& mask, double length_px, double threshold)
{
    // The centre of a disc stays liquid if its diameter is at least 2.35 standard deviations.
    const double sigma = std::min(0.5 * length_px, static_cast<double>(std::max(mask.width, mask.height)));
    const cv::Mat image = imageOf(mask);
    const cv::Mat soft = blurred(image, sigma);
    // A straight edge becomes one pixel wide again.
    const double gain = std::max(1.0, sigma * std::sqrt(2.0 * std::numbers::pi));
    soft.convertTo(image, CV_16UC1, gain, kFull * threshold * (1.0 - gain));
}

/// Connected components of liquid pixels, or of dry pixels.
struct Components {
    cv::Mat label;  ///< component of every pixel; 0 for pixels of the other kind
    cv::Mat stats;
    int count = 0;  ///< including component 0
};

Components componentsOf(const cv::Mat& coverage, std::uint16_t level, bool liquid)
{
    cv::Mat is_liquid = coverage >= level;
    if (!liquid) {
        is_liquid = ~is_liquid;
    }
    Components found;
    cv::Mat centroids;
    found.count =
        cv::connectedComponentsWithStats(is_liquid, found.label, found.stats, centroids, liquid ? 8 : 4, CV_32S);
    return found;
}

/// Sets the chosen components to one coverage, and also the grey fringe outside their rims, except where it touches a
/// component that is not chosen.
void paint(cv::Mat coverage, const Components& components, const std::vector<bool>& chosen, std::uint16_t value)
{
    const auto is_chosen = [&](int y, int x) {
        return chosen[static_cast<std::size_t>(components.label.at<int>(y, x))];
    };
    for (int y = 0; y < coverage.rows; ++y) {
        for (int x = 0; x < coverage.cols; ++x) {
            bool beside = false;
            bool beside_another = false;
            if (components.label.at<int>(y, x) == 0) {
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, coverage.rows - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, coverage.cols - 1); ++u) {
                        beside = beside || is_chosen(v, u);
                        beside_another = beside_another || (components.label.at<int>(v, u) > 0 && !is_chosen(v, u));
                    }
                }
            }
            if (is_chosen(y, x) || (beside && !beside_another)) {
                coverage.at<std::uint16_t>(y, x) = value;
            }
        }
    }
}

void fillHoles(cv::Mat& coverage, std::uint16_t level, double area_px)
{
    const Components dry = componentsOf(coverage, level, false);
    std::vector<bool> chosen(static_cast<std::size_t>(dry.count), false);
    for (int k = 1; k < dry.count; ++k) {
        const int* const of = dry.stats.ptr<int>(k);
        const bool is_inside = of[cv::CC_STAT_LEFT] > 0 && of[cv::CC_STAT_TOP] > 0 &&
                               of[cv::CC_STAT_LEFT] + of[cv::CC_STAT_WIDTH] < coverage.cols &&
                               of[cv::CC_STAT_TOP] + of[cv::CC_STAT_HEIGHT] < coverage.rows;
        chosen[static_cast<std::size_t>(k)] = is_inside && of[cv::CC_STAT_AREA] < area_px;
    }
    paint(coverage, dry, chosen, kFull);
}

void keepLargest(cv::Mat& coverage, std::uint16_t level, std::size_t count)
{
    const Components liquid = componentsOf(coverage, level, true);
    std::vector<int> order;
    for (int k = 1; k < liquid.count; ++k) {
        order.push_back(k);
    }
    const auto place = [&](int k) {
        const int* const of = liquid.stats.ptr<int>(k);
        return std::array{-of[cv::CC_STAT_AREA], of[cv::CC_STAT_TOP], of[cv::CC_STAT_LEFT], k};
    };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return place(a) < place(b); });
    std::vector<bool> chosen(static_cast<std::size_t>(liquid.count), false);
    for (std::size_t i = count; i < order.size(); ++i) {
        chosen[static_cast<std::size_t>(order[i])] = true;
    }
    paint(coverage, liquid, chosen, 0);
}

}  // namespace

void CleanOptions::validate() const
{
    require(smooth >= 0.0 && std::isfinite(smooth), "smooth", smooth, "finite and at least 0 m");
    require(fill_holes >= 0.0 && std::isfinite(fill_holes), "fill_holes", fill_holes, "finite and at least 0 m²");
    require(!keep || *keep > 0, "keep", keep.value_or(1), "at least 1");
}

Mask clean(Mask mask, const CleanOptions& options, double pixel_size, double threshold)
{
    mask.validate();
    options.validate();
    const auto level = static_cast<std::uint16_t>(std::ceil(threshold * kFull));
    try {
        if (options.smooth > 0.0) {
            smooth(mask, options.smooth / pixel_size, threshold);
        }
        cv::Mat coverage = imageOf(mask);
        if (options.fill_holes > 0.0) {
            fillHoles(coverage, level, options.fill_holes / (pixel_size * pixel_size));
        }
        if (options.keep) {
            keepLargest(coverage, level, *options.keep);
        }
    } catch (const cv::Exception&) {
        throw std::bad_alloc();  // OpenCV has no other reason to refuse an image of levels
    }
    return mask;
}

}  // namespace droplet
