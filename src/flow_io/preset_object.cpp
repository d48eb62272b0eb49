// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes are drawn by eye; lengths in comments are in metres unless a line says otherwise.
#include "droplet/flow_io/preset_object.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "droplet/units.h"
#include "io/vertex_normals.h"
#include "require.h"

namespace droplet {
namespace {

using std::numbers::pi;

constexpr double kSlope = 30.0 * kDegree;

struct Cells {
    std::uint32_t across = 1;
    std::uint32_t along = 1;
};

/// Collects grids of triangles. A grid's u runs to the right and its v upwards as seen from outside.
class Grids {
public:
    explicit Grids(double detail) : detail_(detail) {}

    [[nodiscard]] std::uint32_t finer(double cells) const
    {
        return static_cast<std::uint32_t>(std::max(std::lround(cells * detail_), 1L));
    }

    /// Adds a grid over the unit square.
    /// @param place  of a point (u, v) in space
    /// @param keeps  whether the cell around a point (u, v) is part of the object
    template <typename Place, typename Keeps>
    void add(Cells cells, const std::string& material, const Place& place, const Keeps& keeps)
    {
        const auto first = static_cast<std::uint32_t>(object_.vertices.size());
        const auto share = [](double k, std::uint32_t of) { return k / of; };
        for (std::uint32_t j = 0; j <= cells.along; ++j) {
            for (std::uint32_t i = 0; i <= cells.across; ++i) {
                const Vec2 uv{share(i, cells.across), share(j, cells.along)};
                object_.vertices.push_back(place(uv));
                object_.uvs.push_back({uv.x, 1.0 - uv.y});
            }
        }
        const auto number = static_cast<std::uint32_t>(object_.material_names.size());
        object_.material_names.push_back(material);
        for (std::uint32_t j = 0; j < cells.along; ++j) {
            for (std::uint32_t i = 0; i < cells.across; ++i) {
                if (keeps(Vec2{share(i + 0.5, cells.across), share(j + 0.5, cells.along)})) {
                    const std::uint32_t a = first + j * (cells.across + 1) + i;
                    const std::uint32_t c = a + cells.across + 1;
                    addTriangle({a, a + 1, c + 1}, number);
                    addTriangle({a, c + 1, c}, number);
                }
            }
        }
    }

    template <typename Place>
    void add(Cells cells, const std::string& material, const Place& place)
    {
        add(cells, material, place, [](Vec2) { return true; });
    }

    /// Look of the one material so far.
    void look(StandLook look) { object_.looks = {std::move(look)}; }

    /// The object, without vertices that no triangle has.
    FlowObject finish() &&
    {
        constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> kept(object_.vertices.size(), kUnused);
        FlowObject whole;
        for (Triangle& triangle : object_.triangles) {
            for (std::uint32_t& corner : triangle) {
                if (kept[corner] == kUnused) {
                    kept[corner] = static_cast<std::uint32_t>(whole.vertices.size());
                    whole.vertices.push_back(object_.vertices[corner]);
                    whole.uvs.push_back(object_.uvs[corner]);
                }
                corner = kept[corner];
            }
        }
        whole.triangles = std::move(object_.triangles);
        whole.materials = std::move(object_.materials);
        whole.material_names = std::move(object_.material_names);
        whole.looks = std::move(object_.looks);
        whole.images.resize(whole.looks.size());
        whole.normals.resize(whole.vertices.size());
        fillNormals(whole.vertices, whole.triangles, firstAtPlace(whole.vertices), whole.normals);
        return whole;
    }

private:
    void addTriangle(const Triangle& triangle, std::uint32_t material)
    {
        const auto at = [&](std::size_t k) { return object_.vertices[triangle[k]]; };
        if (!(at(0) == at(1) || at(1) == at(2) || at(2) == at(0))) {  // at a pole
            object_.triangles.push_back(triangle);
            object_.materials.push_back(material);
        }
    }

