// SPDX-License-Identifier: GPL-3.0-or-later
// Random masks. Coastlines: midpoint displacement after A. Fournier, D. Fussell and L. Carpenter, "Computer
// rendering of stochastic models" (1982).
#include <array>
#include <cmath>

#include "torture/corpus.h"
#include "torture/drawing.h"
#include "torture/random.h"

namespace droplet::torture {
namespace {

/// Levels that are liquid with a given probability, independently.
Mask white(int width, int height, double density, bool hard, std::uint64_t seed)
{
    Random random(seed);
    return levelMask(width, height, [&](int, int) {
        const double level = 0.5 + density - random.real();
        return hard ? (level >= 0.5 ? 1.0 : 0.0) : level;
    });
}

/// Square of heights around 0 with a given roughness (Hurst exponent).
std::vector<double> mountains(int cells, double hurst, Random& random)
{
    const int side = cells + 1;
    std::vector<double> height(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
    const auto at = [&](int x, int y) -> double& {
        return height[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
    };
    double amplitude = 1.0;
    const auto displaced = [&](double sum, int count) { return sum / count + amplitude * (2.0 * random.real() - 1.0); };
    for (int step = cells; step > 1; step /= 2) {
        const int half = step / 2;
        for (int y = half; y < side; y += step) {
            for (int x = half; x < side; x += step) {
                at(x, y) = displaced(
                    at(x - half, y - half) + at(x + half, y - half) + at(x - half, y + half) + at(x + half, y + half),
                    4);
            }
        }
        for (int y = 0; y < side; y += half) {
            for (int x = (y / half) % 2 == 0 ? half : 0; x < side; x += step) {
                double sum = 0.0;
                int count = 0;
                for (const auto& [dx, dy] : {std::pair{-half, 0}, {half, 0}, {0, -half}, {0, half}}) {
                    if (x + dx >= 0 && x + dx < side && y + dy >= 0 && y + dy < side) {
                        sum += at(x + dx, y + dy);
                        ++count;
                    }
                }
                at(x, y) = displaced(sum, count);
            }
        }
        amplitude *= std::pow(0.5, hurst);
    }
    return height;
}

/// Land above the sea. A very large steepness (levels per unit of height) gives hard edges.
Mask coastline(int cells, double hurst, double steepness, std::uint64_t seed)
{
    Random random(seed);
    const std::vector<double> height = mountains(cells, hurst, random);
    return levelMask(cells + 1, cells + 1, [&](int x, int y) {
        return 0.5 + steepness * height[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells + 1) +
                                        static_cast<std::size_t>(x)];
    });
}

/// Caves: noise in which every pixel takes the majority of its neighbours, a few times.
Mask caves(int side, double density, int rounds, std::uint64_t seed)
{
    Mask mask = white(side, side, density, true, seed);
    for (int round = 0; round < rounds; ++round) {
        const Mask before = mask;
        mask = levelMask(side, side, [&](int x, int y) {
            int liquid = 0;
            for (int k = 0; k < 9; ++k) {
                const int u = x + k % 3 - 1;
                const int v = y + k / 3 - 1;
                liquid += u >= 0 && v >= 0 && u < side && v < side && before.at(u, v) > 0 ? 1 : 0;
            }
            return liquid > 4 ? 1.0 : 0.0;
        });
    }
    return mask;
}

/// Maze of corridors and walls of one pixel, by depth-first search.
Mask maze(int cells, bool walls_are_liquid, std::uint64_t seed)
{
    Random random(seed);
    const int side = 2 * cells + 1;
    Mask mask = levelMask(side, side, [&](int, int) { return walls_are_liquid ? 1.0 : 0.0; });
    const auto dig = [&](int x, int y) {
        mask.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)] =
            walls_are_liquid ? 0 : 65535;
    };
    std::vector<bool> seen(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), false);
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells) + static_cast<std::size_t>(x);
    };
    std::vector<std::pair<int, int>> way{{0, 0}};
    seen[0] = true;
    dig(1, 1);
    while (!way.empty()) {
        const auto [x, y] = way.back();
        std::vector<std::pair<int, int>> open;
        for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            const int u = x + dx;
            const int v = y + dy;
            if (u >= 0 && v >= 0 && u < cells && v < cells && !seen[index(u, v)]) {
                open.emplace_back(u, v);
            }
        }
        if (open.empty()) {
            way.pop_back();
            continue;
        }
        const auto [u, v] = open[static_cast<std::size_t>(random.below(static_cast<int>(open.size())))];
        seen[index(u, v)] = true;
        dig(x + u + 1, y + v + 1);
        dig(2 * u + 1, 2 * v + 1);
        way.emplace_back(u, v);
    }
    return mask;
}

