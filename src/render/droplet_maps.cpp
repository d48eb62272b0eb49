// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of droplets from straight above. A pixel has 4 × 4 places, at which triangles are found by rows: a row crosses
// two sides of a triangle, and neighbours share the crossing, so that every place is in exactly one of them. On the way
// up through a closed surface what points down is subtracted and what points up is added, which leaves the thickness of
// the liquid in whatever order triangles come. Occlusion is that of the picture of heights, by horizons: J. Jimenez,
// X. Wu, A. Pesce, A. Jarabo, "Practical Real-Time Strategies for Accurate Indirect Occlusion" (2016), eqs. 6 and 7,
// whose integral over a slice through the normal is exact.
#include "droplet/render/droplet_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "require.h"
#include "union_find.h"
#include "unit_vector.h"

namespace droplet {
namespace {

constexpr int kAcross = 4;  // places along a pixel's side: thickness of a disc 50 px wide is right to 0.1 %

/// A triangle in pixels, y down.
struct Placed {
    std::uint32_t triangle = 0;
    Vec2 shift;  ///< of the window that it is in [m]
};

/// What is at a place.
struct Sight {
    double top = 0.0;
    Vec3 normal;
    double thickness = 0.0;
    bool is_covered = false;
    bool is_wet = false;
};

class Window {
public:
    explicit Window(const DropletMapOptions& options)
        : extent_(options.extent),
          width_(options.width),
          height_(std::max(1, static_cast<int>(std::lround(options.width * options.extent.y / options.extent.x))))
    {
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Sides of a pixel [m].
    [[nodiscard]] Vec2 pixel() const { return {extent_.x / width_, extent_.y / height_}; }
    [[nodiscard]] Vec2 toPixels(Vec2 p) const
    {
        return {(p.x / extent_.x + 0.5) * width_, (0.5 - p.y / extent_.y) * height_};
    }
    [[nodiscard]] Vec2 toMetres(Vec2 q) const
    {
        return {(q.x / width_ - 0.5) * extent_.x, (0.5 - q.y / height_) * extent_.y};
    }

private:
    Vec2 extent_;
    int width_;
    int height_;
};

Vec2 flat(Vec3 p)
{
    return {p.x, p.y};
}

/// Where a horizontal line crosses a side that reaches from above it to it or below: the same for both its triangles.
double crossing(Vec2 a, Vec2 b, double y)
{
    if (std::pair(b.y, b.x) < std::pair(a.y, a.x)) {
        std::swap(a, b);
    }
    return a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y);
}

class Painter {
public:
    Painter(const Surface& surface, const DropletMapOptions& options)
        : surface_(surface), options_(options), window_(options), is_base_(baseTriangles())
    {
        place();
    }

    DropletMaps draw() const
    {
        const auto made = [this](int channels) {
            const auto count = static_cast<std::size_t>(window_.width()) * static_cast<std::size_t>(window_.height());
            return FloatPicture{window_.width(), window_.height(), channels,
                                std::vector<float>(static_cast<std::size_t>(channels) * count)};
        };
        DropletMaps maps{made(1), made(3), made(1), made(1), made(1), made(1)};
        tbb::parallel_for(0, window_.height(), [&](int row) { drawRow(row, maps); });
        return maps;
    }

private:
    /// A surface's two sides, liquid and base, share no vertices. Seen from above, that of the base is turned over.
    std::vector<bool> baseTriangles() const
    {
        UnionFind sides(surface_.vertices.size());
        for (const Triangle& t : surface_.triangles) {
            sides.join(t[0], t[1]);
            sides.join(t[0], t[2]);
        }
        std::vector<double> area(surface_.vertices.size(), 0.0);
        for (const Triangle& t : surface_.triangles) {
            area[sides.find(t[0])] += twiceArea(t);
        }
        std::vector<bool> is_base;
        is_base.reserve(surface_.triangles.size());
        for (const Triangle& t : surface_.triangles) {
            is_base.push_back(area[sides.find(t[0])] < 0.0);
        }
        return is_base;
    }

    double twiceArea(const Triangle& t) const
    {
        const Vec2 a = flat(surface_.vertices[t[0]]);
        return cross(flat(surface_.vertices[t[1]]) - a, flat(surface_.vertices[t[2]]) - a);
    }

