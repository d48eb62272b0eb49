// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/outline/outline.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "support/masks.h"

namespace droplet {
namespace {

using testing::disc;
using testing::drawnMask;
using testing::hardMask;
using testing::Inside;
using testing::rectangle;
using testing::smoothMask;

constexpr double kPi = std::numbers::pi;
constexpr double kPixelsPerDegree = 180.0 / kPi;

/// Options for outlines in pixels, so that limits in pixels can be compared directly.
TraceOptions inPixels()
{
    TraceOptions options;
    options.pixel_size = 1.0;
    return options;
}

/// Coordinates in the outline of a point of the image: origin at the centre, y up.
Vec2 place(const Mask& mask, Vec2 pixel)
{
    return {pixel.x - 0.5 * mask.width, 0.5 * mask.height - pixel.y};
}

struct DiscError {
    double area = 0.0;      ///< relative error
    double distance = 0.0;  ///< largest distance of a vertex from the circle [px]
    double normal = 0.0;    ///< rms along the rim [rad]
};

DiscError discError(const Mask& mask, Vec2 centre, double radius)
{
    const Outline outline = trace(mask, inPixels());
    EXPECT_EQ(outline.loops.size(), 1U);
    const Loop& loop = outline.loops[0];
    const Vec2 middle = place(mask, centre);
    DiscError error;
    error.area = std::abs(signedArea(loop) / (kPi * radius * radius) - 1.0);
    double squares = 0.0;
    double rim = 0.0;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        const Vec2 a = loop.points[i] - middle;
        const Vec2 b = loop.points[(i + 1) % loop.points.size()] - middle;
        error.distance = std::max(error.distance, std::abs(length(a) - radius));
        const Vec2 edge = b - a;
        const Vec2 outward = 0.5 * (a + b);
        const double angle = std::atan2(dot(edge, outward), cross(outward, edge));
        squares += angle * angle * length(edge);
        rim += length(edge);
    }
    error.normal = std::sqrt(squares / rim);
    return error;
}

/// Largest distance of a shape's true corners from the nearest corner of the outline [px].
double cornerError(const Outline& outline, const std::vector<Vec2>& corners)
{
    double worst = 0.0;
    for (const Vec2 corner : corners) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Loop& loop : outline.loops) {
            for (std::size_t i = 0; i < loop.points.size(); ++i) {
                if (loop.corner[i] != 0) {
                    nearest = std::min(nearest, length(loop.points[i] - corner));
                }
            }
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

std::vector<Vec2> rectangleCorners(const Mask& mask, Vec2 centre, Vec2 half, double angle)
{
    std::vector<Vec2> corners;
    for (const Vec2 s : {Vec2{1, 1}, Vec2{-1, 1}, Vec2{-1, -1}, Vec2{1, -1}}) {
        const Vec2 d{s.x * half.x, s.y * half.y};
        corners.push_back(place(mask, {centre.x + std::cos(angle) * d.x - std::sin(angle) * d.y,
                                       centre.y + std::sin(angle) * d.x + std::cos(angle) * d.y}));
    }
    return corners;
}

std::size_t cornerCount(const Outline& outline)
{
    std::size_t count = 0;
    for (const Loop& loop : outline.loops) {
        count += static_cast<std::size_t>(std::count(loop.corner.begin(), loop.corner.end(), 1));
    }
    return count;
}

/// Whether any two edges that are not neighbours cross or touch; brute force, for small masks.
bool anyEdgesMeet(const Outline& outline)
{
    struct Edge {
        Vec2 a;
        Vec2 b;
        std::size_t loop;
        std::size_t index;
    };
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < outline.loops.size(); ++k) {
        const std::vector<Vec2>& p = outline.loops[k].points;
        for (std::size_t i = 0; i < p.size(); ++i) {
            edges.push_back({p[i], p[(i + 1) % p.size()], k, i});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& e, const Edge& f) { return std::min(e.a.x, e.b.x) < std::min(f.a.x, f.b.x); });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& e = edges[i];
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            const Edge& f = edges[j];
            if (std::min(f.a.x, f.b.x) > std::max(e.a.x, e.b.x)) {
                break;
            }
            const std::size_t n = outline.loops[e.loop].points.size();
            const bool neighbours = e.loop == f.loop && ((e.index + 1) % n == f.index || (f.index + 1) % n == e.index);
            const bool apart =
                std::max(e.a.y, e.b.y) < std::min(f.a.y, f.b.y) || std::max(f.a.y, f.b.y) < std::min(e.a.y, e.b.y);
            if (neighbours || apart) {
                continue;
            }
            const Vec2 u = e.b - e.a;
            const Vec2 v = f.b - f.a;
            if (cross(u, f.a - e.a) * cross(u, f.b - e.a) <= 0 && cross(v, e.a - f.a) * cross(v, e.b - f.a) <= 0) {
                return true;
            }
        }
    }
    return false;
}

