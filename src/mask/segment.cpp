// SPDX-License-Identifier: GPL-3.0-or-later
//
// Segmentation of photographs. The first threshold is a surface through the grey levels at edges: S. D. Yanowitz and A.
// M. Bruckstein, "A new method for image segmentation" (1989); its validation also drops regions without an edge. Then
// the light is divided out: the level of the ground is estimated everywhere, and the share of it that liquid reflects.
// By colour: C. Rother, V. Kolmogorov and A. Blake, "GrabCut" (2004), in OpenCV's implementation.
#include "droplet/mask/segment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "droplet/error.h"
#include "mask/edges.h"
#include "mask/segmentation.h"

namespace droplet {
namespace {

constexpr double kWhite = 65535.0;

/// Pixels this near to a rim get fractional coverage; all others are liquid or dry [px of the working image].
constexpr int kBand = 3;

/// Standard deviation of the noise in an image, from the median absolute value of its Laplacian, which edges and light
/// hardly change.
double noiseOf(const cv::Mat& image)
{
    cv::Mat laplacian;
    cv::Laplacian(image, laplacian, CV_32F, 1);
    std::vector<float> sizes;
    sizes.reserve(laplacian.total());
    for (int y = 0; y < laplacian.rows; ++y) {
        for (int x = 0; x < laplacian.cols; ++x) {
            sizes.push_back(std::abs(laplacian.at<float>(y, x)));
        }
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    // The mask 1 1 −4 1 1 has the norm √20; half of a normal distribution lies within 0.6745.
    return *middle / 0.6745 / std::sqrt(20.0);
}

constexpr double kNarrow = 4.0;  // standard deviation [px]

/// Spreads values that are known in some places smoothly over the whole image. They are averages over a few pixels
/// where values are known there, else over four times as many, and so on.
/// @param wide  width of the narrowest averages relative to kNarrow
cv::Mat spread(const cv::Mat& values, const cv::Mat& known, double wide = 1.0)
{
    constexpr double kTrust = 1.0e-2;  // weight of a level relative to the finer one
    cv::Mat weight;
    known.convertTo(weight, CV_32F, 1.0 / 255.0);
    cv::Mat weighted = values.mul(weight);
    if (wide > 1.0) {
        const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels / wide))); };
        const cv::Size smaller{side(values.cols), side(values.rows)};
        cv::resize(weighted, weighted, smaller, 0, 0, cv::INTER_AREA);
        cv::resize(weight, weight, smaller, 0, 0, cv::INTER_AREA);
    }
    cv::Mat sum = cv::Mat::zeros(values.size(), CV_32F);
    cv::Mat total = cv::Mat::zeros(values.size(), CV_32F);
    double trust = 1.0;
    for (int level = 0;; ++level) {
        cv::Mat soft;
        cv::Mat soft_weight;
        cv::GaussianBlur(weighted, soft, {}, kNarrow);
        cv::GaussianBlur(weight, soft_weight, {}, kNarrow);
        cv::resize(soft, soft, values.size(), 0, 0, cv::INTER_LINEAR);
        cv::resize(soft_weight, soft_weight, values.size(), 0, 0, cv::INTER_LINEAR);
        sum += trust * soft;
        total += trust * soft_weight;
        if (std::max(weight.cols, weight.rows) <= 4) {
            break;
        }
        trust *= kTrust;
        const cv::Size smaller{(weight.cols + 3) / 4, (weight.rows + 3) / 4};
        cv::resize(weighted, weighted, smaller, 0, 0, cv::INTER_AREA);
        cv::resize(weight, weight, smaller, 0, 0, cv::INTER_AREA);
    }
    return sum / cv::max(total, 1e-30);
}

cv::Mat shrunk(const cv::Mat& region, int pixels)
{
    cv::Mat result;
    cv::erode(region, result, {}, {-1, -1}, pixels, cv::BORDER_CONSTANT, cv::Scalar(255));
    return result;
}