    double detail_;
    FlowObject object_;
};

double bell(double x)
{
    return std::exp(-x * x);
}

/// From 0 at `from` to 1 at `to`.
double ramp(double from, double to, double x)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Piecewise linear through points of ascending x, with round corners.
double along(std::span<const Vec2> points, double x, double roundness)
{
    const auto line = [&](double at) {
        std::size_t k = 1;
        while (k + 1 < points.size() && points[k].x < at) {
            ++k;
        }
        const double t = std::clamp((at - points[k - 1].x) / (points[k].x - points[k - 1].x), 0.0, 1.0);
        return points[k - 1].y + t * (points[k].y - points[k - 1].y);
    };
    constexpr int kHalf = 8;
    double sum = 0.0;
    for (int i = -kHalf; i <= kHalf; ++i) {
        sum += line(x + roundness * i / kHalf);
    }
    return sum / (2 * kHalf + 1);
}

/// Direction in the level plane; the same bits after a whole turn.
Vec2 around(double turns)
{
    const double angle = turns < 1.0 ? 2.0 * pi * turns : 0.0;
    return {std::cos(angle), std::sin(angle)};
}

void addSlope(Grids& grids, const std::string& material, double left, double width)
{
    const std::uint32_t across = std::max(grids.finer(160.0 * width), 1U);
    grids.add({across, grids.finer(48)}, material, [&](Vec2 uv) {
        const double y = 0.3 * (uv.y - 0.5) * std::cos(kSlope);
        return Vec3{left + width * uv.x, y, std::tan(kSlope) * y};
    });
}

void addPlate(Grids& grids)
{
    constexpr double kSide = 0.04;
    grids.add({grids.finer(8), grids.finer(8)}, "plate", [](Vec2 uv) {
        return Vec3{kSide * (uv.x - 0.5), kSide * (uv.y - 0.5), 0.0};
    });
}

void addSphere(Grids& grids)
{
    grids.add({grids.finer(72), grids.finer(36)}, "sphere", [](Vec2 uv) {
        const double tilt = pi * (1.0 - uv.y);
        const double out = uv.y > 0.0 && uv.y < 1.0 ? std::sin(tilt) : 0.0;
        return 0.1 * Vec3{out * around(uv.x).x, out * around(uv.x).y, std::cos(tilt)};
    });
}

// ---- mask: x and z from -1 to 1, depth in half widths

constexpr double kHalfWidth = 0.075;
constexpr double kHalfHeight = 0.11;
constexpr Vec2 kEye{0.40, 0.17};
constexpr Vec2 kEyeSize{0.20, 0.085};
constexpr double kMouth = -0.5;
constexpr double kMouthWidth = 0.29;
constexpr double kMouthOpening = 0.022;

double faceDepth(double x, double z)
{
    const double side = std::abs(x);
    double depth = std::sqrt(std::max(1.0 - 0.72 * x * x - 0.93 * z * z, 0.02));
    const double nose = ramp(0.38, -0.13, z) * ramp(-0.23, -0.12, z);
    depth += 0.36 * nose * bell(x / (0.10 + 0.07 * ramp(0.2, -0.15, z)));
    depth += 0.09 * bell((side - 0.14) / 0.07) * bell((z + 0.13) / 0.07);      // nostrils
    depth -= 0.17 * bell((side - kEye.x) / 0.24) * bell((z - kEye.y) / 0.15);  // eye sockets
    depth += 0.11 * bell((z - 0.40 + 0.25 * (side - 0.4) * (side - 0.4)) / 0.09) * ramp(0.0, 0.2, side) *
             ramp(0.85, 0.6, side);                                        // brows
    depth += 0.07 * bell((side - 0.52) / 0.22) * bell((z + 0.10) / 0.16);  // cheekbones
    const double lip = ramp(0.40, 0.15, side);
    depth += 0.10 * lip * bell((z - kMouth - 0.075 + 0.03 * bell(x / 0.06)) / 0.055);  // upper lip
    depth += 0.11 * ramp(0.34, 0.10, side) * bell((z - kMouth + 0.085) / 0.06);        // lower lip
    depth -= 0.05 * bell(x / 0.25) * bell((z + 0.68) / 0.06);                          // below it
    depth += 0.17 * bell(x / 0.30) * bell((z + 0.82) / 0.10);                          // chin
    return depth;
}

void addMask(Grids& grids)
{
    const Cells cells{grids.finer(32), grids.finer(34)};
    const double half_row = 1.0 / cells.along;
    const auto plane = [](Vec2 uv) {
        const double z = 2.0 * uv.y - 1.0;
        const double width = std::sqrt(1.0 - 0.86 * z * z) * (1.0 - 0.16 * ramp(0.0, -1.0, z));
        return Vec2{(2.0 * uv.x - 1.0) * width, z};
    };
    const auto eye_offset = [](Vec2 p) {
        return Vec2{(std::abs(p.x) - kEye.x) / kEyeSize.x, (p.y - kEye.y) / kEyeSize.y};
    };
    const auto in_eye = [&](Vec2 p) { return length(eye_offset(p)) < 1.0; };
    const auto in_mouth = [&](Vec2 p) {
        return std::abs(p.x) < kMouthWidth && std::abs(p.y - kMouth) <= half_row * 1.001;
    };
    const auto is_open = [&](Vec2 uv) {
        const Vec2 p = plane(uv);
        return in_eye(p) || in_mouth(p);
    };
    const auto place = [&](Vec2 uv) {
        Vec2 p = plane(uv);
        // Corners of open cells move onto the outline of the opening.
        const Vec2 cell{0.5 / cells.across, 0.5 / cells.along};
        bool at_eye = false;
        bool at_mouth = false;
        for (const Vec2 corner : {Vec2{-1.0, -1.0}, Vec2{1.0, -1.0}, Vec2{-1.0, 1.0}, Vec2{1.0, 1.0}}) {
            const Vec2 centre = plane({uv.x + corner.x * cell.x, uv.y + corner.y * cell.y});
            at_eye = at_eye || in_eye(centre);
            at_mouth = at_mouth || in_mouth(centre);
        }
        if (at_eye) {
            const Vec2 offset = eye_offset(p);
            const double size = std::max(length(offset), 1e-9);
            p = {std::copysign(kEye.x + kEyeSize.x * offset.x / size, p.x), kEye.y + kEyeSize.y * offset.y / size};
        } else if (at_mouth) {
            const double opening = std::max(1.0 - p.x * p.x / (kMouthWidth * kMouthWidth), 0.1) * kMouthOpening;
            p.y = kMouth + std::copysign(opening, p.y - kMouth);
        }
        return Vec3{kHalfWidth * p.x, -kHalfWidth * faceDepth(p.x, p.y), kHalfHeight * p.y};
    };
    grids.add(cells, "mask", place, [&](Vec2 uv) { return !is_open(uv); });
}

// ---- bottle

void addBottle(Grids& grids)
{
    // Radius and height of the profile, from the middle of the base to that of the top, at even steps of a parameter.
    std::vector<Vec2> profile;
    const auto piece = [&](double cells, const auto& at) {
        const std::uint32_t count = grids.finer(cells);
        for (std::uint32_t k = profile.empty() ? 0 : 1; k <= count; ++k) {
            profile.push_back(at(static_cast<double>(k) / count));
        }
    };
    const auto arc = [](Vec2 centre, double radius, double from, double to) {
        return [=](double t) {
            const double angle = (from + t * (to - from)) * kDegree;
            return Vec2{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
        };
    };
    piece(3, [](double t) { return Vec2{0.025 * t, 0.002 * (1.0 - t * t)}; });  // base, hollow in its middle
    piece(5, arc({0.025, 0.005}, 0.005, -90.0, 0.0));
    piece(16, [](double t) { return Vec2{0.030, 0.005 + 0.125 * t}; });
    piece(16, [](double t) { return Vec2{0.030 - 0.0175 * ramp(0.0, 1.0, t), 0.130 + 0.055 * t}; });
    piece(6, [](double t) { return Vec2{0.0125 - 0.0005 * t, 0.185 + 0.042 * t}; });
    piece(6, arc({0.012, 0.231}, 0.004, -90.0, 90.0));
    piece(2, [](double t) { return Vec2{0.012 * (1.0 - t), 0.235 + 0.0005 * t}; });
    const auto rows = static_cast<std::uint32_t>(profile.size() - 1);
    grids.add({grids.finer(48), rows}, "bottle", [&](Vec2 uv) {
        const Vec2 p = profile[static_cast<std::size_t>(std::lround(uv.y * rows))];
        return Vec3{p.x * around(uv.x).x, p.x * around(uv.x).y, p.y};
    });
}

// ---- leaf

void addLeaf(Grids& grids)
{
    constexpr double kLength = 0.12;
    constexpr double kVeins = 11.0;
    const std::uint32_t rows = grids.finer(66);
    // Middle of the blade from the stalk on: it rises a little, then droops.
    const auto droop = [](double s) { return -0.18 + 1.35 * std::pow(s, 1.6); };
    std::vector<Vec2> middle{{0.5 * kLength, 0.0}};
    for (std::uint32_t k = 0; k < rows; ++k) {
        const double angle = droop((k + 0.5) / rows);
        const double step = kLength / rows;
        middle.push_back({middle.back().x - step * std::cos(angle), middle.back().y - step * std::sin(angle)});
    }
    grids.add({grids.finer(28), rows}, "leaf", [&](Vec2 uv) {
        const std::size_t k = rows - static_cast<std::size_t>(std::lround(uv.y * rows));
        const double s = static_cast<double>(k) / rows;
        const double half = 0.030 * std::pow(std::sin(pi * std::pow(s, 0.78)), 0.85) + 0.0006;
        const double side = std::abs(2.0 * uv.x - 1.0);
        const double x = half * side;
        const double valley = 0.38 * (std::sqrt(x * x + 4e-6) - 2e-3) - 7.0 * x * x;
        const double veins = -0.00035 * std::cos(2.0 * pi * (kVeins * s - 1.7 * side)) * std::min(x / 0.004, 1.0);
        const double out = valley + veins;
        const double angle = droop(s);
        return Vec3{half * (2.0 * uv.x - 1.0), middle[k].x - out * std::sin(angle),
                    middle[k].y + out * std::cos(angle)};
    });
}

// ---- car: in metres of the full size, then a tenth of it

void addCar(Grids& grids)
{
    static constexpr std::array<Vec2, 9> kTop{{{0.0, 0.66},
                                               {0.2, 0.80},
                                               {1.25, 0.94},
                                               {1.95, 1.36},
                                               {2.4, 1.45},
                                               {3.0, 1.42},
                                               {3.7, 1.05},
                                               {4.2, 0.99},
                                               {4.3, 0.85}}};
    static constexpr std::array<Vec2, 4> kBottom{{{0.0, 0.36}, {0.35, 0.20}, {3.9, 0.20}, {4.3, 0.40}}};
    static constexpr std::array<Vec2, 6> kWidth{
        {{0.0, 0.66}, {0.3, 0.82}, {1.0, 0.87}, {3.3, 0.87}, {4.0, 0.82}, {4.3, 0.70}}};
    constexpr double kLength = 4.3;
    constexpr double kEnd = 0.08;  // length of the round ends
    const std::uint32_t end_rows = grids.finer(5);
    const std::uint32_t body_rows = grids.finer(64);
    const std::uint32_t rows = body_rows + 2 * end_rows;
    grids.add({grids.finer(56), rows}, "car", [&](Vec2 uv) {
        // v runs towards the front, rows from it.
        const auto row = static_cast<std::uint32_t>(std::lround((1.0 - uv.y) * rows));
        double s = 0.0;
        double size = 1.0;
        if (row < end_rows) {
            const double angle = 0.5 * pi * row / end_rows;
            s = -kEnd * std::cos(angle);
            size = std::sin(angle);
        } else if (row > end_rows + body_rows) {
            const double angle = 0.5 * pi * (rows - row) / end_rows;
            s = kLength + kEnd * std::cos(angle);
            size = row < rows ? std::sin(angle) : 0.0;
        } else {
            s = kLength * (row - end_rows) / body_rows;
        }
        const double at = std::clamp(s, 0.0, kLength);
        const double top = along(kTop, at, 0.13);
        const double bottom = along(kBottom, at, 0.1);
        const Vec2 direction = around(uv.x);
        const double box =
            std::pow(std::pow(std::abs(direction.x), 4.5) + std::pow(std::abs(direction.y), 4.5), -1.0 / 4.5);
        const double z = 0.5 * (top + bottom) + 0.5 * (top - bottom) * size * box * direction.y;
        const double cabin = 1.0 - 0.30 * ramp(0.90, 1.5, z);
        const double x = along(kWidth, at, 0.15) * size * cabin * box * direction.x;
        return 0.1 * Vec3{x, s - 0.5 * kLength, z};
    });
}

void addWindow(Grids& grids)
{
    const Cells cells{grids.finer(6), grids.finer(8)};
    grids.add(cells, "window", [](Vec2 uv) { return Vec3{0.3 * (uv.x - 0.5), 0.0, 0.4 * uv.y}; });
    grids.look({{.name = "window", .colour = {0.96, 0.98, 0.97}, .ior = 1.52}});
}

}  // namespace

FlowObject presetObject(PresetObject object, double detail)
{
    require(detail >= 0.25 && detail <= 20.0, "detail", detail, "from 0.25 to 20");
    Grids grids(detail);
    switch (object) {
        case PresetObject::Slope:
            addSlope(grids, "slope", -0.15, 0.3);
            break;
        case PresetObject::Slopes:
            addSlope(grids, "left", -0.16, 0.1);
            addSlope(grids, "middle", -0.05, 0.1);
            addSlope(grids, "right", 0.06, 0.1);
            break;
        case PresetObject::Plate:
            addPlate(grids);
            break;
        case PresetObject::Sphere:
            addSphere(grids);
            break;
        case PresetObject::Mask:
            addMask(grids);
            break;
        case PresetObject::Bottle:
            addBottle(grids);
            grids.look({{.name = "bottle", .colour = {0.55, 0.80, 0.62}, .ior = 1.52}});
            break;
        case PresetObject::Leaf:
            addLeaf(grids);
            grids.look(
                {{.name = "leaf", .colour = {0.085, 0.19, 0.035}, .roughness = 0.5, .transmission = 0.0, .ior = 1.45}});
            break;
        case PresetObject::Car:
            addCar(grids);
            grids.look(
                {{.name = "car", .colour = {0.35, 0.012, 0.015}, .roughness = 0.06, .transmission = 0.0, .ior = 1.5}});
            break;
        case PresetObject::Window:
            addWindow(grids);
            break;
    }
    return std::move(grids).finish();
}

}  // namespace droplet
