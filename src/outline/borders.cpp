// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline/borders.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <string>

#include "droplet/error.h"

namespace droplet {
namespace {

using Chain = std::vector<cv::Point>;

constexpr std::size_t kLongestBorders = 3 * (std::size_t{1} << 20);
constexpr std::size_t kLongestBorder = std::size_t{1} << 21;
constexpr int kEast = 0;
constexpr int kWest = 2;

/// Image that is 255 where the mask is liquid.
cv::Mat thresholded(const Mask& mask, std::uint16_t level)
{
    if (static_cast<std::int64_t>(mask.width + 2LL) * (mask.height + 2LL) > std::numeric_limits<int>::max()) {
        throw Error(ErrorCode::InvalidInput, "mask size " + std::to_string(mask.width) + " x " +
                                                 std::to_string(mask.height) + " must be less than 2^31 pixels");
    }
    cv::Mat image(mask.height, mask.width, CV_8UC1);
    const auto width = static_cast<std::size_t>(mask.width);
    tbb::parallel_for(0, mask.height, [&](int y) {
        const std::uint16_t* from = mask.coverage.data() + static_cast<std::size_t>(y) * width;
        std::uint8_t* to = image.ptr(y);
        for (std::size_t x = 0; x < width; ++x) {
            to[x] = from[x] >= level ? 255 : 0;
        }
    });
    return image;
}

/// Number of pixel sides between liquid and dry.
std::size_t borderLength(const cv::Mat& image)
{
    std::vector<std::size_t> counts(static_cast<std::size_t>(image.rows));
    const std::vector<std::uint8_t> dry(static_cast<std::size_t>(image.cols), 0);
    tbb::parallel_for(0, image.rows, [&](int y) {
        const std::uint8_t* row = image.ptr(y);
        const std::uint8_t* above = y == 0 ? dry.data() : image.ptr(y - 1);
        std::size_t count = (row[0] & 1U) + (row[image.cols - 1] & 1U);
        for (int x = 0; x < image.cols; ++x) {
            count += (row[x] ^ above[x]) & 1U;
            count += y + 1 == image.rows ? row[x] & 1U : 0U;
            count += x > 0 ? (row[x] ^ row[x - 1]) & 1U : 0U;
        }
        counts[static_cast<std::size_t>(y)] = count;
    });
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

void checkLength(std::size_t length, std::size_t max, const char* of)
{
    if (length > max) {
        throw Error(ErrorCode::InvalidInput, std::string("the footprint's ") + of + " " + std::to_string(length) +
                                                 " pixels long, more than the limit of " + std::to_string(max) +
                                                 "; make the picture smaller or smooth it");
    }
}

/// Direction of a step to one of eight neighbours, in eighths of a turn, counterclockwise from east as seen on screen.
int eighths(const cv::Point& from, const cv::Point& to)
{
    constexpr std::array<int, 9> kEighths{3, 2, 1, 4, 0, 0, 5, 6, 7};
    const int place = 3 * (to.y - from.y + 1) + (to.x - from.x + 1);
    return kEighths[static_cast<std::size_t>(place)];
}

/// Crossings to the dry neighbours along a chain: at each pixel, counterclockwise from the previous pixel of the chain
/// to the next.
Border crossingsOf(const Chain& chain)
{
    Border border;
    border.reserve(2 * chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const cv::Point& at = chain[i];
        const int back = eighths(at, chain[(i + chain.size() - 1) % chain.size()]);
        const int ahead = eighths(at, chain[(i + 1) % chain.size()]);
        for (int k = back + 1; k <= back + 8 && (chain.size() == 1 || (k - ahead) % 8 != 0); ++k) {
            if (k % 2 == 0) {
                border.push_back({at.x, at.y, k / 2 % 4});
            }
        }
    }
    return border;
}

/// RETR_CCOMP would tell which contours are holes. But it searches the component of every hole, which takes 23 s for
/// 2048² pixels of noise.
std::vector<Chain> contoursOf(const Mask& mask, std::uint16_t level)
{
    const cv::Mat image = thresholded(mask, level);
    // The next steps take some 300 bytes and 5 µs per pixel side.
    checkLength(borderLength(image), kLongestBorders, "borders are");
    std::vector<Chain> chains;
    try {
        cv::findContours(image, chains, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    } catch (const cv::Exception&) {
        throw std::bad_alloc();  // findContours has no other reason to refuse an image of bytes
    }
    return chains;
}

}  // namespace

std::vector<Border> followBorders(const Mask& mask, std::uint16_t level)
{
    std::vector<Chain> chains = contoursOf(mask, level);
    std::vector<Border> borders(chains.size());
    tbb::parallel_for(std::size_t{0}, chains.size(), [&](std::size_t k) {
        // A chain begins at its first pixel. No pixel before the first pixel of a component is liquid. At a hole, the
        // neighbour above the hole is.
        const cv::Point first = chains[k].front();
        const bool is_hole = first.y > 0 && first.x + 1 < mask.width && mask.at(first.x + 1, first.y - 1) >= level;
        borders[k] = crossingsOf(chains[k]);
        chains[k] = {};
        const Crossing start{first.x, first.y, is_hole ? kEast : kWest};
        std::rotate(borders[k].begin(), std::find(borders[k].begin(), borders[k].end(), start), borders[k].end());
    });
    // One core fairs a border as a whole, in twice the memory.
    for (const Border& border : borders) {
        checkLength(border.size(), kLongestBorder, "border is");
    }
    const auto place = [](const Border& border) {
        const Crossing& first = border.front();
        return std::pair{first.y, first.x + (first.direction == kEast ? 1 : 0)};
    };
    std::sort(borders.begin(), borders.end(), [&](const Border& a, const Border& b) { return place(a) < place(b); });
    return borders;
}

}  // namespace droplet