/// Inside of a region; the whole region if it has none.
cv::Mat coreOf(const cv::Mat& region)
{
    for (int pixels = kBand; pixels > 0; --pixels) {
        cv::Mat core = shrunk(region, pixels);
        if (cv::countNonZero(core) > 0) {
            return core;
        }
    }
    return region;
}

/// Share of an image's border that is marked.
double shareOfBorder(const cv::Mat& marked)
{
    cv::Mat border = cv::Mat(marked.size(), CV_8U, cv::Scalar(255));
    if (marked.cols > 2 && marked.rows > 2) {
        border(cv::Rect(1, 1, marked.cols - 2, marked.rows - 2)) = 0;
    }
    return static_cast<double>(cv::countNonZero(border & marked)) / cv::countNonZero(border);
}

/// Liquid parts of a working image, and the light on it.
struct Classification {
    cv::Mat is_liquid;  ///< 255 or 0
    cv::Mat ground;     ///< level of dry ground, also estimated under liquid
    cv::Mat share;      ///< share of it that liquid reflects, everywhere
    cv::Mat image;
};

/// Regions of dry ground inside liquid.
struct Holes {
    cv::Mat label;
    std::vector<cv::Rect> boxes;  ///< by label; empty for regions that are not holes
    std::vector<int> areas;
};

Holes holesOf(const cv::Mat& is_liquid)
{
    Holes holes;
    cv::Mat stats;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(cv::Mat(~is_liquid), holes.label, stats, centroids, 4, CV_32S);
    holes.boxes.resize(static_cast<std::size_t>(count));
    holes.areas.resize(static_cast<std::size_t>(count));
    for (int k = 1; k < count; ++k) {
        const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                           stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
        const bool is_inside = box.x > 0 && box.y > 0 && box.br().x < is_liquid.cols && box.br().y < is_liquid.rows;
        if (is_inside) {
            holes.boxes[static_cast<std::size_t>(k)] = box;
            holes.areas[static_cast<std::size_t>(k)] = stats.at<int>(k, cv::CC_STAT_AREA);
        }
    }
    return holes;
}

/// Dry ground without its smaller holes, which may be reflections of a lamp.
cv::Mat openGround(const cv::Mat& is_liquid, const Holes& holes)
{
    cv::Mat ground = ~is_liquid;
    for (std::size_t k = 1; k < holes.boxes.size(); ++k) {
        if (holes.areas[k] > 0 && holes.areas[k] < static_cast<int>(is_liquid.total() / 100)) {
            ground(holes.boxes[k]).setTo(0, holes.label(holes.boxes[k]) == static_cast<int>(k));
        }
    }
    return ground;
}

/// Fills holes that are brighter than the ground in the same light, because they are reflections of a lamp.
void fillGlints(Classification& classified)
{
    constexpr double kBrighter = 1.08;
    const Holes holes = holesOf(classified.is_liquid);
    for (std::size_t k = 1; k < holes.boxes.size(); ++k) {
        if (holes.areas[k] == 0) {
            continue;
        }
        const cv::Rect& box = holes.boxes[k];
        const cv::Mat hole = holes.label(box) == static_cast<int>(k);
        cv::Mat middle = shrunk(hole, 1);
        middle = cv::countNonZero(middle) > 0 ? middle : hole;
        if (cv::mean(classified.image(box), middle)[0] > kBrighter * cv::mean(classified.ground(box), middle)[0]) {
            classified.is_liquid(box).setTo(255, hole);
        }
    }
}

