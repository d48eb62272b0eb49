// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/droplet_meshes.h"

#include <algorithm>
#include <utility>

#include "io/gltf_model.h"

namespace droplet {

int addMesh(tinygltf::Model& model, const DropletMesh& mesh, const char* name, int material)
{
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    primitive.attributes["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, mesh.positions.size());
    addBounds(model.accessors.back(), mesh.positions);
    primitive.attributes["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, mesh.normals.size());
    if (!mesh.uvs.empty()) {
        primitive.attributes["TEXCOORD_0"] = addVertexArray(model, TINYGLTF_TYPE_VEC2, mesh.uvs.size());
    }
    primitive.indices = addIndices(model, mesh.triangles.size(), mesh.positions.size());
    tinygltf::Mesh added;
    added.name = name;
    added.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(added));
    return static_cast<int>(model.meshes.size()) - 1;
}

void writeMesh(const DropletMesh& mesh, ByteStream& bytes)
{
    writeVectors(mesh.positions, bytes);
    writeVectors(mesh.normals, bytes);
    for (const Vec2& uv : mesh.uvs) {
        bytes.f32(uv.x, uv.y);
    }
    writeIndices(mesh.triangles, mesh.positions.size(), bytes);
    if (mesh.positions.size() < kVerticesBeyond16Bit && mesh.triangles.size() % 2 != 0) {
        bytes.u16(0);  // pads to the next word
    }
}

std::array<Vec3, 2> cornersOf(const std::vector<Vec3>& positions)
{
    std::array<Vec3, 2> corners{positions.front(), positions.front()};
    for (const Vec3& p : positions) {
        const auto& [low, high] = corners;
        corners = {Vec3{std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)},
                   Vec3{std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)}};
    }
    return corners;
}

}  // namespace droplet
