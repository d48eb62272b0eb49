// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/object.h"
#include "droplet/render/render.h"
#include "droplet/render/stand_look.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// What files have of a look beyond StandLook.
struct LookImages {
    std::string colours;                ///< PNG or JPEG; "": none
    std::string normals;                ///< the same
    std::string finish;                 ///< the same
    std::string glows;                  ///< the same
    bool blends = false;                ///< the alpha of `colours` blends
    std::optional<double> cutoff = {};  ///< below this alpha of `colours` there is nothing
};

/// Object below droplets, with its looks.
struct ObjectStand {
    TexturedMesh mesh;                             ///< its triangles
    std::vector<StandLook> looks = {};             ///< of every material; or empty: the object is plain
    std::vector<std::uint32_t> materials = {};     ///< in `looks`, of every triangle; empty if `looks` is
    std::vector<LookImages> images = {};           ///< of every look, for files; or empty
    std::vector<std::string> material_names = {};  ///< of every material, from the file
    std::vector<Vec3> colours = {};                ///< of every vertex, as RenderOptions::stand_colours
    bool is_open = false;                          ///< whether the mesh has an edge with one triangle: its back is seen
    bool is_plain = false;                         ///< pictures show it plain: `looks` only tell where it is cut out
    std::vector<std::string> warnings = {};        ///< what its file has that pictures do not show, one line each

    /// Whether most of the object, by area, lets light pass.
    [[nodiscard]] bool isSeenThrough() const;

    /// Whether something is there at a uv of a triangle, which the alpha of a picture may cut out.
    [[nodiscard]] bool isThere(std::uint32_t triangle, Vec2 uv) const
    {
        return looks.empty() || looks[materials[triangle]].isThere(uv);
    }

    /// Light past the object itself.
    [[nodiscard]] StandOpenness openness() const;

    /// Shows the object in a picture: its mesh as the stand, its looks, the light that reaches it past itself, and
    /// behind glass the room.
    void showIn(RenderOptions& options) const;
};

/// What readObjectStand() reads of an object's materials.
enum class StandParts {
    All,   ///< their pictures, and colours of vertices
    Holes  ///< what the alpha of their pictures cuts out; the object is shown plain
};

/// Reads an object as readObject() does, with its materials: those of glTF, or of the .mtl that an OBJ names and that
/// lies beside it; without one the object is plain.
/// @throws Error  as readObject()
ObjectStand readObjectStand(const std::filesystem::path& path, const ObjectOptions& options = {},
                            StandParts parts = StandParts::All);

}  // namespace droplet