std::optional<Classification> classifyByEdges(const cv::Mat& working)
{
    constexpr int kReach = 3;
    constexpr double kMinContrast = 0.10;  // smallest contrast of an edge
    constexpr double kAboveNoise = 6.0;    // standard deviations
    constexpr int kRounds = 3;
    constexpr int kMinArea = 12;  // smallest region [px]
    cv::Mat image;
    cv::medianBlur(working, image, 3);
    const double noise = noiseOf(working);
    cv::Mat soft;
    cv::GaussianBlur(image, soft, {}, noise > 0.02 ? 1.5 : 1.0);
    const double soft_noise = noiseOf(soft);

    // Find edges by contrast, which does not depend on the light.
    const LocalRange range = localRange(soft, kReach);
    const cv::Mat step = range.max - range.min;
    const cv::Mat contrast = step / (range.max + range.min + 0.04);
    cv::Mat clear = contrast > kMinContrast;
    clear &= step > std::max(0.02, kAboveNoise * std::max(soft_noise, 0.3 * noise));
    const int edge_pixels = cv::countNonZero(clear);
    if (edge_pixels < std::max<int>(8, static_cast<int>(working.total() / 5000))) {
        return std::nullopt;
    }
    // Separate strong from faint edges by Otsu's threshold.
    cv::Mat bytes;
    contrast.convertTo(bytes, CV_8U, 255.0);
    cv::Mat edge_contrasts(1, edge_pixels, CV_8U);
    int next = 0;
    for (int y = 0; y < bytes.rows; ++y) {
        for (int x = 0; x < bytes.cols; ++x) {
            if (clear.at<std::uint8_t>(y, x) > 0) {
                edge_contrasts.at<std::uint8_t>(0, next++) = bytes.at<std::uint8_t>(y, x);
            }
        }
    }
    cv::Mat unused;
    const double strong = cv::threshold(edge_contrasts, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    const cv::Mat is_edge = (bytes > 0.8 * strong) & clear;

    Classification classified;
    classified.image = soft;
    const cv::Mat middle = 0.5 * (range.max + range.min);
    classified.is_liquid = soft < spread(middle, is_edge);
    dropRegionsWithoutEdge(classified.is_liquid, is_edge, kMinArea);
    if (shareOfBorder(classified.is_liquid) > 0.5) {
        classified.is_liquid = ~classified.is_liquid;
    }
    for (int round = 0; round < kRounds; ++round) {
        if (cv::countNonZero(classified.is_liquid) == 0) {
            return std::nullopt;
        }
        classified.ground =
            cv::max(spread(soft, coreOf(openGround(classified.is_liquid, holesOf(classified.is_liquid)))), 1e-3);
        classified.share = spread(soft / classified.ground, coreOf(classified.is_liquid));
        // Liquid must be darker than the ground everywhere, or brighter everywhere.
        const bool dark = cv::mean(classified.share, classified.is_liquid)[0] < 1.0;
        classified.share = dark ? cv::Mat(cv::min(classified.share, 0.92)) : cv::Mat(cv::max(classified.share, 1.08));
        const cv::Mat half = classified.ground.mul(0.5 * (classified.share + 1.0));
        classified.is_liquid = dark ? cv::Mat(soft < half) : cv::Mat(soft > half);
        if (dark) {
            fillGlints(classified);
        }
        dropRegionsWithoutEdge(classified.is_liquid, is_edge, kMinArea);
    }
    return cv::countNonZero(classified.is_liquid) == 0 ? std::nullopt : std::optional(classified);
}

/// Channels of a full image.
struct Channels {
    int width = 0;
    int height = 0;
    std::vector<cv::Mat> planes;  ///< CV_16UC1
};

/// Coverage of every pixel of a full image, from the liquid parts of a working image. Near rims, the pixel's level
/// between those of ground and liquid nearby decides.
LevelPlane matte(const Channels& channels, const cv::Mat& is_liquid, const std::vector<cv::Mat>& dry,
                 const std::vector<cv::Mat>& liquid)
{
    const cv::Mat surely_liquid = shrunk(is_liquid, kBand);
    const cv::Mat surely_dry = shrunk(~is_liquid, kBand);
    LevelPlane plane{channels.width, channels.height, {}};
    plane.levels.resize(static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height));
    const double per_x = static_cast<double>(is_liquid.cols) / plane.width;
    const double per_y = static_cast<double>(is_liquid.rows) / plane.height;
    tbb::parallel_for(0, plane.height, [&](int y) {
        const double v = std::clamp((y + 0.5) * per_y - 0.5, 0.0, is_liquid.rows - 1.0);
        const int y0 = static_cast<int>(v);
        const int y1 = std::min(y0 + 1, is_liquid.rows - 1);
        const auto row = std::min(static_cast<int>((y + 0.5) * per_y), is_liquid.rows - 1);
        std::uint16_t* const to = plane.levels.data() + static_cast<std::ptrdiff_t>(y) * plane.width;
        for (int x = 0; x < plane.width; ++x) {
            const auto column = std::min(static_cast<int>((x + 0.5) * per_x), is_liquid.cols - 1);
            if (surely_liquid.at<std::uint8_t>(row, column) > 0 || surely_dry.at<std::uint8_t>(row, column) > 0) {
                to[x] = surely_liquid.at<std::uint8_t>(row, column) > 0 ? 65535 : 0;
                continue;
            }
            const double u = std::clamp((x + 0.5) * per_x - 0.5, 0.0, is_liquid.cols - 1.0);
            const int x0 = static_cast<int>(u);
            const int x1 = std::min(x0 + 1, is_liquid.cols - 1);
            const auto between = [&](const cv::Mat& image) {
                const double upper = (1 - u + x0) * image.at<float>(y0, x0) + (u - x0) * image.at<float>(y0, x1);
                const double lower = (1 - u + x0) * image.at<float>(y1, x0) + (u - x0) * image.at<float>(y1, x1);
                return (1 - v + y0) * upper + (v - y0) * lower;
            };
            double along = 0.0;
            double square = 1e-12;
            for (std::size_t c = 0; c < channels.planes.size(); ++c) {
                const double from = between(dry[c]);
                const double way = between(liquid[c]) - from;
                along += way * (channels.planes[c].at<std::uint16_t>(y, x) / kWhite - from);
                square += way * way;
            }
            to[x] = static_cast<std::uint16_t>(std::lround(kWhite * std::clamp(along / square, 0.0, 1.0)));
        }
    });
    return plane;
}