/// Random number generator; the distributions of the standard library differ between implementations.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : state_(seed * 2862933555777941757U + 3037000493U) {}
    double uniform()
    {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state_ >> 11U) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

Mask noiseMask(int size, double density, bool hard, std::uint64_t seed)
{
    Noise noise(seed);
    Mask mask;
    mask.width = size;
    mask.height = size;
    for (int i = 0; i < size * size; ++i) {
        const double u = noise.uniform();
        mask.coverage.push_back(hard ? (u < density ? 65535 : 0) : static_cast<std::uint16_t>(u * 65535.0));
    }
    return mask;
}

// Limits for a disc of radius 100 px. Measured: area 4e-5, rim 0.02 px, normals 0.27°.
TEST(Outline, AntiAliasedDiscIsACircle)
{
    for (const Vec2 centre : {Vec2{120, 120}, Vec2{120.37, 119.78}, Vec2{119.5, 120.5}}) {
        const DiscError error = discError(smoothMask(240, 240, disc(centre, 100)), centre, 100);
        EXPECT_LT(error.area, 1e-4);
        EXPECT_LT(error.distance, 0.1);
        EXPECT_LT(error.normal * kPixelsPerDegree, 1.5);
    }
}

// Measured: area 3e-4, normals 0.5°. Pixels give the place of the rim only to a quarter pixel.
TEST(Outline, HardDiscIsACircleWithoutStaircases)
{
    for (const Vec2 centre : {Vec2{120, 120}, Vec2{120.37, 119.78}, Vec2{119.5, 120.5}}) {
        const DiscError error = discError(hardMask(240, 240, disc(centre, 100)), centre, 100);
        EXPECT_LT(error.area, 2e-3);
        EXPECT_LT(error.distance, 0.5);
        EXPECT_LT(error.normal * kPixelsPerDegree, 4.0);
    }
}

TEST(Outline, SmallDiscsStayRound)
{
    for (const double radius : {3.0, 5.0, 10.0, 20.0}) {
        const Vec2 centre{30.2, 29.9};
        const DiscError error = discError(smoothMask(60, 60, disc(centre, radius)), centre, radius);
        EXPECT_LT(error.distance, 0.1) << radius;
        EXPECT_LT(error.normal * kPixelsPerDegree, 3.0) << radius;
    }
}

TEST(Outline, DiscsHaveNoCorners)
{
    for (const double radius : {4.0, 6.5, 8.0, 10.0, 30.0, 100.0}) {
        for (const double off : {0.0, 0.3}) {
            const Inside inside = disc({120 + off, 120 - off}, radius);
            EXPECT_EQ(cornerCount(trace(smoothMask(240, 240, inside), inPixels())), 0U) << radius << " " << off;
        }
    }
}

struct Square {
    double angle = 0.0;
    double half = 0.0;
};

// The limit is 0.7 px. Measured: at most 0.2 px anti-aliased, 0.69 px hard (at 0.02 rad, where one step of the
// staircase is 50 px long).
TEST(Outline, TurnedSquaresKeepTheirCorners)
{
    for (const Square square : {Square{0.0, 60}, Square{0.02, 60}, Square{0.1, 60}, Square{0.3, 60}, Square{0.5, 60},
                                Square{kPi / 4, 60}, Square{0.3, 10}, Square{0.5, 10}, Square{kPi / 4, 10}}) {
        const Vec2 centre{100.3, 99.6};
        const Inside inside = rectangle(centre, {square.half, square.half}, square.angle);
        for (const bool hard : {false, true}) {
            const Mask mask = hard ? hardMask(200, 200, inside) : smoothMask(200, 200, inside);
            const Outline outline = trace(mask, inPixels());
            const double error =
                cornerError(outline, rectangleCorners(mask, centre, {square.half, square.half}, square.angle));
            EXPECT_LT(error, 0.7) << square.angle << " " << square.half << (hard ? " hard" : "");
            EXPECT_EQ(cornerCount(outline), 4U) << square.angle << " " << square.half << (hard ? " hard" : "");
        }
    }
}

