// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/picture/render.h"
#include "droplet/surface/surface.h"
#include "picture/optics.h"

namespace droplet {

struct RayF {
    Vec3f origin;
    Vec3f direction;  ///< unit
};

/// What a ray meets first.
struct Meeting {
    enum class What { Liquid, Ground, Nothing };

    What what = What::Nothing;
    float distance = 0.0F;
    Vec3f place;
    Vec3f facet;                 ///< unit normal of the triangle, outward
    Vec3f normal;                ///< unit, interpolated, outward
    Vec2 uv;                     ///< of ground, as a picture is laid on it
    std::uint32_t triangle = 0;  ///< of the surface where liquid is met
    float u = 0.0F;              ///< weight of its second vertex there
    float v = 0.0F;              ///< weight of its third vertex there
};

/// A droplet and what it stands on, made ready for rays. Lengths are in units of `scale`, the origin below the middle
/// of all at z = 0.
///
/// The base is ground. It is told from the liquid by its rim, whose vertices are copies: the part of the surface that
/// hangs together with copies, or lies in the plane. A base that lies in the plane is left out in favour of the plane
/// itself.
class Scene {
public:
    /// @param surface  valid, or without triangles
    /// @param options  stand, valid: without one the plane z = 0, or where the base does not lie in it nothing but the
    ///                 base; extent, for uv on the plane: if zero, that of the surface; framed
    Scene(const Surface& surface, const RenderOptions& options);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// From outside the liquid.
    [[nodiscard]] Meeting fromAir(const RayF& ray) const;
    /// From inside.
    [[nodiscard]] Meeting fromLiquid(const RayF& ray) const;
    /// As if there were no liquid.
    [[nodiscard]] Meeting dry(const RayF& ray) const;

    [[nodiscard]] Vec3f toScene(Vec3 p) const;
    [[nodiscard]] double scale() const { return scale_; }  ///< [m]
    [[nodiscard]] bool onPlane() const { return on_plane_; }
    /// Smallest box around the liquid and what is framed.
    [[nodiscard]] Vec3f low() const { return low_; }
    [[nodiscard]] Vec3f high() const { return high_; }
    /// Everything that a picture should show: the surface's vertices, then the stand's.
    [[nodiscard]] const std::vector<Vec3f>& shown() const { return shown_; }
    /// The surface's vertices, or the corners of what is framed instead.
    [[nodiscard]] std::vector<Vec3f> droplets() const;
    [[nodiscard]] const Triangle& triangle(const Meeting& meeting) const { return triangles_[meeting.triangle]; }
    [[nodiscard]] Vec3f vertex(std::uint32_t index) const { return shown_[index]; }  ///< of the surface
    [[nodiscard]] Vec2 uvOnPlane(Vec3f place) const;

private:
    struct Embree;

    [[nodiscard]] Meeting meet(void* scene, const RayF& ray) const;
    [[nodiscard]] bool passesBox(const RayF& ray) const;
    [[nodiscard]] Meeting nearerOfPlane(const RayF& ray, Meeting meeting) const;

    double scale_ = 1.0;
    Vec3 middle_;
    Vec2 extent_;
    bool on_plane_ = false;
    Vec3f low_;
    Vec3f high_;
    std::vector<Triangle> triangles_;  ///< of the liquid, indices of the surface's vertices
    std::vector<Vec3f> shown_;
    std::vector<Vec3f> framed_;
    std::size_t surface_vertices_ = 0;
    std::unique_ptr<Embree> embree_;
};

}  // namespace droplet