/// A plane without single hot pixels and with less noise, for the rims of a full image.
cv::Mat denoised(const LevelView& plane)
{
    const cv::Mat levels(plane.height, plane.width, CV_16UC1, const_cast<std::uint16_t*>(plane.levels));
    cv::Mat result;
    cv::medianBlur(levels, result, 3);
    cv::Mat sample;
    const cv::Rect middle(plane.width / 4, plane.height / 4, std::max(1, plane.width / 2),
                          std::max(1, plane.height / 2));
    result(middle).convertTo(sample, CV_32F, 1.0 / kWhite);
    const double noise = noiseOf(sample);
    constexpr double kVisible = 0.01;
    if (noise > kVisible) {
        cv::GaussianBlur(result, result, {}, noise > 4 * kVisible ? 2.0 : 1.2);
    }
    return result;
}

LevelPlane planeOf(const cv::Mat& image)
{
    LevelPlane plane{image.cols, image.rows, {}};
    cv::Mat levels;
    image.convertTo(levels, CV_16U, kWhite);
    plane.levels.assign(levels.begin<std::uint16_t>(), levels.end<std::uint16_t>());
    return plane;
}

/// Confidence from the levels after slow changes of light are divided out, with one level of liquid for the whole
/// picture. Glints count as liquid.
double confidenceOf(const Classification& classified)
{
    const double wide = std::max(classified.image.cols, classified.image.rows) / (96.0 * kNarrow);
    const cv::Mat dry = coreOf(~classified.is_liquid);
    const cv::Mat light = cv::max(spread(classified.image, dry, wide), 1e-3);
    const cv::Mat back = classified.image / light;
    const double share = medianLevel(back, coreOf(classified.is_liquid));
    cv::Mat coverage = (1.0 - back) / (std::abs(1.0 - share) < 0.02 ? 0.02 : 1.0 - share);
    const cv::Mat is_glint = classified.is_liquid & (share < 1.0 ? cv::Mat(coverage < 0) : cv::Mat(coverage > 2.0));
    coverage.setTo(1, is_glint);
    // Levels beyond 0 and 1 are folded back, so that they add to the spread.
    const cv::Mat is_over = coverage > 0.5;
    const cv::Mat off = is_over / 255;
    cv::Mat nearest_level;
    off.convertTo(nearest_level, CV_32F);
    cv::Mat folded = cv::min(cv::abs(coverage - nearest_level), 0.45);
    cv::subtract(1.0, folded, folded, is_over);
    return maskLikeness(planeOf(folded), false).confidence;
}

