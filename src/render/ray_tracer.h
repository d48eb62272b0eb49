// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/render/render.h"
#include "droplet/surface/surface.h"
#include "render/optics.h"

namespace droplet {

struct RayF {
    Vec3f origin;
    Vec3f direction;  ///< unit
};

/// First intersection of a ray.
struct Meeting {
    enum class What { Liquid, Ground, Nothing };

    What what = What::Nothing;
    float distance = 0.0F;
    Vec3f place;
    Vec3f facet;                 ///< unit normal of the triangle, outward
    Vec3f normal;                ///< unit, interpolated, outward
    Vec2 uv;                     ///< place in the picture of the ground, or of the liquid
    std::uint32_t triangle = 0;  ///< on liquid: index in the surface; on a stand: in it
    float u = 0.0F;              ///< weight of its second vertex
    float v = 0.0F;              ///< weight of its third vertex
};

/// Droplets and their ground, prepared for ray tracing. Lengths are in units of `scale`; the origin lies at z = 0 below
/// the middle of the scene.
///
/// The base counts as ground. It is the part of the surface that is connected to the copied vertices of the rim, or
/// lies in the plane z = 0. In the latter case the plane replaces it. Ground that is an object is met in its own
/// triangles.
class RayTracer {
public:
    /// @param surface  valid, or without triangles
    /// @param options  `stand`, valid; without it the ground is the plane z = 0, or only the base if that is not in the
    ///                 plane. `extent` gives uv on the plane; zero: that of the surface. `framed`
    RayTracer(const Surface& surface, const RenderOptions& options);
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// Intersection of a ray from outside the liquid.
    [[nodiscard]] Meeting fromAir(const RayF& ray) const;
    /// Intersection of a ray from inside the liquid.
    [[nodiscard]] Meeting fromLiquid(const RayF& ray) const;
    /// Intersection without the liquid.
    [[nodiscard]] Meeting dry(const RayF& ray) const;

    [[nodiscard]] Vec3f toScene(Vec3 p) const;
    [[nodiscard]] double scale() const { return scale_; }  ///< [m]
    [[nodiscard]] bool onPlane() const { return on_plane_; }
    /// Smallest box around the liquid and RenderOptions::framed.
    [[nodiscard]] Vec3f low() const { return low_; }
    [[nodiscard]] Vec3f high() const { return high_; }
    /// Points that a picture should show: the surface's vertices, then the stand's.
    [[nodiscard]] const std::vector<Vec3f>& shown() const { return shown_; }
    /// The stand's vertices.
    [[nodiscard]] std::vector<Vec3f> stand() const;
    /// The surface's vertices, or the corners of RenderOptions::framed.
    [[nodiscard]] std::vector<Vec3f> droplets() const;
    [[nodiscard]] const Triangle& triangle(const Meeting& meeting) const { return triangles_[meeting.triangle]; }
    [[nodiscard]] Vec3f vertex(std::uint32_t index) const { return shown_[index]; }  ///< vertex of the surface
    [[nodiscard]] Vec2 uvOnPlane(Vec3f place) const;

private:
    struct Embree;

    [[nodiscard]] Meeting meet(void* scene, const RayF& ray) const;
    [[nodiscard]] bool passesBox(const RayF& ray) const;
    [[nodiscard]] Meeting nearerOfPlane(const RayF& ray, Meeting meeting) const;
    /// Place of an object on which a place of the base lies; none if there is none.
    [[nodiscard]] Meeting onObject(const Meeting& base) const;

    double scale_ = 1.0;
    Vec3 middle_;
    Vec2 extent_;
    bool on_plane_ = false;
    bool on_object_ = false;  ///< whether there is a base, and it lies on an object
    Vec3f low_;
    Vec3f high_;
    std::vector<Triangle> triangles_;  ///< triangles of the liquid, as indices of the surface's vertices
    std::vector<Vec3f> shown_;
    std::vector<Vec3f> framed_;
    std::size_t surface_vertices_ = 0;
    std::unique_ptr<Embree> embree_;
};

}  // namespace droplet