    /// Lists the triangles that each row of pixels meets.
    void place()
    {
        rows_.resize(static_cast<std::size_t>(window_.height()));
        const int around = options_.is_tile ? 1 : 0;
        for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
            for (int down = -around; down <= around; ++down) {
                for (int right = -around; right <= around; ++right) {
                    const Placed placed{t, {right * options_.extent.x, down * options_.extent.y}};
                    const std::array<Vec2, 3> at = corners(placed);
                    const auto [left, end] = std::minmax({at[0].x, at[1].x, at[2].x});
                    const auto [above, below] = std::minmax({at[0].y, at[1].y, at[2].y});
                    if (end < 0.0 || left > window_.width() || below < 0.0 || above > window_.height()) {
                        continue;
                    }
                    const int last = std::min(window_.height() - 1, static_cast<int>(below));
                    for (int row = std::max(0, static_cast<int>(above)); row <= last; ++row) {
                        rows_[static_cast<std::size_t>(row)].push_back(placed);
                    }
                }
            }
        }
    }

    std::array<Vec2, 3> corners(const Placed& placed) const
    {
        std::array<Vec2, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = window_.toPixels(flat(surface_.vertices[surface_.triangles[placed.triangle][k]]) + placed.shift);
        }
        return at;
    }

    void drawRow(int row, DropletMaps& maps) const
    {
        const auto across = static_cast<std::size_t>(kAcross) * static_cast<std::size_t>(window_.width());
        std::vector<Sight> sights(kAcross * across);
        for (int k = 0; k < kAcross; ++k) {
            const double y = row + (k + 0.5) / kAcross;
            Sight* const line = sights.data() + static_cast<std::size_t>(k) * across;
            for (const Placed& placed : rows_[static_cast<std::size_t>(row)]) {
                drawLine(placed, y, line);
            }
        }
        for (int column = 0; column < window_.width(); ++column) {
            drawPixel(row, column, sights, maps);
        }
    }

