// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// Reads a scene from a TOML file; docs/cli/liquid2d.md describes its keys.
/// @param path   of the file; paths of masks in it are relative to its folder
/// @return       valid scene, whose emitters are free of walls
/// @throws Error InvalidInput, one line that begins with file and line: not TOML, unknown keys, values out of range,
///               masks that cannot be read, an emitter in a wall
FluidScene readFluidScene(const std::filesystem::path& path);

/// Scene from the text of a file, as readFluidScene() reads it.
/// @param text   TOML
/// @param path   of the file, for messages and as the place of masks
/// @throws Error as readFluidScene()
FluidScene parseFluidScene(std::string_view text, const std::filesystem::path& path);

/// Paths of the masks that a scene's file names, so that a run can protect them. A file that readFluidScene() would
/// refuse has none.
std::vector<std::filesystem::path> masksOfScene(const std::filesystem::path& path);

/// Region that an outline bounds.
/// @param outline  as trace() makes it: the origin is the middle of the picture
/// @param centre   place of the picture's middle [m]
Region regionOf(const Outline& outline, Vec2 centre = {});

/// First wall, at rest, that covers a part of an emitter's opening.
/// @return  its index, or empty
std::optional<std::size_t> wallInOpening(const Emitter& emitter, const std::vector<Wall>& walls);

/// Checks that all emitters open into the free.
/// @param scene  valid
/// @throws Error InvalidInput, naming the emitter and the wall, counted from 1
void checkEmitters(const FluidScene& scene);

}  // namespace droplet