/// Channels of an image's colours: red, green, blue.
Channels colourChannels(const Image& image)
{
    Channels channels{image.width, image.height, {}};
    for (std::size_t c = 0; c < 3; ++c) {
        cv::Mat plane(image.height, image.width, CV_16UC1);
        for (int y = 0; y < image.height; ++y) {
            const auto* const from = image.colour.data() + static_cast<std::ptrdiff_t>(y) * image.width;
            for (int x = 0; x < image.width; ++x) {
                plane.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(257 * from[x][c]);
            }
        }
        cv::medianBlur(plane, plane, 3);
        channels.planes.push_back(std::move(plane));
    }
    return channels;
}

/// Seeds OpenCV's random numbers for a scope, and restores their state after it.
class SeededRng {
public:
    SeededRng() : before_(cv::theRNG()) { cv::theRNG() = cv::RNG(1); }
    ~SeededRng() { cv::theRNG() = before_; }
    SeededRng(const SeededRng&) = delete;
    SeededRng& operator=(const SeededRng&) = delete;

private:
    cv::RNG before_;
};

/// Half the width of the range that holds the middle two thirds of the numbers.
double spreadOf(std::vector<float> numbers)
{
    if (numbers.empty()) {
        return 0.0;
    }
    std::sort(numbers.begin(), numbers.end());
    const auto at = [&](double share) {
        return numbers[static_cast<std::size_t>(share * static_cast<double>(numbers.size() - 1))];
    };
    return 0.5 * (at(5.0 / 6.0) - at(1.0 / 6.0));
}

}  // namespace

double hueUniformity(const Image& image, const std::vector<std::uint16_t>& coverage)
{
    constexpr int kSide = 128;         // enough for hues; also removes noise
    constexpr float kDarkest = 0.24F;  // smallest sum of the channels at which a hue is reliable
    const cv::Mat colours(image.height, image.width, CV_8UC3,
                          const_cast<std::array<std::uint8_t, 3>*>(image.colour.data()));
    const cv::Mat covers(image.height, image.width, CV_16UC1, const_cast<std::uint16_t*>(coverage.data()));
    cv::Mat small;
    cv::Mat share;
    cv::resize(colours, small, {kSide, kSide}, 0, 0, cv::INTER_AREA);
    cv::resize(covers, share, {kSide, kSide}, 0, 0, cv::INTER_AREA);
    small.convertTo(small, CV_32FC3, 1.0 / 255.0);
    std::array<std::vector<float>, 2> red;
    std::array<std::vector<float>, 2> blue;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const auto& colour = small.at<cv::Vec3f>(y, x);
            const float sum = colour[0] + colour[1] + colour[2];
            const double covered = share.at<std::uint16_t>(y, x) / kWhite;
            if (sum > kDarkest && (covered < 0.1 || covered > 0.9)) {
                const std::size_t kind = covered > 0.5 ? 1 : 0;
                red[kind].push_back(colour[0] / sum);
                blue[kind].push_back(colour[2] / sum);
            }
        }
    }
    double widest = 0.0;
    for (std::size_t kind = 0; kind < 2; ++kind) {
        widest = std::max(widest, std::hypot(spreadOf(red[kind]), spreadOf(blue[kind])));
    }
    // Two light sources on one paper give 0.05.
    return 1.0 - std::clamp((widest - 0.05) / 0.05, 0.0, 1.0);
}

