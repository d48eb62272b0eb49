// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"
#include "scene/scene.h"

namespace droplet {

/// What a surface looks like in a file, as in GltfOptions and UsdOptions.
struct SurfaceSceneOptions {
    Material material = Material::Water;
    bool closed = true;
    Nodes nodes = Nodes::One;
    const std::vector<FileDroplet>& droplets;
    const std::string& texture;
    std::span<const Surface> levels = {};
};

/// Scene of a surface: a mesh with the geometries of all looks, or with Nodes::Each a mesh and a node for each droplet.
/// Looks are in the order of their first droplets. Levels are nodes that take the places of these. A dry surface has an
/// empty scene.
/// @throws Error InvalidArgument if the surface is invalid or beyond float's range, or has parts that `droplets` lacks,
///               or Nodes::Each has no `droplets`, or levels have other parts
Scene sceneOf(const Surface& surface, const SurfaceSceneOptions& options);

/// Adds the scene of a surface to what is there, below a node. Its texture colours its own materials alone.
/// @throws Error as sceneOf()
void addSurface(Scene& scene, std::size_t parent, const Surface& surface, const SurfaceSceneOptions& options);

/// Vertices of a surface, with its triangles in a material.
/// @throws Error InvalidArgument beyond float's range
SceneGeometry geometryOf(const Surface& surface, std::size_t material);

}  // namespace droplet
