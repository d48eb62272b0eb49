// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/glass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/surface/onto.h"
#include "number_text.h"
#include "require.h"

namespace droplet {
namespace {

Vec3 unit(Vec3 a)
{
    return (1.0 / length(a)) * a;
}

/// Components of a vector along the tangents of a place.
Vec2 along(const GlassPlace& place, Vec3 a)
{
    return {dot(a, place.across), dot(a, place.up)};
}

}  // namespace

struct Glass::Shape {
    Shape() = default;
    Shape(const Shape&) = delete;
    Shape& operator=(const Shape&) = delete;
    virtual ~Shape() = default;

    [[nodiscard]] virtual std::optional<GlassPlace> place(Vec2 position) const = 0;
    [[nodiscard]] virtual bool holds(Vec2 position) const = 0;
    [[nodiscard]] virtual std::vector<GlassTriangle> triangles() const = 0;
    [[nodiscard]] virtual const Cylinder* cylinder() const { return nullptr; }
};

struct Glass::CylinderShape final : Glass::Shape {
    explicit CylinderShape(const Cylinder& cylinder)
        : form(cylinder),
          normal{0.0, std::sin(cylinder.slope), std::cos(cylinder.slope)},
          up{0.0, -std::cos(cylinder.slope), std::sin(cylinder.slope)}
    {
    }

    [[nodiscard]] bool holds(Vec2 p) const override
    {
        return p.x >= 0.0 && p.x <= form.width && p.y >= 0.0 && p.y <= form.height;
    }

    [[nodiscard]] std::optional<GlassPlace> place(Vec2 p) const override
    {
        return holds(p) ? std::optional(at(p)) : std::nullopt;
    }

    /// Place of a position on the glass.
    [[nodiscard]] GlassPlace at(Vec2 p) const
    {
        const double arc = p.x - 0.5 * form.width;
        const double turn = arc / form.radius;  // 0 where the radius is infinite
        const double sine = std::sin(turn);
        const double cosine = std::cos(turn);
        const bool flat = turn == 0.0;
        const double aside = flat ? arc : form.radius * sine;
        const double behind = flat ? 0.0 : form.radius * (cosine - 1.0);
        const Vec3 right{1.0, 0.0, 0.0};
        return {aside * right + behind * normal + p.y * up, sine * right + cosine * normal,
                cosine * right - sine * normal, up};
    }

    [[nodiscard]] std::vector<GlassTriangle> triangles() const override
    {
        constexpr int kColumns = 64;  // of 1.4 m at a radius of 5 m: 12 µm from the arc
        std::vector<GlassTriangle> triangles;
        const auto corners = [this](int column) {
            const double x = form.width * column / kColumns;
            return std::array{Vec2{x, 0.0}, Vec2{x, form.height}};
        };
        const auto add = [&](const std::array<Vec2, 3>& p) {
            triangles.push_back({p, {at(p[0]), at(p[1]), at(p[2])}});
        };
        for (int column = 0; column < kColumns; ++column) {
            const auto [a, d] = corners(column);
            const auto [b, c] = corners(column + 1);
            add({a, b, c});
            add({a, c, d});
        }
        return triangles;
    }

    [[nodiscard]] const Cylinder* cylinder() const override { return &form; }

    Cylinder form;
    Vec3 normal;  // normal in the middle
    Vec3 up;
};

struct Glass::MeshShape final : Glass::Shape {
    struct Facet {
        std::array<Vec2, 3> flat;  // corners on the unrolled glass
        std::array<Vec3, 3> points;
        std::array<Vec3, 3> normals;
        Vec3 across;           // x direction of the nearest isometry, in the facet's plane
        double handed = 1.0;   // 1 if (across, up) has the orientation that the driver sees; else −1
        double inverse = 0.0;  // inverse of the doubled area on the unrolled glass
    };

    struct Found {
        const Facet* facet = nullptr;
        std::array<double, 3> weights{};

        /// Place in the facet.
        [[nodiscard]] GlassPlace place() const
        {
            const auto blend = [this](const std::array<Vec3, 3>& a) {
                return weights[0] * a[0] + weights[1] * a[1] + weights[2] * a[2];
            };
            GlassPlace place;
            place.point = blend(facet->points);
            place.normal = unit(blend(facet->normals));
            place.across = unit(facet->across - dot(facet->across, place.normal) * place.normal);
            place.up = facet->handed * cross(place.across, place.normal);
            return place;
        }
    };

