// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/image/height_map.h"
#include "droplet/mask/mask.h"

namespace droplet {

/// Properties of the faces of one material.
struct MaterialProperties {
    std::optional<double> roughness = {};      ///< height of bumps [m], ≥ 0; empty: as without the material
    std::optional<double> friction = {};       ///< factor on viscous friction, ≥ 0
    std::optional<double> hysteresis = {};     ///< factor on the retention by hysteresis, ≥ 0
    std::optional<double> contact_angle = {};  ///< [rad], from 1° to 179°
};

/// Options of faceProperties. Pictures lie over the object's uv and repeat beyond its unit square; black is 0, white
/// the maximum.
struct FacePropertyOptions {
    std::optional<HeightMap> roughness_picture = {};           ///< replaces `roughness`
    double max_roughness = 1e-4;                               ///< at white [m], ≥ 0
    std::optional<HeightMap> friction_picture = {};            ///< factor on viscous friction
    double max_friction = 1.0;                                 ///< at white, ≥ 0
    double contact_angle = Wetting{}.contact_angle;            ///< of faces without another one [rad]
    double roughness = 0.0;                                    ///< of faces without another one [m], ≥ 0
    std::map<std::string, MaterialProperties> materials = {};  ///< by name; they replace the pictures
};

/// Properties of all faces of a surface.
///
/// A face has the mean of a picture over its triangle in uv. Properties that no option sets stay empty.
/// @param object   the surface's mesh
/// @param surface  its faces
/// @param options  pictures and materials
/// @throws Error   InvalidArgument: a picture, but no uv; a material that the object does not have, with the names of
///                 those that it has; a value out of its range
FaceProperties faceProperties(const FlowObject& object, const FlowSurface& surface, const FacePropertyOptions& options);

/// Mean of a picture over the triangle of every face in uv, with levels limited to 0 … 1.
/// @param picture  over the object's uv
/// @param object   the surface's mesh
/// @param surface  its faces
/// @throws Error   InvalidArgument if the object has no uv
std::vector<double> meansOverFaces(const HeightMap& picture, const FlowObject& object, const FlowSurface& surface);

/// Whether the alpha of a picture cuts something out of an object.
bool hasHoles(const FlowObject& object);

/// A surface without the faces that the alpha of the object's pictures cuts out as a whole: droplets find no place
/// there, and fall off at the edge. What is cut has an alpha below the look's cutoff, or of 0 without one.
/// @param surface  of the object; the finer its faces, the nearer its edge is to that of the pictures
/// @param object   with texture coordinates, if hasHoles()
/// @throws Error   InvalidInput if nothing is left
FlowSurface withoutHoles(const FlowSurface& surface, const FlowObject& object);

/// Coverage of a mask at points of a surface, 0 … 1, for ScatterOptions::coverage. The mask lies over the object's uv
/// and repeats beyond its unit square.
/// @param mask     valid; like the others, it must outlive the result
/// @param object   the surface's mesh
/// @param surface  its faces
/// @throws Error   InvalidArgument if the object has no uv
std::function<double(const FlowTerrain::Point&)> coverageOver(const Mask& mask, const FlowObject& object,
                                                              const FlowSurface& surface);

/// The vertices' weights at points of a surface, 0 … 1, linear over each triangle, for ScatterOptions::coverage.
/// @param object   the surface's mesh; like the other, it must outlive the result
/// @param surface  its faces
/// @throws Error   InvalidArgument if the object has no weights
std::function<double(const FlowTerrain::Point&)> weightsOver(const FlowObject& object, const FlowSurface& surface);

}  // namespace droplet
