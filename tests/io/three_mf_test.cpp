// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF files, read by assimp: parts with names and colours, all in one object.
#include "droplet/io/three_mf.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <assimp/Importer.hpp>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::pairOfDroplets;

std::string written(const Surface& surface, const ThreeMfOptions& options = {})
{
    std::ostringstream out;
    const std::uint64_t bytes = writeThreeMf(surface, out, options);
    EXPECT_TRUE(out.good());
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

/// Little-endian number.
std::size_t numberAt(const std::string& bytes, std::size_t at, std::size_t size)
{
    std::size_t value = 0;
    for (std::size_t k = size; k-- > 0;) {
        value = 256 * value + static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
}

/// File of a zip, inflated; its checksum and length are checked.
std::string fileOf(const std::string& zip, const std::string& name)
{
    const std::size_t end = zip.size() - 22;
    std::size_t at = numberAt(zip, end + 16, 4);
    for (std::size_t k = 0; k < numberAt(zip, end + 10, 2); ++k) {
        const std::size_t name_size = numberAt(zip, at + 28, 2);
        if (zip.substr(at + 46, name_size) == name) {
            std::string file(numberAt(zip, at + 24, 4), '\0');
            const std::size_t header = numberAt(zip, at + 42, 4);
            z_stream stream = {};
            EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
            stream.next_in = reinterpret_cast<Bytef*>(
                const_cast<char*>(zip.data() + header + 30 + name_size + numberAt(zip, header + 28, 2)));
            stream.avail_in = static_cast<uInt>(numberAt(zip, at + 20, 4));
            stream.next_out = reinterpret_cast<Bytef*>(file.data());
            stream.avail_out = static_cast<uInt>(file.size());
            EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END) << name;
            EXPECT_EQ(stream.avail_out, 0U) << name;
            inflateEnd(&stream);
            EXPECT_EQ(crc32_z(0, reinterpret_cast<const Bytef*>(file.data()), file.size()), numberAt(zip, at + 16, 4));
            return file;
        }
        at += 46 + name_size;
    }
    ADD_FAILURE() << name;
    return "";
}

std::size_t countOf(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

ThreeMfOptions blueAndRed(Nodes nodes)
{
    Look blue{.name = "ink & <water>", .colour = {0.0, 0.0, 1.0}};
    Look red{.name = "red", .colour = {0.2158605, 0.0, 0.0}};
    return {.material = Material::Water,
            .nodes = nodes,
            .droplets = {{.name = "left \"one\"", .look = blue}, {.name = "right", .look = red}}};
}

TEST(ThreeMf, HasOneObjectWithAPartForEveryLook)
{
    const std::string zip = written(pairOfDroplets(), blueAndRed(Nodes::One));
    const std::string model = fileOf(zip, "3D/3dmodel.model");
    EXPECT_EQ(countOf(model, "<item "), 1U);
    EXPECT_EQ(countOf(model, "<component "), 2U);
    EXPECT_EQ(countOf(model, "<base name=\"ink &amp; &lt;water>\" displaycolor=\"#0000FF\"/>"), 1U);
    EXPECT_EQ(countOf(model, "<base name=\"red\" displaycolor=\"#800000\"/>"), 1U);
    EXPECT_EQ(countOf(model, "name=\"droplet red\""), 1U);
    EXPECT_EQ(countOf(model, "unit=\"millimeter\""), 1U);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(zip.data(), zip.size(), 0, "3mf");
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    EXPECT_EQ(scene->mNumMeshes, 2U);
    std::size_t triangles = 0;
    for (unsigned k = 0; k < scene->mNumMeshes; ++k) {
        triangles += scene->mMeshes[k]->mNumFaces;
    }
    EXPECT_EQ(triangles, pairOfDroplets().triangles.size());
}

TEST(ThreeMf, EveryDropletIsAPartWithItsName)
{
    const std::string model = fileOf(written(pairOfDroplets(), blueAndRed(Nodes::Each)), "3D/3dmodel.model");
    EXPECT_EQ(countOf(model, "name=\"left &quot;one&quot;\" type=\"model\" pid=\"1\" pindex=\"0\""), 1U);
    EXPECT_EQ(countOf(model, "name=\"right\" type=\"model\" pid=\"1\" pindex=\"1\""), 1U);
}

/// Copies on the rim have one vertex, so that slicers see a closed part.
TEST(ThreeMf, PartsAreWelded)
{
    const Surface surface = testing::roundDroplet({.outer = 3e-3, .rings = 4, .segments = 16});
    const std::string model = fileOf(written(surface), "3D/3dmodel.model");
    EXPECT_EQ(countOf(model, "<triangle "), surface.triangles.size());
    EXPECT_EQ(countOf(model, "<vertex "), 2U + surface.triangles.size() / 2) << "Euler's formula of a sphere";
}

TEST(ThreeMf, APackageNamesItsParts)
{
    const std::string zip = written(pairOfDroplets());
    EXPECT_EQ(countOf(fileOf(zip, "[Content_Types].xml"), "Extension=\"model\""), 1U);
    EXPECT_EQ(countOf(fileOf(zip, "_rels/.rels"), "Target=\"/3D/3dmodel.model\""), 1U);
    EXPECT_EQ(zip, written(pairOfDroplets()));
}

TEST(ThreeMf, WithoutLiquidNothingIsBuilt)
{
    const std::string model = fileOf(written(Surface()), "3D/3dmodel.model");
    EXPECT_EQ(countOf(model, "<object"), 0U);
    EXPECT_EQ(countOf(model, "<build/>"), 1U);
}

TEST(ThreeMf, RefusesWhatDoesNotFit)
{
    std::ostringstream out;
    EXPECT_THROW(writeThreeMf(pairOfDroplets(), out, {.nodes = Nodes::Each}), Error);
    ThreeMfOptions one = blueAndRed(Nodes::One);
    one.droplets.pop_back();
    EXPECT_THROW(writeThreeMf(pairOfDroplets(), out, one), Error);
    EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace droplet