TEST(Outline, SquareOnPixelBordersIsExact)
{
    const Mask mask = hardMask(40, 30, rectangle({20, 15}, {10, 8}, 0.0));
    const Outline outline = trace(mask, inPixels());
    EXPECT_NEAR(signedArea(outline.loops[0]), 20.0 * 16.0, 1e-9);
    EXPECT_LT(cornerError(outline, rectangleCorners(mask, {20, 15}, {10, 8}, 0.0)), 1e-9);
}

TEST(Outline, CornersCanBeTurnedOff)
{
    TraceOptions options = inPixels();
    options.corners = false;
    EXPECT_EQ(cornerCount(trace(hardMask(40, 30, rectangle({20, 15}, {10, 8}, 0.0)), options)), 0U);
}

// A straight edge crosses a hard raster in steps, but the outline must be straight. The limit is what is visible in a
// highlight: 0.5° away from the ends. Measured: 0.2°.
TEST(Outline, SlantedEdgesOfHardMasksAreStraight)
{
    for (const double slope : {1.0 / 7, 1.0 / 13, 0.4}) {
        const double angle = std::atan(slope);
        const Mask mask = hardMask(
            300, 200, [&](Vec2 p) { return p.x > 10 && p.x < 290 && p.y < 190 && p.y > 60.3 + slope * (p.x - 150); });
        const Outline outline = trace(mask, inPixels());
        double squares = 0.0;
        double rim = 0.0;
        const std::vector<Vec2>& points = outline.loops[0].points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec2 edge = points[(i + 1) % points.size()] - points[i];
            // The slanted side has liquid below it. It runs to the left and falls to the right in the image.
            if (points[i].y > -60 && std::abs(points[i].x) < 110) {
                const double off = std::remainder(std::atan2(-edge.y, -edge.x) + angle, 2 * kPi);
                squares += off * off * length(edge);
                rim += length(edge);
            }
        }
        EXPECT_GT(rim, 200.0);
        EXPECT_LT(std::sqrt(squares / rim) * kPixelsPerDegree, 0.5) << slope;
    }
}

TEST(Outline, HasTheLoopsThatOpenCvFinds)
{
    for (const double density : {0.2, 0.5, 0.7}) {
        const Mask mask = noiseMask(60, density, true, 7);
        cv::Mat image(mask.height, mask.width, CV_8UC1);
        for (int y = 0; y < mask.height; ++y) {
            for (int x = 0; x < mask.width; ++x) {
                image.at<std::uint8_t>(y, x) = mask.at(x, y) > 0 ? 255 : 0;
            }
        }
        std::vector<std::vector<cv::Point>> contours;
        cv::findContours(image, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
        TraceOptions options = inPixels();
        options.speck_size = 0.0;
        EXPECT_EQ(trace(mask, options).loops.size(), contours.size());
    }
}

/// Mask of the pixels whose centre lies in the outline, by crossing counts along rows.
std::vector<std::uint8_t> rasterise(const Outline& outline, const Mask& mask)
{
    std::vector<std::uint8_t> result(mask.coverage.size(), 0);
    for (int y = 0; y < mask.height; ++y) {
        const double row = 0.5 * mask.height - (y + 0.5);
        for (const Loop& loop : outline.loops) {
            for (std::size_t i = 0; i < loop.points.size(); ++i) {
                const Vec2 a = loop.points[i];
                const Vec2 b = loop.points[(i + 1) % loop.points.size()];
                if ((a.y > row) == (b.y > row)) {
                    continue;
                }
                const double at = a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x) + 0.5 * mask.width;
                for (int x = std::max(0, static_cast<int>(std::ceil(at - 0.5))); x < mask.width; ++x) {
                    result[static_cast<std::size_t>(y * mask.width + x)] ^= 1U;
                }
            }
        }
    }
    return result;
}

