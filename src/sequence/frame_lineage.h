// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "sequence/followed_sheets.h"

namespace droplet {

/// Meshes as they were triangulated, before they were moved, and their bases, if surfaces are closed and the ground is
/// flat.
struct TriangulatedMeshes {
    std::vector<PlanarMesh> meshes;
    std::vector<PlanarMesh> bases;
};

struct FrameLineage {
    std::shared_ptr<const TriangulatedMeshes> first;  ///< meshes in which the frame's connections were made
    std::vector<PlanarMesh> bases;                    ///< bases, if surfaces are closed and the ground is flat
    SheetOrigins sheets;                              ///< of droplets that hang over their rims; or empty
    double edge = 0.0;                                ///< length of an edge at the start of a run of frames [m]
    bool are_even = true;                             ///< whether all triangles have about the same size
    std::size_t next_id = 0;                          ///< next unused id
    std::optional<double> reservoir;  ///< total volume with VolumeMode::Total, once there was liquid [m³]
};

}  // namespace droplet
