// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/surface/material.h"
#include "droplet/surface/texture_place.h"
#include "file_bytes.h"

namespace droplet {

/// Picture that a file names.
struct FileTexture {
    Bytes image = {};  ///< encoded; or empty
    std::string name;  ///< for messages
    TexturePlace place = {};
    std::string fault;  ///< why it is not, or not wholly, as the file wants it; or empty
};

/// Brightest light of a material's own that is read.
inline constexpr double kMaxGlow = 1e6;

/// Look of triangles in a file.
struct FileMaterial {
    Look look;
    double opacity = 1.0;
    bool blends = false;                         ///< the alpha of its picture blends it with what is behind
    std::optional<double> cutoff = {};           ///< below this alpha of its picture there is nothing
    bool refracts = false;                       ///< light enters its matter; false: a thin wall
    std::optional<double> thickness = {};        ///< of that matter [m]; empty: unknown
    std::optional<Attenuation> absorption = {};  ///< in it
    FileTexture colours;                         ///< its colours multiply the look's
    FileTexture normals;                         ///< directions in tangent space, as in glTF
    double relief = 1.0;                         ///< factor on the parts of these along the surface
    FileTexture finish;                          ///< its green multiplies the roughness, its blue the metal
    Vec3 glow;                                   ///< light of its own, as in StandLook
    FileTexture glows;                           ///< its colours multiply the glow
    FileTexture coverage;  ///< its alpha, or levels if it has none, are the share that is there; alpha blends
};

/// What stands for a material of which nothing is known: grey and matt.
FileMaterial plainMaterial();

/// Materials of an OBJ.
struct ObjMaterials {
    std::map<std::string, FileMaterial> by_name;
    std::vector<std::string> faults;  ///< of libraries that are not there or cannot be read
};

/// Materials that an OBJ names (Wavefront, "Advanced Visualizer Manual", appendix B1; Pr, Pm and norm as in Clara.io's
/// extension): Kd, Ke, Tf, d or Tr, illum 6 and 7 for matter that refracts, Ns, Pr, Pm, Ni, map_Kd, map_Ke, map_d,
/// norm, and map_Bump where that is a picture of directions, as Blender writes it. Files must lie beside the OBJ or in
/// folders there; of other paths the end is looked for there.
/// @param text    of the OBJ
/// @param folder  of the OBJ
ObjMaterials objMaterials(std::string_view text, const std::filesystem::path& folder);

/// Name of a material in `newmtl` or `usemtl`: without blanks around it, and without a comment after a blank.
std::string materialName(std::string_view written);

/// Text without UTF-8's byte order mark.
std::string_view withoutMark(std::string_view text);

/// Reads an image that a file names, if it lies beside that file or in a folder there.
FileTexture readTextureBeside(const std::filesystem::path& folder, const std::string& name);

}  // namespace droplet
