// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clear liquid has the colours of its ground, so colours do not tell it; its rim is an edge. L. Grady, "Random walks
// for image segmentation", IEEE Trans. Pattern Anal. Mach. Intell. 28 (2006) 1768: a pixel is liquid if a walker that
// starts there, and crosses edges seldom, more probably comes to a stroke on liquid first. These probabilities solve
// Laplace's equation on the grid of pixels, equation 9 of the paper; one sparse factorisation solves it.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mask/seeds.h"
#include "image/image.h"
#include "image/image_file.h"
#include "mask/edges.h"
#include "mask/segmentation.h"

namespace droplet {
namespace {

/// Longer side of the picture that is solved [px]. A factorisation of 600 by 600 takes 3 s and 300 MB.
constexpr int kLongest = 600;

/// How much less a walker crosses an edge: the weight is exp(-kBeta g²/m), where g is the difference of colours and m
/// the mean of g². As in GrabCut's term for edges, where it is 1/2, but twenty times as strong: with 1/2, walkers leak
/// through the half of a clear droplet's rim that is in the light.
constexpr double kBeta = 10.0;
constexpr double kLeast = 1e-6;  // of a weight, so that the matrix stays regular

struct Grid {
    int width = 0;
    int height = 0;

    [[nodiscard]] int at(int x, int y) const { return y * width + x; }
};

/// The strokes on a smaller grid: no stroke gets lost; where both meet, the larger one stays.
std::vector<Seed> onGrid(const Seeds& seeds, const Grid& grid)
{
    const auto cells = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
    std::vector<std::array<int, 2>> counts(cells, {0, 0});  // dry, liquid
    for (int y = 0; y < seeds.height; ++y) {
        for (int x = 0; x < seeds.width; ++x) {
            const Seed seed = seeds.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(seeds.width) +
                                           static_cast<std::size_t>(x)];
            if (seed != Seed::Open) {
                const auto part = [](int i, int from, int to) {
                    return static_cast<int>(static_cast<std::int64_t>(i) * to / from);
                };
                const int cell = grid.at(part(x, seeds.width, grid.width), part(y, seeds.height, grid.height));
                ++counts[static_cast<std::size_t>(cell)][seed == Seed::Liquid ? 1 : 0];
            }
        }
    }
    std::vector<Seed> result(cells, Seed::Open);
    for (std::size_t i = 0; i < cells; ++i) {
        const auto [dry, liquid] = counts[i];
        result[i] = dry == 0 && liquid == 0 ? Seed::Open : liquid > dry ? Seed::Liquid : Seed::Dry;
    }
    return result;
}

/// Colours of the picture on a smaller grid, without its grain.
cv::Mat coloursOn(const Image& image, const Grid& grid)
{
    cv::Mat full(image.height, image.width, CV_32FC3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto& colour = image.colour[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                              static_cast<std::size_t>(x)];
            full.at<cv::Vec3f>(y, x) = cv::Vec3f(colour[0], colour[1], colour[2]);
        }
    }
    cv::Mat small;
    cv::resize(full, small, {grid.width, grid.height}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, 0.7);
    return small;
}

double squared(const cv::Vec3f& difference)
{
    return static_cast<double>(difference.dot(difference));
}

/// Probability for every pixel of the grid that it is liquid.
cv::Mat probabilities(const cv::Mat& colours, const std::vector<Seed>& seeds, const Grid& grid)
{
    const std::array<std::array<int, 2>, 4> steps{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};
    double sum = 0.0;
    double count = 0.0;
    const auto visit = [&](const auto& edge) {
        for (int y = 0; y < grid.height; ++y) {
            for (int x = 0; x < grid.width; ++x) {
                for (const auto& [dx, dy] : steps) {
                    if (x + dx >= 0 && x + dx < grid.width && y + dy < grid.height) {
                        const double difference =
                            squared(colours.at<cv::Vec3f>(y, x) - colours.at<cv::Vec3f>(y + dy, x + dx));
                        edge(grid.at(x, y), grid.at(x + dx, y + dy), difference, dx * dy != 0);
                    }
                }
            }
        }
    };
    visit([&](int /*from*/, int /*to*/, double difference, bool /*is_diagonal*/) {
        sum += difference;
        count += 1.0;
    });
    const double mean = count > 0.0 && sum > 0.0 ? sum / count : 1.0;
    std::vector<int> unknown(seeds.size(), -1);
    int open = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i] == Seed::Open) {
            unknown[i] = open++;
        }
    }
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * static_cast<std::size_t>(open));
    Eigen::VectorXd right = Eigen::VectorXd::Zero(open);
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(open);
    visit([&](int from, int to, double difference, bool is_diagonal) {
        // A quarter along diagonals: the difference quotient of nine points, which has no preferred directions.
        const double weight = (is_diagonal ? 0.25 : 1.0) * std::max(std::exp(-kBeta * difference / mean), kLeast);
        for (const auto& [here, there] : {std::pair{from, to}, {to, from}}) {
            const int row = unknown[static_cast<std::size_t>(here)];
            const int column = unknown[static_cast<std::size_t>(there)];
            if (row < 0) {
                continue;
            }
            diagonal[row] += weight;
            if (column < 0) {
                right[row] += seeds[static_cast<std::size_t>(there)] == Seed::Liquid ? weight : 0.0;
            } else if (column < row) {
                entries.emplace_back(row, column, -weight);
            }
        }
    });
    for (int i = 0; i < open; ++i) {
        entries.emplace_back(i, i, diagonal[i]);
    }
    Eigen::SparseMatrix<double> matrix(open, open);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd found =
        open > 0 ? Eigen::VectorXd(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right))
                 : Eigen::VectorXd();
    cv::Mat result(grid.height, grid.width, CV_32F);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const double value = unknown[i] >= 0 ? found[unknown[i]] : seeds[i] == Seed::Liquid ? 1.0 : 0.0;
        result.at<float>(static_cast<int>(i) / grid.width, static_cast<int>(i) % grid.width) =
            static_cast<float>(value);
    }
    return result;
}

