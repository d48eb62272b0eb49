// SPDX-License-Identifier: GPL-3.0-or-later
// Masks that are deliberately awkward.
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "torture/corpus.h"
#include "torture/drawing.h"

namespace droplet::torture {
namespace {

constexpr double kPi = std::numbers::pi;

std::string number(double value)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

int floored(double value)
{
    return static_cast<int>(std::floor(value));
}

/// The remainder in [0, period).
double wrapped(double value, double period)
{
    return value - period * std::floor(value / period);
}

Vec2 turned(Vec2 p, double angle)
{
    return {std::cos(angle) * p.x + std::sin(angle) * p.y, -std::sin(angle) * p.x + std::cos(angle) * p.y};
}

void addLines(std::vector<Drawing>& drawings)
{
    constexpr int kSide = 60;
    for (int degrees = 0; degrees < 180; degrees += 5) {
        const double angle = degrees * kPi / 180.0;
        for (const double width : {1.0, 1.7, 3.0}) {
            addShape(drawings, "line_" + std::to_string(degrees) + "deg_" + number(width) + "px", kSide, kSide,
                     [=](Vec2 p) {
                         const Vec2 q = turned(p - Vec2{30.2, 29.9}, angle);
                         return std::abs(q.x) < 25.0 && std::abs(q.y) < 0.5 * width;
                     });
        }
        addShape(drawings, "grating_" + std::to_string(degrees) + "deg", kSide, kSide,
                 [=](Vec2 p) { return wrapped(turned(p, angle).x, 4.0) < 2.0; });
        addShape(drawings, "wedge_" + std::to_string(degrees) + "deg", kSide, kSide, [=](Vec2 p) {
            const Vec2 q = turned(p - Vec2{30.0, 30.0}, angle);
            return q.x > -20.0 && q.x < 20.0 && std::abs(q.y) < 0.1 * (q.x + 20.0);
        });
        addShape(drawings, "half_plane_" + std::to_string(degrees) + "deg", kSide, kSide, [=](Vec2 p) {
            return turned(p - Vec2{30.0, 30.0}, angle).x > 0.3;
        });
    }
}

void addSpirals(std::vector<Drawing>& drawings)
{
    for (const double pitch : {2.0, 3.0, 4.5, 8.0, 16.0}) {
        for (const double share : {0.3, 0.5, 0.8}) {
            const std::string name = number(pitch) + "px_" + number(share);
            addShape(drawings, "spiral_" + name, 100, 100, [=](Vec2 p) {
                const Vec2 d = p - Vec2{50.0, 50.0};
                const double arm = length(d) / pitch - std::atan2(d.y, d.x) / (2.0 * kPi);
                return length(d) < 48.0 && wrapped(arm, 1.0) < share;
            });
            addShape(drawings, "logarithmic_spiral_" + name, 100, 100, [=](Vec2 p) {
                const Vec2 d = p - Vec2{50.0, 50.0};
                const double arm = pitch * std::log(length(d) + 1e-9) - std::atan2(d.y, d.x) / (2.0 * kPi);
                return length(d) < 48.0 && wrapped(arm, 1.0) < share;
            });
            addShape(drawings, "rings_" + name, 100, 100, [=](Vec2 p) {
                return wrapped(length(p - Vec2{50.0, 50.0}), pitch) < share * pitch;
            });
            addShape(drawings, "square_rings_" + name, 60, 60, [=](Vec2 p) {
                const double r = std::max(std::abs(p.x - 30.0), std::abs(p.y - 30.0));
                return wrapped(r, pitch) < share * pitch;
            });
        }
    }
}

void addCombs(std::vector<Drawing>& drawings)
{
    for (int tooth = 1; tooth <= 4; ++tooth) {
        for (int gap = 1; gap <= 4; ++gap) {
            const std::string name = std::to_string(tooth) + "_" + std::to_string(gap);
            const auto teeth = [=](double x) { return floored(x) % (tooth + gap) < tooth; };
            addShape(drawings, "comb_" + name, 64, 30, [=](Vec2 p) { return p.y < 3.0 || (p.y < 27.0 && teeth(p.x)); });
            addShape(drawings, "comb_leaning_" + name, 64, 30,
                     [=](Vec2 p) { return p.y < 3.0 || (p.y < 27.0 && teeth(p.x + p.y)); });
            addShape(drawings, "two_combs_" + name, 64, 40, [=](Vec2 p) {
                return p.y < 3.0 || p.y > 37.0 || (teeth(p.x) && (p.y < 35.0) != (p.y < 5.0)) ||
                       (p.x > 62.0 && p.y > 20.0);
            });
            addShape(drawings, "grid_" + name, 50, 50, [=](Vec2 p) { return teeth(p.x) || teeth(p.y); });
            addShape(drawings, "dots_" + name, 50, 50, [=](Vec2 p) { return teeth(p.x) && teeth(p.y); });
            addShape(drawings, "checkers_" + name, 48, 48, [=](Vec2 p) { return teeth(p.x) == teeth(p.y); });
            addShape(drawings, "saw_" + name, 60, 40,
                     [=](Vec2 p) { return wrapped(p.x, tooth + gap) < (tooth + gap) * (p.y - 4.0) / (8.0 * gap); });
        }
    }
}

/// Whether a pixel is in the stroke of a Hilbert curve. Cells have 2 px; the curve uses every other one.
bool inHilbert(int x, int y, int order)
{
    // Cells at even places are the curve's points; a cell between two of them is liquid if they are consecutive.
    const auto place = [order](int cx, int cy) {
        long d = 0;
        for (int s = (1 << order) / 2; s > 0; s /= 2) {
            const int rx = (cx & s) > 0 ? 1 : 0;
            const int ry = (cy & s) > 0 ? 1 : 0;
            d += static_cast<long>(s) * s * ((3 * rx) ^ ry);
            if (ry == 0) {
                if (rx == 1) {
                    cx = s - 1 - (cx & (s - 1));
                    cy = s - 1 - (cy & (s - 1));
                }
                std::swap(cx, cy);
            }
        }
        return d;
    };
    if (x % 2 == 1 && y % 2 == 1) {
        return false;
    }
    if (x % 2 == 0 && y % 2 == 0) {
        return true;
    }
    const int x2 = x % 2 == 1 ? x + 1 : x;
    const int y2 = y % 2 == 1 ? y + 1 : y;
    const int cells = 1 << order;
    if (x2 / 2 >= cells || y2 / 2 >= cells) {
        return false;
    }
    return std::abs(place(x / 2, y / 2) - place(x2 / 2, y2 / 2)) == 1;
}

void addFractals(std::vector<Drawing>& drawings)
{
    for (const int scale : {1, 2, 3}) {
        const std::string name = std::to_string(scale);
        addShape(drawings, "carpet_" + name, 81 * scale, 81 * scale, [=](Vec2 p) {
            int x = floored(p.x) / scale;
            int y = floored(p.y) / scale;
            for (; x > 0 || y > 0; x /= 3, y /= 3) {
                if (x % 3 == 1 && y % 3 == 1) {
                    return false;
                }
            }
            return true;
        });
        addShape(drawings, "gasket_" + name, 64 * scale, 64 * scale,
                 [=](Vec2 p) { return ((floored(p.x) / scale) & (floored(p.y) / scale)) == 0; });
        addShape(drawings, "dust_" + name, 81 * scale, 81 * scale, [=](Vec2 p) {
            for (int x = floored(p.x) / scale, y = floored(p.y) / scale; x > 0 || y > 0; x /= 3, y /= 3) {
                if (x % 3 == 1 || y % 3 == 1) {
                    return false;
                }
            }
            return true;
        });
        addShape(drawings, "hilbert_" + name, 63 * scale, 63 * scale,
                 [=](Vec2 p) { return inHilbert(floored(p.x) / scale, floored(p.y) / scale, 5); });
        addShape(drawings, "between_hilbert_" + name, 63 * scale, 63 * scale,
                 [=](Vec2 p) { return !inHilbert(floored(p.x) / scale, floored(p.y) / scale, 5); });
        addShape(drawings, "mandelbrot_" + name, 60 * scale, 50 * scale, [=](Vec2 p) {
            const Vec2 c{p.x / (20.0 * scale) - 2.2, p.y / (20.0 * scale) - 1.25};
            Vec2 z{};
            for (int k = 0; k < 40; ++k) {
                z = Vec2{z.x * z.x - z.y * z.y, 2.0 * z.x * z.y} + c;
                if (dot(z, z) > 4.0) {
                    return false;
                }
            }
            return true;
        });
    }
}

/// Levels that are near the threshold of one half almost everywhere.
void addPlateaus(std::vector<Drawing>& drawings)
{
    constexpr int kSide = 40;
    const auto add = [&](const std::string& name, const std::function<double(int, int)>& level) {
        drawings.push_back({name, [=] { return levelMask(kSide, kSide, level); }});
    };
    constexpr double kStep = 1.0 / 65535.0;
    for (const int levels : {1, 2, 5, 100, 3000}) {
        const std::string name = std::to_string(levels);
        add("plateau_checkers_" + name,
            [=](int x, int y) { return 0.5 + ((x + y) % 2 == 0 ? levels : -levels) * kStep; });
        add("plateau_hash_" + name, [=](int x, int y) {
            return 0.5 + ((x * x * 7 + y * y * 13 + x * y * 5) % (2 * levels + 1) - levels) * kStep;
        });
        add("plateau_disc_" + name, [=](int x, int y) {
            return 0.5 + (length(Vec2{x - 19.3, y - 20.1}) < 13.0 ? levels : -levels) * kStep;
        });
        add("plateau_waves_" + name,
            [=](int x, int y) { return 0.5 + levels * kStep * std::sin(0.9 * x) * std::sin(1.1 * y + 0.3 * x); });
        add("plateau_with_pit_" + name, [=](int x, int y) {
            return x == 20 && y == 20
                       ? 0.0
                       : 0.5 + (std::abs(x - 20) < 12 && std::abs(y - 20) < 9 ? levels : -levels) * kStep;
        });
    }
    for (const double slope : {1e-4, 1e-3, 1e-2, 0.1, 1.0}) {
        const std::string name = number(slope);
        add("gradient_across_" + name, [=](int x, int) { return 0.5 + slope * (x - 19.7); });
        add("gradient_slanted_" + name, [=](int x, int y) { return 0.5 + slope * (x - 0.3 * y - 11.1); });
        add("gradient_round_" + name, [=](int x, int y) {
            return 0.5 + slope * (12.3 - length(Vec2{x - 19.5, y - 19.5}));
        });
        add("gradient_saddle_" + name, [=](int x, int y) { return 0.5 + slope * 0.1 * (x - 19.5) * (y - 19.5); });
        add("gradient_saddle_on_pixel_" + name, [=](int x, int y) { return 0.5 + slope * (x - 20) * (y - 20); });
    }
    add("cone_of_angle", [](int x, int y) { return (std::atan2(y - 19.5, x - 19.5) + kPi) / (2.0 * kPi); });
    add("moire", [](int x, int y) { return 0.5 + 0.5 * std::sin(0.11 * (x * x + y * y)); });
    add("zone_plate",
        [](int x, int y) { return 0.5 + 0.5 * std::cos(0.05 * ((x - 20.2) * (x - 20.2) + (y - 19.9) * (y - 19.9))); });
}

/// Dithered grey, as on printers and screens.
void addDithers(std::vector<Drawing>& drawings)
{
    constexpr std::array<int, 16> kBayer{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    for (const double grey : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        drawings.push_back({"bayer_" + number(grey), [=] {
                                return levelMask(48, 48, [&](int x, int y) {
                                    const int rank = kBayer[static_cast<std::size_t>(x % 4 + 4 * (y % 4))];
                                    return grey * 16.0 > rank + 0.5 ? 1.0 : 0.0;
                                });
                            }});
        addShape(drawings, "halftone_" + number(grey), 64, 64, [=](Vec2 p) {
            const Vec2 q = turned(p, 0.3);
            const Vec2 in_cell{wrapped(q.x, 6.0) - 3.0, wrapped(q.y, 6.0) - 3.0};
            return length(in_cell) < 6.0 * std::sqrt(grey / kPi);
        });
    }
    drawings.push_back({"diffused", [] {
                            // R. W. Floyd and L. Steinberg, "An adaptive algorithm for spatial grayscale" (1976).
                            constexpr int kSide = 64;
                            std::vector<double> error(std::size_t{kSide} * (kSide + 2), 0.0);
                            return levelMask(kSide, kSide, [&](int x, int y) {
                                const auto at = [&](int u, int v) -> double& {
                                    return error[static_cast<std::size_t>(v) * kSide + static_cast<std::size_t>(u)];
                                };
                                const double grey = static_cast<double>(x) / kSide + at(x, y);
                                const double level = grey >= 0.5 ? 1.0 : 0.0;
                                const double rest = grey - level;
                                at(x + 1, y) += 7.0 / 16.0 * rest;
                                at(x, y + 1) += 5.0 / 16.0 * rest;
                                at(x + 1, y + 1) += 1.0 / 16.0 * rest;
                                if (x > 0) {
                                    at(x - 1, y + 1) += 3.0 / 16.0 * rest;
                                }
                                return level;
                            });
                        }});
}

void addNearMisses(std::vector<Drawing>& drawings)
{
    for (const double gap : {-0.5, -0.1, 0.0, 0.1, 0.5, 1.0, 1.5}) {
        const std::string name = number(gap) + "px";
        addShape(drawings, "discs_apart_" + name, 60, 40, [=](Vec2 p) {
            const double shift = 12.0 + 0.5 * gap;
            return length(p - Vec2{30.0 - shift, 20.0}) < 12.0 || length(p - Vec2{30.0 + shift, 20.3}) < 12.0;
        });
        addShape(drawings, "hole_at_rim_" + name, 50, 50, [=](Vec2 p) {
            return length(p - Vec2{25.0, 25.0}) < 20.0 && length(p - Vec2{32.0 - gap, 25.0}) > 13.0;
        });
        addShape(drawings, "tips_that_meet_" + name, 60, 40, [=](Vec2 p) {
            return std::abs(p.y - 20.0) < 0.5 * (std::abs(p.x - 30.0) - gap) && std::abs(p.x - 30.0) < 24.0;
        });
        addShape(drawings, "slit_" + name, 40, 40, [=](Vec2 p) {
            return length(p - Vec2{20.0, 20.0}) < 17.0 && !(std::abs(p.x - 20.2) < 0.5 * gap + 0.3 && p.y > 10.0);
        });
        addShape(drawings, "star_" + name, 80, 80, [=](Vec2 p) {
            const Vec2 d = p - Vec2{40.0, 40.0};
            return length(d) < 8.0 + 28.0 * std::pow(std::abs(std::cos(3.5 * std::atan2(d.y, d.x))), 6.0 + 4.0 * gap);
        });
        addShape(drawings, "moon_" + name, 60, 60, [=](Vec2 p) {
            return length(p - Vec2{30.0, 30.0}) < 26.0 && length(p - Vec2{31.0 + gap, 30.0}) > 25.0;
        });
    }
    for (int blades = 3; blades <= 40; blades += 4) {
        addShape(drawings, "fan_" + std::to_string(blades), 80, 80, [=](Vec2 p) {
            const Vec2 d = p - Vec2{40.0, 40.0};
            return length(d) < 38.0 && std::cos(blades * std::atan2(d.y, d.x)) > 0.0;
        });
        addShape(drawings, "gear_" + std::to_string(blades), 80, 80, [=](Vec2 p) {
            const Vec2 d = p - Vec2{40.0, 40.0};
            const double r = std::cos(blades * std::atan2(d.y, d.x)) > 0.0 ? 37.0 : 31.0;
            return length(d) < r && length(d) > 9.0;
        });
    }
    for (const double radius : {0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0}) {
        addShape(drawings, "discs_of_" + number(radius) + "px", 70, 70, [=](Vec2 p) {
            // The pitch is not an integer, so every phase of the pixel grid occurs.
            const double pitch = 2.0 * radius + 2.37;
            return length(Vec2{wrapped(p.x, pitch), wrapped(p.y, pitch)} - Vec2{0.5 * pitch, 0.5 * pitch}) < radius;
        });
    }
}

/// Shapes of a few pixels, beside or as holes in a shape so large that its triangles are larger than they are.
void addSmallCompany(std::vector<Drawing>& drawings)
{
    constexpr int kSide = 600;
    constexpr double kPitch = 24.0;
    const std::vector<std::pair<std::string, std::function<bool(Vec2 p, double size)>>> shapes{
        {"discs", [](Vec2 p, double size) { return length(p) < size; }},
        {"squares", [](Vec2 p, double size) { return std::max(std::abs(p.x), std::abs(p.y)) < size; }},
        {"triangles", [](Vec2 p, double size) { return p.y < size && std::abs(p.x) < 0.58 * (p.y + size); }},
        {"needles", [](Vec2 p, double size) { return std::abs(p.x) < size && std::abs(p.y) < 0.1 * (p.x + size); }},
        {"crosses",
         [](Vec2 p, double size) {
             return std::max(std::abs(p.x), std::abs(p.y)) < size &&
                    std::min(std::abs(p.x), std::abs(p.y)) < 0.2 * size;
         }},
        {"leaves",
         [](Vec2 p, double size) {
             return std::max(length(p - Vec2{0.0, size}), length(p + Vec2{0.0, size})) < 1.6 * size;
         }},
        {"rings", [](Vec2 p, double size) { return length(p) < size && length(p) > 0.5 * size; }},
    };
    for (const auto& [name, contains] : shapes) {
        const auto small = [contains = contains](Vec2 p) {
            const Vec2 cell{std::floor(p.x / kPitch), std::floor(p.y / kPitch)};
            const Vec2 q{p.x - (cell.x + 0.5) * kPitch, p.y - (cell.y + 0.5) * kPitch};
            // Shapes grow from left to right and turn from top to bottom.
            return contains(turned(q, 0.37 * cell.y), 1.0 + 0.4 * cell.x);
        };
        addShape(drawings, "small_" + name, kSide, kSide, [=](Vec2 p) {
            const bool large = p.y > 130.0;
            return large ? length(p - Vec2{300.0, 365.0}) < 220.0 : small(p);
        });
        addShape(drawings, "small_" + name + "_as_holes", kSide, kSide,
                 [=](Vec2 p) { return !(p.y > 240.0 && p.y < 360.0 && small(p)); });
    }
}

void addSizes(std::vector<Drawing>& drawings)
{
    for (const auto& [width, height] : {std::pair{1, 1},
                                        {1, 2},
                                        {2, 1},
                                        {2, 2},
                                        {3, 1},
                                        {1, 4},
                                        {3, 3},
                                        {1, 100},
                                        {100, 1},
                                        {2, 1000},
                                        {1, 20000},
                                        {20000, 1},
                                        {20000, 2},
                                        {3, 7000}}) {
        const std::string size = "_" + std::to_string(width) + "x" + std::to_string(height);
        const int w = width;
        const int h = height;
        const auto add = [&](const std::string& kind, const std::function<double(int, int)>& level) {
            drawings.push_back({kind + size, [=] { return levelMask(w, h, level); }});
        };
        add("dry", [](int, int) { return 0.0; });
        add("liquid", [](int, int) { return 1.0; });
        add("barely_liquid", [](int, int) { return 0.5001; });
        add("barely_dry", [](int, int) { return 0.4999; });
        add("runs", [](int x, int y) { return (x + y) % 23 < 15 ? 1.0 : 0.0; });
        add("waves", [](int x, int y) { return 0.5 + 0.5 * std::sin(0.7 * (x + y)); });
        add("dash", [](int x, int y) { return (x + y) % 2 == 0 ? 1.0 : 0.0; });
    }
    constexpr int kLarge = 1500;
    addShape(drawings, "lost_in_the_desert", kLarge, kLarge, [](Vec2 p) {
        return length(p - Vec2{1234.0, 77.0}) < 2.0 || length(p - Vec2{300.0, 900.0}) < 1.7;
    });
    addShape(drawings, "holes_in_the_sea", kLarge, kLarge, [](Vec2 p) {
        return length(p - Vec2{1234.0, 77.0}) > 2.0 && length(p - Vec2{300.0, 900.0}) > 1.7;
    });
    addShape(drawings, "frame", kLarge, kLarge, [](Vec2 p) {
        return std::min({p.x, p.y, kLarge - p.x, kLarge - p.y}) < 1.0;
    });
    addShape(drawings, "hair", kLarge, kLarge, [](Vec2 p) { return std::abs(p.y - 3.0 - 0.99 * p.x) < 0.8; });
}

}  // namespace

Corpus adversaries()
{
    std::vector<Drawing> drawings;
    addLines(drawings);
    addSpirals(drawings);
    addCombs(drawings);
    addFractals(drawings);
    addPlateaus(drawings);
    addDithers(drawings);
    addNearMisses(drawings);
    addSmallCompany(drawings);
    addSizes(drawings);
    return corpusOf("adversaries", std::move(drawings));
}

Corpus patterns()
{
    constexpr int kCells = 3;
    std::vector<Drawing> drawings;
    for (int pattern = 0; pattern < 1 << (kCells * kCells); ++pattern) {
        // Cells have one to a few pixels, with and without margins.
        const int cell = 1 + pattern % 5;
        const int margin = pattern % 3;
        const int side = kCells * cell + 2 * margin;
        const testing::Inside inside = [=](Vec2 p) {
            const int x = floored((p.x - margin) / cell);
            const int y = floored((p.y - margin) / cell);
            return x >= 0 && y >= 0 && x < kCells && y < kCells && (pattern >> (kCells * y + x) & 1) != 0;
        };
        drawings.push_back(
            {"pattern_" + std::to_string(pattern), [=] { return testing::hardMask(side, side, inside); }});
    }
    return corpusOf("patterns", std::move(drawings));
}

}  // namespace droplet::torture