TEST(Outline, SeparatesThePixelCentresOfAHardMask)
{
    for (const double density : {0.1, 0.3, 0.5, 0.6, 0.8, 0.95}) {
        const Mask mask = noiseMask(70, density, true, 11);
        TraceOptions options = inPixels();
        options.speck_size = 0.0;
        const std::vector<std::uint8_t> back = rasterise(trace(mask, options), mask);
        for (std::size_t i = 0; i < back.size(); ++i) {
            ASSERT_EQ(back[i] != 0, mask.coverage[i] > 0) << density << " pixel " << i;
        }
    }
}

TEST(Outline, NeverCrossesItselfWhateverTheMask)
{
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        for (const double density : {0.3, 0.5, 0.6}) {
            for (const bool hard : {true, false}) {
                TraceOptions options = inPixels();
                options.speck_size = 0.0;
                EXPECT_FALSE(anyEdgesMeet(trace(noiseMask(50, density, hard, seed), options)))
                    << seed << " " << density;
            }
        }
    }
}

TEST(Outline, IsTheSameWithAnyNumberOfThreads)
{
    for (const bool hard : {false, true}) {
        const Mask mask = noiseMask(150, 0.6, hard, 5);
        std::vector<Outline> outlines;
        for (const std::size_t threads : {1U, 2U, 7U}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            outlines.push_back(trace(mask, inPixels()));
        }
        ASSERT_GT(outlines[0].loops.size(), 50U);
        for (const Outline& other : outlines) {
            ASSERT_EQ(other.loops.size(), outlines[0].loops.size());
            EXPECT_EQ(other.specks_dropped, outlines[0].specks_dropped);
            EXPECT_EQ(other.largest_speck_px, outlines[0].largest_speck_px);
            for (std::size_t k = 0; k < other.loops.size(); ++k) {
                EXPECT_EQ(other.loops[k].points, outlines[0].loops[k].points);
                EXPECT_EQ(other.loops[k].corner, outlines[0].loops[k].corner);
            }
        }
    }
}

TEST(Outline, OuterLoopsRunCounterClockwiseAndHolesClockwise)
{
    const Outline outline = trace(drawnMask(".........\n"
                                            ".#######.\n"
                                            ".#.....#.\n"
                                            ".#.###.#.\n"
                                            ".#.###.#.\n"
                                            ".#.....#.\n"
                                            ".#######.\n"
                                            "........."),
                                  inPixels());
    ASSERT_EQ(outline.loops.size(), 3U);
    EXPECT_GT(signedArea(outline.loops[0]), 0);
    EXPECT_LT(signedArea(outline.loops[1]), 0);
    EXPECT_GT(signedArea(outline.loops[2]), 0);
}

TEST(Outline, PixelsThatTouchAtACornerAreOneDroplet)
{
    TraceOptions options = inPixels();
    options.speck_size = 0.0;
    EXPECT_EQ(trace(drawnMask("#.\n.#"), options).loops.size(), 1U);
    // So dry pixels that touch at a corner are two holes.
    EXPECT_EQ(trace(drawnMask("####\n#.##\n##.#\n####"), options).loops.size(), 3U);
}

TEST(Outline, OnePixelStrokesSurvive)
{
    const Outline line =
        trace(drawnMask("......................\n.####################.\n......................"), inPixels());
    ASSERT_EQ(line.loops.size(), 1U);
    EXPECT_GT(signedArea(line.loops[0]), 0.6 * 20);
    std::string diagonal;
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            diagonal += x == y ? '#' : '.';
        }
        diagonal += '\n';
    }
    EXPECT_EQ(trace(drawnMask(diagonal), inPixels()).loops.size(), 1U);
}

TEST(Outline, AllLiquidMaskIsTheImageRectangle)
{
    Mask mask;
    mask.width = 12;
    mask.height = 7;
    mask.coverage.assign(84, 65535);
    const Outline outline = trace(mask, inPixels());
    ASSERT_EQ(outline.loops.size(), 1U);
    EXPECT_NEAR(signedArea(outline.loops[0]), 84.0, 1e-6);
}

TEST(Outline, LiquidAtTheBorderIsCutOffThere)
{
    const Mask mask = smoothMask(100, 100, disc({0, 50}, 40));
    const Outline outline = trace(mask, inPixels());
    for (const Vec2 p : outline.loops[0].points) {
        EXPECT_GE(p.x, -50.0 - 1e-3);
    }
}

