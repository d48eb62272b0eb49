// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "droplet/render/object_stand.h"
#include "droplet/render/stand_look.h"
#include "io/file_mesh.h"

namespace droplet {

/// Looks of an object's materials, each in two forms.
struct TakenLooks {
    std::vector<StandLook> looks;    ///< for pictures
    std::vector<LookImages> images;  ///< for files
};

/// Decodes the looks of a file's mesh. Its colours of vertices become linear; where no material is known they get white
/// ones.
/// @param mesh      read with FileMeshOptions::looks
/// @param name      of the file, for warnings
/// @param warnings  get a line for all that cannot be shown
TakenLooks takeLooks(FileMesh& mesh, const std::string& name, std::vector<std::string>& warnings);

}  // namespace droplet