    void drawLine(const Placed& placed, double y, Sight* line) const
    {
        const std::array<Vec2, 3> at = corners(placed);
        std::array<double, 2> ends{};
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3 && count < 2; ++k) {
            const Vec2 a = at[k];
            const Vec2 b = at[(k + 1) % 3];
            if ((a.y <= y) != (b.y <= y)) {
                ends[count++] = crossing(a, b, y);
            }
        }
        if (count < 2) {
            return;
        }
        const auto place_from = [this](double x) {
            return std::clamp(static_cast<int>(std::ceil(kAcross * x - 0.5)), 0, kAcross * window_.width());
        };
        const int begin = place_from(std::min(ends[0], ends[1]));
        const int end = place_from(std::max(ends[0], ends[1]));
        if (begin == end) {
            return;
        }
        const Triangle& t = surface_.triangles[placed.triangle];
        // Rows go down, so a triangle that is seen winds clockwise here.
        const double area = cross(at[1] - at[0], at[2] - at[0]);
        const auto [lowest, highest] =
            std::minmax({surface_.vertices[t[0]].z, surface_.vertices[t[1]].z, surface_.vertices[t[2]].z});
        for (int k = begin; k < end; ++k) {
            const Vec2 from_first = Vec2{(k + 0.5) / kAcross, y} - at[0];
            const double second = cross(from_first, at[2] - at[0]) / area;
            const double third = cross(at[1] - at[0], from_first) / area;
            const auto mixed = [&](const std::vector<Vec3>& of) {
                return (1.0 - second - third) * of[t[0]] + second * of[t[1]] + third * of[t[2]];
            };
            const double z = std::clamp(mixed(surface_.vertices).z, lowest, highest);
            Sight& sight = line[k];
            sight.thickness += area < 0.0 ? z : -z;
            sight.is_wet = sight.is_wet || is_base_[placed.triangle];
            if (area < 0.0 && (!sight.is_covered || z > sight.top)) {
                sight.is_covered = true;
                sight.top = z;
                sight.normal = mixed(surface_.normals);
            }
        }
    }

    /// What is seen beside the liquid.
    Sight groundAt(Vec2 p) const
    {
        const std::optional<GroundPoint> ground = options_.ground.find(p);
        return ground ? Sight{.top = ground->height, .normal = {-ground->gradient.x, -ground->gradient.y, 1.0}}
                      : Sight{.top = 0.0, .normal = {0.0, 0.0, 1.0}};
    }

    void drawPixel(int row, int column, const std::vector<Sight>& sights, DropletMaps& maps) const
    {
        const auto across = static_cast<std::size_t>(kAcross) * static_cast<std::size_t>(window_.width());
        double height = 0.0;
        double thickness = 0.0;
        int covered = 0;
        int wet = 0;
        Vec3 normal;
        for (int k = 0; k < kAcross; ++k) {
            for (int i = 0; i < kAcross; ++i) {
                Sight sight =
                    sights[static_cast<std::size_t>(k) * across + static_cast<std::size_t>(kAcross * column + i)];
                if (sight.is_covered) {
                    ++covered;
                    sight.normal.z = std::max(sight.normal.z, 0.0);  // between vertices, it may turn too far
                } else {
                    sight = groundAt(window_.toMetres({column + (i + 0.5) / kAcross, row + (k + 0.5) / kAcross}));
                }
                wet += sight.is_wet ? 1 : 0;
                height += sight.top;
                thickness += sight.thickness;
                normal = normal + unit(sight.normal);
            }
        }
        constexpr double kPlaces = kAcross * kAcross;
        const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.width()) +
                                  static_cast<std::size_t>(column);
        maps.height.values[pixel] = static_cast<float>(height / kPlaces);
        maps.thickness.values[pixel] = static_cast<float>(std::max(thickness, 0.0) / kPlaces);
        maps.coverage.values[pixel] = static_cast<float>(covered / kPlaces);
        maps.wetness.values[pixel] = static_cast<float>(wet / kPlaces);
        normal = unit(normal);
        maps.normal.values[3 * pixel] = static_cast<float>(normal.x);
        maps.normal.values[3 * pixel + 1] = static_cast<float>(normal.y);
        maps.normal.values[3 * pixel + 2] = static_cast<float>(normal.z);
    }

    const Surface& surface_;
    const DropletMapOptions& options_;
    Window window_;
    std::vector<bool> is_base_;
    std::vector<std::vector<Placed>> rows_;
};

/// Light that reaches a picture of heights.
class Horizons {
public:
    Horizons(const DropletMaps& maps, const DropletMapOptions& options)
        : maps_(maps), window_(options), is_tile_(options.is_tile)
    {
        highest_ = *std::max_element(maps.height.values.begin(), maps.height.values.end());
        for (std::size_t w = 0; w < ways_.size(); ++w) {
            ways_[w] = wayAt(2.0 * std::numbers::pi * static_cast<double>(w) / static_cast<double>(ways_.size()));
        }
    }

    float at(int row, int column) const
    {
        const std::size_t pixel = index(row, column);
        const Vec3 normal{maps_.normal.values[3 * pixel], maps_.normal.values[3 * pixel + 1],
                          maps_.normal.values[3 * pixel + 2]};
        const double steep = std::max(normal.z, kSteepest);
        const Vec2 gradient{-normal.x / steep, -normal.y / steep};
        double light = 0.0;
        for (std::size_t slice = 0; slice < kSlices; ++slice) {
            const Way& right = ways_[slice];
            // The normal's part in the slice, and its angle from the line of sight.
            const double along = normal.x * right.direction.x + normal.y * right.direction.y;
            const double part = std::hypot(along, normal.z);
            if (part == 0.0) {
                continue;
            }
            const double angle = std::atan2(along, normal.z);
            // Angles of the horizons from the line of sight, not beyond the surface's own plane.
            const auto horizon = [&](const Way& way) {
                return std::numbers::pi / 2.0 - std::atan(slopeAlong(row, column, way, gradient));
            };
            light += part * (arc(std::min(horizon(right), angle + std::numbers::pi / 2.0), angle) +
                             arc(std::max(-horizon(ways_[slice + kSlices]), angle - std::numbers::pi / 2.0), angle));
        }
        return static_cast<float>(std::clamp(light / kSlices, 0.0, 1.0));
    }

private:
    static constexpr std::size_t kSlices = 8;  // evenly turned; 16 differ by a hundredth
    static constexpr double kSteepest = 0.3;   // component of a normal up to which its plane is followed
    static constexpr double kGrowth = 0.2;  // of steps with the distance; half of it differs by less than a hundredth
    static constexpr double kFlat = 0.1;    // slope under which horizons are not looked for: a hundredth of the light