/// Coverage by liquid: where the probability is a half, an edge of one pixel.
LevelPlane coverageOf(const cv::Mat& probability, int width, int height)
{
    constexpr float kFlat = 1e-4F;  // change from pixel to pixel that is none
    cv::Mat full;
    cv::resize(probability, full, {width, height}, 0, 0, cv::INTER_CUBIC);
    LevelPlane plane{width, height, {}};
    plane.levels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto at = [&](int i, int j) {
                return full.at<float>(std::clamp(j, 0, height - 1), std::clamp(i, 0, width - 1));
            };
            const float slope = 0.5F * std::hypot(at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1));
            const float covered = std::clamp(0.5F + (at(x, y) - 0.5F) / std::max(slope, kFlat), 0.0F, 1.0F);
            plane.levels.push_back(static_cast<std::uint16_t>(std::lrint(65535.0F * covered)));
        }
    }
    return plane;
}

}  // namespace

Seeds decodeSeeds(std::span<const std::byte> encoded)
{
    const Image image = decodeImage(encoded, {});
    constexpr std::size_t kLevels = 256;
    constexpr std::size_t kAlike = 8;  // levels by which even grey differs after JPEG
    Seeds seeds{image.width, image.height, {}};
    seeds.pixels.reserve(image.luma.size());
    std::array<std::size_t, kLevels> open{};  // opaque pixels that are open, by their level
    for (std::size_t i = 0; i < image.luma.size(); ++i) {
        const int alpha = image.alpha.empty() ? 65535 : image.alpha[i];
        const int luma = image.premultiplied && alpha > 0
                             ? static_cast<int>(std::int64_t{65535} * image.luma[i] / alpha)
                             : image.luma[i];
        seeds.pixels.push_back(alpha < 32768   ? Seed::Open
                               : luma >= 49151 ? Seed::Liquid
                               : luma <= 16384 ? Seed::Dry
                                               : Seed::Open);
        open[std::min(static_cast<std::size_t>(luma) / 257, kLevels - 1)] +=
            alpha >= 32768 && seeds.pixels.back() == Seed::Open ? 1 : 0;
    }
    const auto most = static_cast<std::size_t>(std::max_element(open.begin(), open.end()) - open.begin());
    std::size_t others = 0;
    for (std::size_t level = 0; level < kLevels; ++level) {
        others += std::max(level, most) - std::min(level, most) > kAlike ? open[level] : 0;
    }
    seeds.varied = static_cast<double>(others) / static_cast<double>(seeds.pixels.size());
    return seeds;
}

Seeds readSeeds(const std::filesystem::path& path)
{
    return fromImageFile(path, [&](std::span<const std::byte> encoded) { return decodeSeeds(encoded); });
}

Segmented segmentSeeds(const Image& image, const Seeds& seeds)
{
    if (seeds.width != image.width || seeds.height != image.height) {
        const auto size = [](int width, int height) { return std::to_string(width) + " x " + std::to_string(height); };
        throw Error(ErrorCode::InvalidInput, "options.seeds has " + size(seeds.width, seeds.height) +
                                                 " pixels, must be " + size(image.width, image.height) +
                                                 ", as the picture");
    }
    for (const auto& [seed, stroke] :
         {std::pair{Seed::Liquid, "light stroke, on liquid"}, {Seed::Dry, "dark stroke, on dry ground"}}) {
        if (std::find(seeds.pixels.begin(), seeds.pixels.end(), seed) == seeds.pixels.end()) {
            throw Error(ErrorCode::InvalidInput, std::string("options.seeds must have a ") + stroke);
        }
    }
    const double scale = std::min(1.0, static_cast<double>(kLongest) / std::max(image.width, image.height));
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(scale * pixels))); };
    const Grid grid{side(image.width), side(image.height)};
    Segmented result;
    result.coverage =
        coverageOf(probabilities(coloursOn(image, grid), onGrid(seeds, grid), grid), image.width, image.height);
    result.confidence = 1.0;  // somebody looked
    const cv::Mat luma = workingImage({image.width, image.height, image.luma}, std::max(image.width, image.height));
    const cv::Mat coverage(image.height, image.width, CV_16U, result.coverage.levels.data());
    const cv::Mat is_liquid = coverage >= 32768;
    result.level_dry = medianLevel(luma, ~is_liquid);
    result.level_liquid = medianLevel(luma, is_liquid);
    return result;
}

}  // namespace droplet
