// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "droplet/io/object.h"
#include "io/file_mesh.h"

namespace droplet {

/// Mesh of an object, and the factor that it has on its file's lengths.
struct ObjectMesh {
    FileMesh mesh;
    double factor = 1.0;
};

/// Whether an object's y axis points up.
bool isYUp(const std::filesystem::path& path, const ObjectOptions& options);

/// Reads the mesh of an object, in the size that the options ask for.
/// @param parts  what is read; `y_up` is that of the options
/// @throws Error as readFileMesh(); InvalidArgument if the options are out of range; InvalidInput, naming the file: it
///               has no triangle with an area, or is too small or too large to compute with
ObjectMesh readObjectMesh(const std::filesystem::path& path, const ObjectOptions& options, FileMeshOptions parts);

}  // namespace droplet