TEST(Outline, SizeComesFromWidthOrPixelSize)
{
    const Mask mask = hardMask(40, 20, rectangle({20, 10}, {10, 5}, 0.0));
    TraceOptions options;
    options.width = 0.08;
    const Outline by_width = trace(mask, options);
    EXPECT_DOUBLE_EQ(by_width.pixel_size, 0.002);
    EXPECT_DOUBLE_EQ(by_width.extent.x, 0.08);
    EXPECT_DOUBLE_EQ(by_width.extent.y, 0.04);
    EXPECT_NEAR(signedArea(by_width.loops[0]), 20 * 10 * 4e-6, 1e-12);
    options.pixel_size = 0.001;
    EXPECT_NEAR(signedArea(trace(mask, options).loops[0]), 20 * 10 * 1e-6, 1e-12);
}

TEST(Outline, ThresholdMovesABlurredEdge)
{
    // Ramp over 10 px: the level is x/10 between 20 and 30.
    Mask mask;
    mask.width = 60;
    mask.height = 20;
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 60; ++x) {
            const double level = std::clamp((x + 0.5 - 20) / 10, 0.0, 1.0);
            mask.coverage.push_back(static_cast<std::uint16_t>(std::lround(65535 * level)));
        }
    }
    for (const double threshold : {0.25, 0.5, 0.8}) {
        TraceOptions options = inPixels();
        options.threshold = threshold;
        const Outline outline = trace(mask, options);
        for (const Vec2 p : outline.loops[0].points) {
            if (std::abs(p.y) < 5 && p.x < 25) {
                EXPECT_NEAR(p.x + 30, 20 + 10 * threshold, 0.06) << threshold;
            }
        }
    }
}

TEST(Outline, SpecksAreDroppedAndCounted)
{
    const Mask mask = drawnMask(
        "............\n"
        ".#...#####..\n"
        ".....#####..\n"
        ".....##.##..\n"
        ".##..#####..\n"
        ".....#####..\n"
        "............");
    const Outline outline = trace(mask, inPixels());
    EXPECT_EQ(outline.loops.size(), 1U);
    EXPECT_EQ(outline.specks_dropped, 3U);
    EXPECT_GT(outline.largest_speck_px, 1.0);
    EXPECT_LT(outline.largest_speck_px, 3.0);
    TraceOptions all = inPixels();
    all.speck_size = 0.0;
    EXPECT_EQ(trace(mask, all).loops.size(), 4U);
}

TEST(Outline, NothingOrOnlySpecksIsInvalidInput)
{
    for (const Mask& mask : {drawnMask("...\n...\n..."), drawnMask("...\n.#.\n...")}) {
        try {
            (void)trace(mask, inPixels());
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        }
    }
}

void expectRefused(const Mask& mask, const char* why)
{
    try {
        trace(mask);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), ::testing::HasSubstr(why));
    }
}

TEST(Outline, RejectsBordersThatAreTooLong)
{
    // Stored well, this picture has 3 KB, but each pixel would take 300 bytes of memory.
    expectRefused(testing::hardMask(1800, 1800, [](Vec2 p) { return static_cast<int>(p.x) % 2 == 0; }),
                  "borders are 3241800 pixels long, more than the limit of 3145728");
    expectRefused(testing::hardMask(1, 1050000, [](Vec2) { return true; }),
                  "border is 2100002 pixels long, more than the limit of 2097152");
}

TEST(Outline, RejectsOptionsOutOfRange)
{
    const Mask mask = drawnMask("....\n.##.\n.##.\n....");
    const auto code = [&](const TraceOptions& options) {
        try {
            (void)trace(mask, options);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::OutputFailed;
    };
    TraceOptions options;
    options.threshold = 1.0;
    EXPECT_EQ(code(options), ErrorCode::InvalidArgument);
    options = {};
    options.width = -1.0;
    EXPECT_EQ(code(options), ErrorCode::InvalidArgument);
    options = {};
    options.pixel_size = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(code(options), ErrorCode::InvalidArgument);
    options = {};
    options.speck_size = -0.5;
    EXPECT_EQ(code(options), ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace droplet