    /// First facet, in the object's order, that contains a position.
    [[nodiscard]] std::optional<Found> find(Vec2 p) const
    {
        // Points this close outside a side, relative to the triangle's height, count as inside: seams have no gaps.
        constexpr double kSeamTolerance = 1e-9;
        if (!(p.x >= 0.0 && p.y >= 0.0 && p.x <= size.x && p.y <= size.y)) {
            return std::nullopt;
        }
        const auto column = std::min(columns - 1, static_cast<std::size_t>(p.x / cell.x));
        const auto row = std::min(rows - 1, static_cast<std::size_t>(p.y / cell.y));
        const std::size_t number = row * columns + column;
        for (std::uint32_t k = first[number]; k < first[number + 1]; ++k) {
            const Facet& f = facets[members[k]];
            const double w1 = f.inverse * cross(p - f.flat[0], f.flat[2] - f.flat[0]);
            const double w2 = f.inverse * cross(f.flat[1] - f.flat[0], p - f.flat[0]);
            const double w0 = 1.0 - w1 - w2;
            if (std::min({w0, w1, w2}) >= -kSeamTolerance) {
                return Found{&f, {w0, w1, w2}};
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] bool holds(Vec2 position) const override { return find(position).has_value(); }

    [[nodiscard]] std::optional<GlassPlace> place(Vec2 position) const override
    {
        const std::optional<Found> found = find(position);
        return found ? std::optional(found->place()) : std::nullopt;
    }

    [[nodiscard]] std::vector<GlassTriangle> triangles() const override
    {
        std::vector<GlassTriangle> triangles;
        for (const Facet& f : facets) {
            GlassTriangle t{f.flat,
                            {Found{&f, {1.0, 0.0, 0.0}}.place(), Found{&f, {0.0, 1.0, 0.0}}.place(),
                             Found{&f, {0.0, 0.0, 1.0}}.place()}};
            if (f.inverse < 0.0) {
                std::swap(t.positions[1], t.positions[2]);
                std::swap(t.places[1], t.places[2]);
            }
            triangles.push_back(t);
        }
        return triangles;
    }

    /// Builds cells, about as many as facets, with a list of the facets in each.
    void buildCells()
    {
        const double per_side = std::sqrt(static_cast<double>(facets.size()));
        columns = rows = static_cast<std::size_t>(std::ceil(per_side));
        cell = {size.x / static_cast<double>(columns), size.y / static_cast<double>(rows)};
        const auto visit = [this](const auto& put) {
            for (std::uint32_t f = 0; f < facets.size(); ++f) {
                const auto& [a, b, c] = facets[f].flat;
                // The margin is a little more than the tolerance of find().
                const auto low = [](double v, double step) {
                    return static_cast<std::size_t>(std::max(0.0, v / step - 1e-6));
                };
                const auto high = [](double v, double step, std::size_t max) {
                    return std::min(max - 1, static_cast<std::size_t>(v / step + 1e-6));
                };
                const std::size_t right = high(std::max({a.x, b.x, c.x}), cell.x, columns);
                const std::size_t top = high(std::max({a.y, b.y, c.y}), cell.y, rows);
                for (std::size_t y = low(std::min({a.y, b.y, c.y}), cell.y); y <= top; ++y) {
                    for (std::size_t x = low(std::min({a.x, b.x, c.x}), cell.x); x <= right; ++x) {
                        put(y * columns + x, f);
                    }
                }
            }
        };
        first.assign(columns * rows + 1, 0);
        visit([this](std::size_t number, std::uint32_t) { ++first[number + 1]; });
        for (std::size_t k = 0; k + 1 < first.size(); ++k) {
            first[k + 1] += first[k];
        }
        members.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        visit([&](std::size_t number, std::uint32_t f) { members[next[number]++] = f; });
    }

    std::vector<Facet> facets;
    Vec2 size;
    Vec2 cell;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<std::uint32_t> first;  // index of each cell's first member
    std::vector<std::uint32_t> members;
};

Glass::Glass(const Cylinder& cylinder)
{
    require(cylinder.radius > 0.0, "glass.radius", cylinder.radius, "more than 0 m");
    require(cylinder.width > 0.0 && std::isfinite(cylinder.width), "glass.width", cylinder.width,
            "finite and more than 0 m");
    require(cylinder.width <= std::numbers::pi * cylinder.radius, "glass.width", cylinder.width,
            "at most pi times the radius");
    require(cylinder.height > 0.0 && std::isfinite(cylinder.height), "glass.height", cylinder.height,
            "finite and more than 0 m");
    require(cylinder.slope >= 0.0 && cylinder.slope <= 0.5 * std::numbers::pi, "glass.slope", cylinder.slope,
            "from 0 to pi/2");
    width_ = cylinder.width;
    height_ = cylinder.height;
    shape_ = std::make_shared<CylinderShape>(cylinder);
}

Glass::Glass(const TexturedMesh& object, const Developed& developed)
{
    object.validate();
    const double ahead = length(developed.ahead);
    if (!(ahead > 0.0) || !std::isfinite(ahead)) {
        throw Error(ErrorCode::InvalidArgument, "glass.ahead must be finite and not zero");
    }
    if (!(developed.scale >= 0.0) || !std::isfinite(developed.scale)) {
        throw Error(ErrorCode::InvalidArgument,
                    "glass.scale is " + numberText(developed.scale) + "; it must be at least 0 m");
    }
    const double scale = developed.scale > 0.0 ? developed.scale : metresPerUv(object);
    const Vec2 y = (1.0 / ahead) * developed.ahead;
    const auto turned = [y](Vec3 a) { return Vec3{y.y * a.x - y.x * a.y, y.x * a.x + y.y * a.y, a.z}; };

    auto mesh = std::make_shared<MeshShape>();
    double seen_from_outside = 0.0;
    for (const Triangle& t : object.triangles) {
        MeshShape::Facet f;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 uv = object.uvs[t[k]];
            f.flat[k] = {scale * uv.x, -scale * uv.y};
            f.points[k] = turned(object.vertices[t[k]]);
            f.normals[k] = turned(object.normals[t[k]]);
        }
        const Vec3 facet = cross(f.points[1] - f.points[0], f.points[2] - f.points[0]);
        const double flat = cross(f.flat[1] - f.flat[0], f.flat[2] - f.flat[0]);
        const Vec3 outward = f.normals[0] + f.normals[1] + f.normals[2];
        if (length(facet) > 0.0 && flat != 0.0 && std::isfinite(1.0 / flat) && length(outward) > 0.0) {
            seen_from_outside += std::copysign(length(facet), flat * dot(facet, outward));
            mesh->facets.push_back(f);
        }
    }
    if (mesh->facets.empty()) {
        throw Error(ErrorCode::InvalidInput, "the glass has no triangle with an area both in space and in uv");
    }
    const double mirror = seen_from_outside > 0.0 ? -1.0 : 1.0;
    Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 high{-low.x, -low.y};
    for (MeshShape::Facet& f : mesh->facets) {
        for (Vec2& p : f.flat) {
            p.x *= mirror;
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    }
    min_stretch_ = std::numeric_limits<double>::infinity();
    max_stretch_ = 0.0;
    for (MeshShape::Facet& f : mesh->facets) {
        for (Vec2& p : f.flat) {
            p = p - low;
        }
        const Vec2 p = f.flat[1] - f.flat[0];
        const Vec2 q = f.flat[2] - f.flat[0];
        f.inverse = 1.0 / cross(p, q);
        const Vec3 a = f.points[1] - f.points[0];
        const Vec3 b = f.points[2] - f.points[0];
        // J = (X_x, X_y); the isometry nearest to it is J (JᵀJ)^(−½). For 2 × 2 matrices √G = (G + √det G) / √(tr G
        // + 2 √det G). Up to a factor, its first column is X_x (G_yy + d) − X_y G_xy.
        const Vec3 xx = f.inverse * (q.y * a - p.y * b);
        const Vec3 xy = f.inverse * (p.x * b - q.x * a);
        const double gxx = dot(xx, xx);
        const double gxy = dot(xx, xy);
        const double gyy = dot(xy, xy);
        const double d = length(cross(xx, xy));
        f.across = unit((gyy + d) * xx - gxy * xy);
        const Vec3 outward = f.normals[0] + f.normals[1] + f.normals[2];
        f.handed = dot(cross(xx, xy), outward) < 0.0 ? 1.0 : -1.0;
        const double mean = 0.5 * (gxx + gyy);
        const double spread = std::sqrt(0.25 * (gxx - gyy) * (gxx - gyy) + gxy * gxy);
        max_stretch_ = std::max(max_stretch_, std::sqrt(mean + spread));
        min_stretch_ = std::min(min_stretch_, d / std::sqrt(mean + spread));
    }
    mesh->size = high - low;
    width_ = mesh->size.x;
    height_ = mesh->size.y;
    mesh->buildCells();
    shape_ = std::move(mesh);
}

std::optional<Glass::Cylinder> Glass::cylinder() const
{
    const Cylinder* form = shape_->cylinder();
    return form != nullptr ? std::optional(*form) : std::nullopt;
}

std::optional<GlassPlace> Glass::place(Vec2 position) const
{
    return shape_->place(position);
}

bool Glass::holds(Vec2 position) const
{
    return shape_->holds(position);
}

std::vector<GlassTriangle> Glass::triangles() const
{
    return shape_->triangles();
}

Vec2 gravityAlong(const GlassPlace& place, double gravity)
{
    return along(place, {0.0, 0.0, -gravity});
}

Vec2 inertiaAlong(const GlassPlace& place, double acceleration)
{
    return along(place, {0.0, -acceleration, 0.0});
}

Vec2 windAlong(const GlassPlace& place, double speed, WindAlongGlass how)
{
    const Vec2 projected = along(place, {0.0, -speed, 0.0});
    const double size = std::sqrt(dot(projected, projected));
    // A wind perpendicular to the glass has no projection; the rounding errors of it are not a direction.
    if (how == WindAlongGlass::Projected || size <= 1e-9 * std::abs(speed)) {
        return projected;
    }
    return (std::abs(speed) / size) * projected;
}

}  // namespace droplet