    /// A pixel in about a direction.
    struct Step {
        int right = 0;
        int down = 0;
        double distance = 0.0;  ///< [m]
        Vec2 aside;             ///< from the direction [m]
    };
    struct Way {
        Vec2 direction;
        std::vector<Step> steps;
    };

    /// The integral of the cosine to the normal from the line of sight to a horizon (eq. 7).
    static double arc(double horizon, double angle)
    {
        return 0.25 * (-std::cos(2.0 * horizon - angle) + std::cos(angle) + 2.0 * horizon * std::sin(angle));
    }

    /// Pixels from near to as far as the highest place still matters.
    Way wayAt(double turn) const
    {
        Way way{{std::cos(turn), std::sin(turn)}, {}};
        const Vec2 pixel = window_.pixel();
        const double metres = std::min(pixel.x, pixel.y);
        const double lowest = *std::min_element(maps_.height.values.begin(), maps_.height.values.end());
        const double farthest = (highest_ - lowest) / kFlat;
        double reach = 0.0;
        while (reach < farthest) {
            reach += std::max(metres, kGrowth * reach);
            Step step;
            step.right = static_cast<int>(std::lround(reach * way.direction.x / pixel.x));
            step.down = static_cast<int>(std::lround(-reach * way.direction.y / pixel.y));
            const Vec2 to{step.right * pixel.x, -step.down * pixel.y};
            step.distance = dot(to, way.direction);
            step.aside = to - step.distance * way.direction;
            if (!(step.distance > 0.0)) {
                continue;
            }
            way.steps.push_back(step);
        }
        return way;
    }

    std::size_t index(int row, int column) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.width()) +
               static_cast<std::size_t>(column);
    }

    /// Slope of the horizon in a direction, at least 0. What a pixel beside the direction has by the plane of the
    /// surface is taken off.
    double slopeAlong(int row, int column, const Way& way, Vec2 gradient) const
    {
        const double here = maps_.height.values[index(row, column)];
        double slope = 0.0;
        for (const Step& step : way.steps) {
            if (highest_ - here <= std::max(slope, kFlat) * step.distance) {
                break;
            }
            const std::optional<double> height = heightAt(row + step.down, column + step.right);
            if (!height) {
                break;
            }
            slope = std::max(slope, (*height - here - dot(gradient, step.aside)) / step.distance);
        }
        return slope;
    }

    /// Of a pixel; nothing beyond the window.
    std::optional<double> heightAt(int row, int column) const
    {
        if (row < 0 || column < 0 || row >= window_.height() || column >= window_.width()) {
            if (!is_tile_) {
                return std::nullopt;
            }
            const auto within = [](int k, int count) { return (k % count + count) % count; };
            row = within(row, window_.height());
            column = within(column, window_.width());
        }
        return maps_.height.values[index(row, column)];
    }

    const DropletMaps& maps_;
    Window window_;
    bool is_tile_;
    double highest_ = 0.0;
    std::array<Way, 2 * kSlices> ways_;
};

}  // namespace

DropletMaps dropletMaps(const Surface& surface, const DropletMapOptions& options)
{
    surface.validate();
    requireWithin("width", options.width, 16, 8192);
    for (const double side : {options.extent.x, options.extent.y}) {
        require(side > 0.0 && std::isfinite(side), "extent", side, "positive on both sides");
    }
    const double height = std::round(options.width * options.extent.y / options.extent.x);
    require(height <= 8192.0, "the maps' height", height, "at most 8192: use a smaller width");
    DropletMaps maps = Painter(surface, options).draw();
    const Horizons horizons(maps, options);
    tbb::parallel_for(0, maps.height.height, [&](int row) {
        for (int column = 0; column < maps.height.width; ++column) {
            maps.occlusion.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(maps.height.width) +
                                  static_cast<std::size_t>(column)] = horizons.at(row, column);
        }
    });
    return maps;
}

}  // namespace droplet