const char* name(Segmentation segment)
{
    switch (segment) {
        case Segmentation::Auto:
            return "auto";
        case Segmentation::Threshold:
            return "threshold";
        case Segmentation::Adaptive:
            return "adaptive";
        case Segmentation::GrabCut:
            return "grabcut";
        case Segmentation::Colour:
            return "colour";
        case Segmentation::Seeds:
            return "seeds";
    }
    throw Error(ErrorCode::InvalidArgument, "segment must be a value of Segmentation");
}

std::optional<Segmented> segmentAdaptive(const LevelView& luma)
{
    const auto classified = classifyByEdges(workingImage(luma));
    if (!classified) {
        return std::nullopt;
    }
    Segmented result;
    result.coverage = matte({luma.width, luma.height, {denoised(luma)}}, classified->is_liquid, {classified->ground},
                            {classified->ground.mul(classified->share)});
    result.confidence = confidenceOf(*classified);
    result.level_dry = medianLevel(classified->image, ~classified->is_liquid);
    result.level_liquid = medianLevel(classified->image, classified->is_liquid);
    return result;
}

std::optional<Segmented> segmentGrabCut(const Image& image)
{
    constexpr int kLongest = 512;  // longer side of the picture from which colours are learned [px]
    constexpr int kRounds = 5;
    const LevelView luma(image.width, image.height, image.luma);
    const auto classified = classifyByEdges(workingImage(luma));
    if (!classified) {
        return std::nullopt;
    }
    const Channels full = colourChannels(image);
    const double scale = std::min(1.0, static_cast<double>(kLongest) / std::max(image.width, image.height));
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(scale * pixels))); };
    const cv::Size size{side(image.width), side(image.height)};
    std::vector<cv::Mat> small(3);
    std::vector<cv::Mat> bytes(3);
    for (std::size_t c = 0; c < 3; ++c) {
        cv::resize(full.planes[c], small[c], size, 0, 0, cv::INTER_AREA);
        small[c].convertTo(bytes[c], CV_8U, 1.0 / 257.0);
        small[c].convertTo(small[c], CV_32F, 1.0 / kWhite);
    }
    cv::Mat picture;
    cv::merge(bytes, picture);
    cv::Mat initial;
    cv::resize(classified->is_liquid, initial, size, 0, 0, cv::INTER_NEAREST);
    cv::Mat trimap(size, CV_8U, cv::Scalar(cv::GC_PR_BGD));
    trimap.setTo(cv::GC_PR_FGD, initial);
    trimap.setTo(cv::GC_FGD, shrunk(initial, 2 * kBand));
    trimap.setTo(cv::GC_BGD, shrunk(~initial, 4 * kBand));
    const cv::Mat is_first = (trimap == cv::GC_FGD) | (trimap == cv::GC_PR_FGD);
    if (cv::countNonZero(is_first) == 0 || cv::countNonZero(is_first) == static_cast<int>(is_first.total())) {
        return std::nullopt;
    }
    {
        const SeededRng rng;
        cv::Mat dry_colours;
        cv::Mat liquid_colours;
        cv::grabCut(picture, trimap, {}, dry_colours, liquid_colours, kRounds, cv::GC_INIT_WITH_MASK);
    }
    const cv::Mat is_liquid = (trimap == cv::GC_FGD) | (trimap == cv::GC_PR_FGD);
    if (cv::countNonZero(is_liquid) == 0) {
        return std::nullopt;
    }
    std::vector<cv::Mat> dry;
    std::vector<cv::Mat> liquid;
    for (const cv::Mat& plane : small) {
        dry.push_back(spread(plane, coreOf(~is_liquid)));
        liquid.push_back(spread(plane, coreOf(is_liquid)));
    }
    Segmented result;
    result.coverage = matte(full, is_liquid, dry, liquid);
    result.confidence = confidenceOf(*classified);
    cv::Mat grey;
    cv::resize(classified->image, grey, size, 0, 0, cv::INTER_AREA);
    result.level_dry = medianLevel(grey, ~is_liquid);
    result.level_liquid = medianLevel(grey, is_liquid);
    return result;
}

}  // namespace droplet
