// SPDX-License-Identifier: GPL-3.0-or-later
#include "mask/edges.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace droplet {
namespace {

void dropRegions(cv::Mat& is_liquid, const cv::Mat& at_edge, int min_area, bool liquid)
{
    cv::Mat label;
    cv::Mat stats;
    cv::Mat centroids;
    const cv::Mat kind = liquid ? is_liquid : cv::Mat(~is_liquid);
    const int count = cv::connectedComponentsWithStats(kind, label, stats, centroids, liquid ? 8 : 4, CV_32S);
    struct Rim {
        int length = 0;
        int at_edge = 0;
    };
    std::vector<Rim> rims(static_cast<std::size_t>(count));
    cv::Mat inner;
    cv::erode(kind, inner, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
    for (int y = 0; y < label.rows; ++y) {
        for (int x = 0; x < label.cols; ++x) {
            const int k = label.at<int>(y, x);
            if (k > 0 && inner.at<std::uint8_t>(y, x) == 0) {
                Rim& rim = rims[static_cast<std::size_t>(k)];
                ++rim.length;
                rim.at_edge += at_edge.at<std::uint8_t>(y, x) > 0 ? 1 : 0;
            }
        }
    }
    int largest = 0;
    for (int k = 1; k < count; ++k) {
        largest =
            largest == 0 || stats.at<int>(k, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA) ? k : largest;
    }
    std::vector<bool> dropped(static_cast<std::size_t>(count), false);
    for (int k = 1; k < count; ++k) {
        const Rim& rim = rims[static_cast<std::size_t>(k)];
        dropped[static_cast<std::size_t>(k)] =
            k != largest && (2 * rim.at_edge < rim.length || stats.at<int>(k, cv::CC_STAT_AREA) < min_area);
    }
    for (int y = 0; y < label.rows; ++y) {
        for (int x = 0; x < label.cols; ++x) {
            if (dropped[static_cast<std::size_t>(label.at<int>(y, x))]) {
                is_liquid.at<std::uint8_t>(y, x) = liquid ? 0 : 255;
            }
        }
    }
}

}  // namespace

cv::Mat workingImage(const LevelView& plane, int longest)
{
    const cv::Mat levels(plane.height, plane.width, CV_16UC1, const_cast<std::uint16_t*>(plane.levels));
    const double scale = std::min(1.0, static_cast<double>(longest) / std::max(plane.width, plane.height));
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(scale * pixels))); };
    cv::Mat small = levels;
    if (scale < 1.0) {
        cv::resize(levels, small, {side(plane.width), side(plane.height)}, 0, 0, cv::INTER_AREA);
    }
    cv::Mat image;
    small.convertTo(image, CV_32FC1, 1.0 / 65535.0);
    return image;
}

double medianLevel(const cv::Mat& image, const cv::Mat& region)
{
    std::vector<float> levels;
    for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
            if (region.at<std::uint8_t>(y, x) > 0) {
                levels.push_back(image.at<float>(y, x));
            }
        }
    }
    const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
    std::nth_element(levels.begin(), middle, levels.end());
    return levels.empty() ? 0.0 : *middle;
}

LocalRange localRange(const cv::Mat& image, int reach)
{
    LocalRange range;
    const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
    cv::erode(image, range.min, window);
    cv::dilate(image, range.max, window);
    return range;
}

void dropRegionsWithoutEdge(cv::Mat& is_liquid, const cv::Mat& is_edge, int min_area)
{
    cv::Mat at_edge;
    cv::dilate(is_edge, at_edge, {});
    dropRegions(is_liquid, at_edge, min_area, true);
    dropRegions(is_liquid, at_edge, min_area, false);
}

}  // namespace droplet
