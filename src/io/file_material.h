// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "droplet/surface/material.h"
#include "file_bytes.h"

namespace droplet {

/// Look of triangles in a file.
struct FileMaterial {
    Look look;
    double opacity = 1.0;
    Bytes image = {};         ///< encoded picture whose colours multiply the look's; or empty
    std::string image_fault;  ///< why it could not be read; or empty
};

/// What stands for a material of which nothing is known: grey and matt.
FileMaterial plainMaterial();

/// Materials that an OBJ names (Wavefront, "Advanced Visualizer Manual", appendix B1; Pr and Pm as in Clara.io's
/// extension): Kd, d or Tr, Ns, Pr, Pm, Ni, and map_Kd without options. Files must lie beside the OBJ or in folders
/// there.
/// @param text    of the OBJ
/// @param folder  of the OBJ
/// @return        by name; files that cannot be read leave theirs out
std::map<std::string, FileMaterial> objMaterials(std::string_view text, const std::filesystem::path& folder);

/// Bytes of an image that a file names, if it lies beside that file or in a folder there.
void readImageBeside(const std::filesystem::path& folder, const std::string& name, FileMaterial& material);

}  // namespace droplet
