// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <span>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/dew.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/scene/format.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// How a file has many droplets.
enum class Instancing {
    Auto,   ///< None up to 20 000 droplets, else Gpu, or Nodes in USD
    None,   ///< one mesh of all droplets
    Nodes,  ///< a node for each droplet; droplets of a kind share a mesh
    Gpu,    ///< glTF's EXT_mesh_gpu_instancing, which three.js and Blender from 3.6 on read
};

/// Name for files: auto, none, nodes, gpu.
const char* name(Instancing instancing);

/// Triangles of droplets: from 64 of small ones to 352 of large ones in Medium.
enum class DewDetail {
    Low,     ///< 64, of those over 2.5 mm 208
    Medium,  ///< 64 below 0.4 mm, 168 below 1.2 mm, else 352: the cube root of the volume counts
    High,    ///< a step more
};

/// Form of a file of droplets on an object.
struct DewFile {
    AnimatedFile file = {};                    ///< glTF or USD
    Material material = Material::Water;       ///< of the droplets
    Instancing instancing = Instancing::Auto;  ///< how droplets share meshes
    bool has_object = true;                    ///< whether the file has the object, too
};

/// DewOptions::extent of the meshes that DewModel has: those of large droplets are flat, and lean out on slopes.
/// @param bodies   their shapes; must outlive the result
/// @param gravity  in the object's frame [m/s²]
/// @param detail   of the meshes
std::function<DewExtent(double volume, Vec3 normal)> dewExtents(const DropletBodies& bodies, Vec3 gravity,
                                                                DewDetail detail = DewDetail::Medium);

/// Meshes of droplets at rest on an object.
///
/// Droplets of about the same size, slope and bend of the ground share a mesh of the capillary body; small ones have
/// few triangles. Where a shared mesh would stand off the object by over a twentieth of the contact radius, the droplet
/// gets a mesh of its own, which sits on it as seatedDroplets() does it. All are closed, and have their volume to 1 %.
/// Droplets that would have to grow to over 1.6 times their height, or lose volume, because the object bends too much
/// below them, are left out.
class DewModel {
public:
    /// @param terrain  the object
    /// @param samples  droplets at rest on it
    /// @param bodies   their shapes
    /// @param gravity  in the object's frame [m/s²]
    /// @param detail   of the meshes
    DewModel(const FlowTerrain& terrain, std::span<const FlowSample> samples, const DropletBodies& bodies, Vec3 gravity,
             DewDetail detail = DewDetail::Medium);
    ~DewModel();
    DewModel(DewModel&&) noexcept;             ///< Moves the meshes.
    DewModel& operator=(DewModel&&) noexcept;  ///< Moves the meshes.

    /// Numbers of the samples that have a mesh.
    [[nodiscard]] const std::vector<std::size_t>& shown() const;

    /// All droplets in one surface, in the object's frame.
    [[nodiscard]] Surface surface() const;

    /// All droplets for a picture.
    [[nodiscard]] SettledDroplets settled() const;

    /// How a file has the droplets: what Auto stands for, or what was asked for.
    [[nodiscard]] Instancing instancingIn(const DewFile& file) const;

    /// Writes the droplets as glTF or USD, metres, +Y up.
    /// @return         number of bytes written
    /// @throws Error   InvalidArgument if the form does not exist, or the file would be too large
    std::uint64_t write(const FlowObject& object, std::ostream& out, const DewFile& file = {}) const;

private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace droplet
