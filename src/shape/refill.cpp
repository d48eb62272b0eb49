// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, chapter 4: eq. 4.5 is linear in u and λ. So the change of u with the volume solves the same system
// without ground and tilt on its right-hand side.
#include "droplet/shape/refill.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "number_text.h"
#include "shape/recovered_normals.h"
#include "shape/sheet_base.h"

namespace droplet {
namespace {

/// Gain of a level field on flat ground, in the linear model: the field itself.
FillGain gainOf(const CapillarySurface& field)
{
    FillGain gain;
    for (const Vec3& p : field.vertices) {
        gain.height.push_back(p.z);
    }
    gain.rim_slope = rimSlopes(field, {});
    gain.pressure = field.pressure;
    return gain;
}

void scale(FillGain& gain, double factor)
{
    for (double& height : gain.height) {
        height *= factor;
    }
    for (double& slope : gain.rim_slope) {
        slope *= factor;
    }
    gain.pressure *= factor;
}

void check(const std::vector<PlanarMesh>& meshes, const std::vector<CapillarySurface>& fields,
           const SolveOptions& options)
{
    options.validate();
    requireRefillable(options);
    if (meshes.empty() || meshes.size() != fields.size()) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("fields must have {} entries, one per mesh, not {}", meshes.size(), fields.size()));
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (fields[k].vertices.size() != meshes[k].vertices.size()) {
            throw Error(ErrorCode::InvalidArgument, "field " + std::to_string(k) + " does not belong to its mesh");
        }
    }
}

}  // namespace

void FillRange::validate() const
{
    if (!(min >= 0.0 && min <= 1.0 && max >= 1.0 && min < max && std::isfinite(max))) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("fill_range {} to {} must begin at 0 to 1, end at 1 or more, and not be empty",
                                numberText(min), numberText(max)));
    }
}

void requireRefillable(const SolveOptions& options)
{
    if (options.no_penetration) {
        throw Error(
            ErrorCode::InvalidArgument,
            "no_penetration moves the edge of the dry ground with the volume, so it cannot be refilled; it must be "
            "off");
    }
}

std::vector<FillGain> gainsPerFill(const std::vector<PlanarMesh>& meshes, const std::vector<CapillarySurface>& fields,
                                   const SolveOptions& options)
{
    check(meshes, fields, options);
    if (options.model != Model::Linear) {
        throw Error(ErrorCode::InvalidArgument, "model must be linear: only it is affine in the volume");
    }
    const bool shared = options.fill.sharing == FillSharing::Total;
    std::vector<double> volumes;
    double total = 0.0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        volumes.push_back(liquidVolume(fields[k], options.ground));
        total += volumes.back();
        if (!shared && !(volumes.back() > 0.0)) {
            throw Error(ErrorCode::NoSuchDroplet,
                        fmt::format("droplet {} of {} holds {} m³; only a positive volume can be refilled", k + 1,
                                    meshes.size(), numberText(volumes.back())));
        }
    }
    if (!(total > 0.0)) {
        throw Error(ErrorCode::NoSuchDroplet,
                    "the droplets hold " + numberText(total) + " m³; only a positive volume can be refilled");
    }
    // On the level plane the field itself is the gain.
    const PlaneGravity gravity = planeGravity(options);
    std::vector<FillGain> gains(meshes.size());
    if (options.ground.flat() && gravity.along == Vec2{}) {
        for (std::size_t k = 0; k < meshes.size(); ++k) {
            gains[k] = gainOf(fields[k]);
        }
        return gains;
    }
    SolveOptions level = options;
    level.gravity = gravity.normal;
    level.tilt = 0.0;
    level.ground = {};
    level.volumes.clear();
    level.fill = {FillBy::Volume, shared ? total : total / static_cast<double>(meshes.size()), options.fill.sharing};
    Solution solution = solve(meshes, level);
    if (!solution.report.usable()) {
        throw Error(ErrorCode::NoSuchDroplet, "the change with the volume could not be solved for (residual " +
                                                  numberText(solution.report.residual) +
                                                  "); try another number of triangles");
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        gains[k] = gainOf(solution.droplets[k]);
        if (!shared) {
            scale(gains[k], volumes[k] / level.fill.amount);
        }
    }
    return gains;
}

}  // namespace droplet