/// Discs of all sizes and soft edges at random places, across the border and one another.
Mask splashes(int side, int count, double largest, double softness, std::uint64_t seed)
{
    Random random(seed);
    std::vector<std::pair<Vec2, double>> discs;
    for (int k = 0; k < count; ++k) {
        const double x = side * random.real();
        const double y = side * random.real();
        discs.push_back({{x, y}, largest * std::pow(random.real(), 3.0)});
    }
    return levelMask(side, side, [&](int x, int y) {
        double level = 0.0;
        for (const auto& [centre, radius] : discs) {
            level = std::max(level, 0.5 + (radius - length(Vec2{x + 0.5, y + 0.5} - centre)) / softness);
        }
        return level;
    });
}

/// Lines of random width between random points.
Mask scribble(int side, int count, double width, bool hard, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Vec2> points;
    for (int k = 0; k <= count; ++k) {
        const double x = side * random.real();
        points.push_back({x, side * random.real()});
    }
    const testing::Inside inside = [points, width](Vec2 p) {
        for (std::size_t k = 1; k < points.size(); ++k) {
            const Vec2 along = points[k] - points[k - 1];
            const double t = std::clamp(dot(p - points[k - 1], along) / dot(along, along), 0.0, 1.0);
            if (length(p - points[k - 1] - t * along) < 0.5 * width) {
                return true;
            }
        }
        return false;
    };
    return hard ? testing::hardMask(side, side, inside) : coarseMask(side, side, inside);
}

}  // namespace

Corpus whiteNoise()
{
    std::vector<Drawing> drawings;
    for (const int side : {9, 24, 60}) {
        for (int percent = 1; percent < 100; ++percent) {
            for (const bool hard : {true, false}) {
                const std::uint64_t seed = drawings.size();
                drawings.push_back({"noise_" + std::to_string(side) + "px_" + std::to_string(percent) + "percent_" +
                                        (hard ? "hard" : "grey"),
                                    [=] { return white(side, side, percent / 100.0, hard, seed); }});
            }
        }
    }
    for (int percent = 2; percent < 100; percent += 8) {
        for (const bool hard : {true, false}) {
            const std::uint64_t seed = drawings.size();
            const std::string name = std::to_string(percent) + "percent_" + (hard ? "hard" : "grey");
            drawings.push_back({"noise_160px_" + name, [=] { return white(160, 160, percent / 100.0, hard, seed); }});
            drawings.push_back({"noise_3x2000px_" + name, [=] { return white(3, 2000, percent / 100.0, hard, seed); }});
        }
    }
    return corpusOf("white noise", std::move(drawings));
}

Corpus randomWorlds()
{
    std::vector<Drawing> drawings;
    const auto add = [&](const std::string& kind, const std::function<Mask(std::uint64_t seed)>& draw) {
        const std::uint64_t seed = drawings.size();
        drawings.push_back({kind + "_seed" + std::to_string(seed), [=] { return draw(seed); }});
    };
    constexpr double kHard = 1e9;
    for (const int cells : {32, 64, 128, 256}) {
        for (const double hurst : {0.2, 0.5, 0.8, 1.1}) {
            for (const double steepness : {1.0, 4.0, kHard}) {
                for (int again = 0; again < (cells < 200 ? 4 : 1); ++again) {
                    add("coastline", [=](std::uint64_t seed) { return coastline(cells, hurst, steepness, seed); });
                }
            }
        }
    }
    for (const int cells : {3, 5, 10, 20, 40}) {
        for (const bool walls : {true, false}) {
            for (int again = 0; again < (cells < 40 ? 5 : 1); ++again) {
                add("maze", [=](std::uint64_t seed) { return maze(cells, walls, seed); });
            }
        }
    }
    for (const double density : {0.4, 0.45, 0.5, 0.55, 0.6}) {
        for (const int rounds : {1, 2, 5}) {
            add("caves", [=](std::uint64_t seed) { return caves(100, density, rounds, seed); });
        }
    }
    for (const int count : {1, 3, 10, 40, 150}) {
        for (const double softness : {0.01, 1.0, 3.0, 10.0, 60.0}) {
            for (int again = 0; again < 3; ++again) {
                add("splashes", [=](std::uint64_t seed) { return splashes(120, count, 25.0, softness, seed); });
            }
        }
    }
    for (const double width : {1.0, 1.5, 2.5, 5.0}) {
        for (const bool hard : {true, false}) {
            for (const int count : {1, 2, 5, 20}) {
                for (int again = 0; again < 3; ++again) {
                    add("scribble", [=](std::uint64_t seed) { return scribble(100, count, width, hard, seed); });
                }
            }
        }
    }
    return corpusOf("random worlds", std::move(drawings));
}

}  // namespace droplet::torture
