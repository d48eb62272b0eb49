// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "support/pieces.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::kExtent;
using testing::Pieces;
using testing::roundDroplet;
using testing::withContactAngles;

std::string written(const Surface& surface, const GltfOptions& options = {})
{
    std::ostringstream out;
    const std::uint64_t bytes = writeGltf(surface, out, options);
    EXPECT_TRUE(out.good());
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

tinygltf::Model parsed(const std::string& bytes, bool binary)
{
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const auto size = static_cast<unsigned>(bytes.size());
    const bool ok = binary ? reader.LoadBinaryFromMemory(&model, &error, &warning,
                                                         reinterpret_cast<const unsigned char*>(bytes.data()), size)
                           : reader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
    EXPECT_TRUE(ok) << error;
    EXPECT_EQ(error, "");
    EXPECT_EQ(warning, "");
    return model;
}

template <class Number>
std::vector<Number> numbersOf(const tinygltf::Model& model, int accessor_index)
{
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    const auto per_element =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    EXPECT_EQ(view.byteLength, accessor.count * per_element * sizeof(Number));
    EXPECT_EQ((view.byteOffset + accessor.byteOffset) % sizeof(Number), 0U);
    std::vector<Number> numbers(accessor.count * per_element);
    std::memcpy(numbers.data(), model.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset,
                numbers.size() * sizeof(Number));
    return numbers;
}

const tinygltf::Primitive& onlyPrimitive(const tinygltf::Model& model)
{
    EXPECT_EQ(model.scenes.size(), 1U);
    EXPECT_EQ(model.defaultScene, 0);
    EXPECT_EQ(model.scenes.at(0).nodes, std::vector<int>{0});
    EXPECT_EQ(model.nodes.size(), 1U);
    EXPECT_EQ(model.nodes.at(0).name, "droplet");
    EXPECT_EQ(model.nodes.at(0).mesh, 0);
    EXPECT_EQ(model.meshes.size(), 1U);
    EXPECT_EQ(model.meshes.at(0).primitives.size(), 1U);
    return model.meshes.at(0).primitives.at(0);
}

// Strip of triangles with a given number of vertices, none of them welded.
Surface strip(std::uint32_t vertices)
{
    Surface surface;
    surface.mean_height = 1e-3;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        surface.vertices.push_back({1e-6 * i, i % 2 == 0 ? 0.0 : 1e-3, 0.0});
        surface.normals.push_back({0.0, 0.0, 1.0});
        surface.uvs.push_back({0.25, 0.75});
        surface.weld.push_back(i);
    }
    for (std::uint32_t i = 0; i + 2 < vertices; ++i) {
        surface.triangles.push_back(i % 2 == 0 ? Triangle{i, i + 2, i + 1} : Triangle{i, i + 1, i + 2});
    }
    return surface;
}

class Gltf : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(BinaryOrNot, Gltf, ::testing::Bool(),
                         [](const auto& run) { return run.param ? "Glb" : "Gltf"; });

TEST_P(Gltf, HoldsTheRefillAsAMorphTargetThatShowsEveryFill)
{
    Surface surface = testing::withRefill(withContactAngles(roundDroplet({.inner = 1e-3})));
    surface.refill->min = 0.25;
    const tinygltf::Model model = parsed(written(surface, {.binary = GetParam()}), GetParam());
    const tinygltf::Mesh& mesh = model.meshes.at(0);
    EXPECT_EQ(mesh.weights, std::vector<double>{0.0});
    ASSERT_EQ(mesh.extras.Get("targetNames").ArrayLen(), 1U);
    EXPECT_EQ(mesh.extras.Get("targetNames").Get(0).Get<std::string>(), "volume");
    ASSERT_EQ(mesh.extras.Get("fill_range").ArrayLen(), 2U);
    EXPECT_EQ(mesh.extras.Get("fill_range").Get(0).GetNumberAsDouble(), 0.25);
    EXPECT_EQ(mesh.extras.Get("fill_range").Get(1).GetNumberAsDouble(), 2.0);
    const tinygltf::Primitive& primitive = onlyPrimitive(model);
    ASSERT_EQ(primitive.targets.size(), 1U);
    const auto vertices = numbersOf<float>(model, primitive.attributes.at("POSITION"));
    const auto normals = numbersOf<float>(model, primitive.attributes.at("NORMAL"));
    const auto moves = numbersOf<float>(model, primitive.targets[0].at("POSITION"));
    const auto turns = numbersOf<float>(model, primitive.targets[0].at("NORMAL"));
    ASSERT_EQ(moves.size(), vertices.size());
    ASSERT_EQ(turns.size(), vertices.size());
    for (const double fill : {0.25, 1.0, 1.5, 2.0}) {
        const Surface wanted = refilled(surface, fill);
        for (std::size_t v = 0; v < wanted.vertices.size(); ++v) {
            const auto shown = [&](const std::vector<float>& base, const std::vector<float>& change, std::size_t k) {
                return base[3 * v + k] + (fill - 1) * change[3 * v + k];
            };
            EXPECT_NEAR(shown(vertices, moves, 0), wanted.vertices[v].x, 1e-9);
            EXPECT_NEAR(shown(vertices, moves, 1), wanted.vertices[v].z, 1e-9);
            EXPECT_NEAR(shown(vertices, moves, 2), -wanted.vertices[v].y, 1e-9);
            const Vec3 turned{shown(normals, turns, 0), -shown(normals, turns, 2), shown(normals, turns, 1)};
            EXPECT_LT(length((1.0 / length(turned)) * turned - wanted.normals[v]), 1e-6);
        }
    }
    const tinygltf::Accessor& bounds =
        model.accessors.at(static_cast<std::size_t>(primitive.targets[0].at("POSITION")));
    EXPECT_EQ(bounds.minValues, (std::vector<double>{0.0, 0.0, 0.0}));
    EXPECT_EQ(bounds.maxValues.at(1), static_cast<double>(*std::max_element(moves.begin(), moves.end())));
}

TEST_P(Gltf, WithoutARefillThereIsNoMorphTarget)
{
    const tinygltf::Model model = parsed(written(roundDroplet(), {.binary = GetParam()}), GetParam());
    EXPECT_TRUE(onlyPrimitive(model).targets.empty());
    EXPECT_TRUE(model.meshes.at(0).weights.empty());
    EXPECT_FALSE(model.meshes.at(0).extras.IsObject());
}

TEST_P(Gltf, HoldsTheSurfaceAsFloatsWithYUp)
{
    const Surface surface = roundDroplet({.inner = 1e-3, .centre = {2e-3, -3e-3}});
    const tinygltf::Model model = parsed(written(surface, {.binary = GetParam()}), GetParam());
    const tinygltf::Primitive& primitive = onlyPrimitive(model);
    EXPECT_EQ(primitive.mode, TINYGLTF_MODE_TRIANGLES);
    ASSERT_EQ(primitive.attributes.size(), 3U);
    const auto vertices = numbersOf<float>(model, primitive.attributes.at("POSITION"));
    const auto normals = numbersOf<float>(model, primitive.attributes.at("NORMAL"));
    const auto uvs = numbersOf<float>(model, primitive.attributes.at("TEXCOORD_0"));
    const auto indices = numbersOf<std::uint16_t>(model, primitive.indices);
    ASSERT_EQ(vertices.size(), 3 * surface.vertices.size());
    ASSERT_EQ(normals.size(), 3 * surface.vertices.size());
    ASSERT_EQ(uvs.size(), 2 * surface.vertices.size());
    ASSERT_EQ(indices.size(), 3 * surface.triangles.size());
    for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
        const Vec3 at = surface.vertices[i];
        EXPECT_EQ(vertices[3 * i], static_cast<float>(at.x));
        EXPECT_EQ(vertices[3 * i + 1], static_cast<float>(at.z));
        EXPECT_EQ(vertices[3 * i + 2], static_cast<float>(-at.y));
        const Vec3 normal = surface.normals[i];
        EXPECT_EQ(normals[3 * i], static_cast<float>(normal.x));
        EXPECT_EQ(normals[3 * i + 1], static_cast<float>(normal.z));
        EXPECT_EQ(normals[3 * i + 2], static_cast<float>(-normal.y));
        EXPECT_NEAR(std::hypot(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), 1.0, 2e-7);
        EXPECT_EQ(uvs[2 * i], static_cast<float>(surface.uvs[i].x));
        EXPECT_EQ(uvs[2 * i + 1], static_cast<float>(surface.uvs[i].y));
    }
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(indices[3 * i + k], surface.triangles[i][k]);
        }
    }
}

TEST_P(Gltf, ContactAnglesAreDegreesInACustomAttribute)
{
    const Surface surface = withContactAngles(roundDroplet());
    const tinygltf::Model model = parsed(written(surface, {.binary = GetParam()}), GetParam());
    const tinygltf::Primitive& primitive = onlyPrimitive(model);
    ASSERT_EQ(primitive.attributes.size(), 4U);
    const int index = primitive.attributes.at("_CONTACT_ANGLE");
    EXPECT_EQ(model.accessors.at(static_cast<std::size_t>(index)).type, TINYGLTF_TYPE_SCALAR);
    const auto angles = numbersOf<float>(model, index);
    ASSERT_EQ(angles.size(), surface.vertices.size());
    std::size_t on_rim = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        on_rim += angles[i] > 0.0F ? 1 : 0;
        EXPECT_EQ(angles[i], static_cast<float>(surface.contact_angle[i] * 180.0 / 3.14159265358979323846));
    }
    EXPECT_EQ(on_rim, 12U);
    // All other data is the same as without contact angles.
    const tinygltf::Model without = parsed(written(roundDroplet(), {.binary = GetParam()}), GetParam());
    EXPECT_EQ(numbersOf<float>(model, primitive.attributes.at("POSITION")),
              numbersOf<float>(without, onlyPrimitive(without).attributes.at("POSITION")));
    EXPECT_EQ(numbersOf<std::uint16_t>(model, primitive.indices),
              numbersOf<std::uint16_t>(without, onlyPrimitive(without).indices));
}

TEST_P(Gltf, TheImagesLowerEdgePointsToPositiveZ)
{
    const tinygltf::Model model = parsed(written(roundDroplet(), {.binary = GetParam()}), GetParam());
    const tinygltf::Primitive& primitive = onlyPrimitive(model);
    const auto vertices = numbersOf<float>(model, primitive.attributes.at("POSITION"));
    const auto uvs = numbersOf<float>(model, primitive.attributes.at("TEXCOORD_0"));
    for (std::size_t i = 0; i < uvs.size() / 2; ++i) {
        EXPECT_NEAR(uvs[2 * i], 0.5 + vertices[3 * i] / kExtent, 1e-6);
        EXPECT_NEAR(uvs[2 * i + 1], 0.5 + vertices[3 * i + 2] / kExtent, 1e-6);
    }
}

TEST_P(Gltf, BoundsArePreciselyThoseOfTheFloats)
{
    const tinygltf::Model model =
        parsed(written(roundDroplet({.outer = 1.0 / 300.0}), {.binary = GetParam()}), GetParam());
    const tinygltf::Primitive& primitive = onlyPrimitive(model);
    const int index = primitive.attributes.at("POSITION");
    const auto vertices = numbersOf<float>(model, index);
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
    ASSERT_EQ(accessor.minValues.size(), 3U);
    ASSERT_EQ(accessor.maxValues.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        float low = vertices[k];
        float high = vertices[k];
        for (std::size_t i = k; i < vertices.size(); i += 3) {
            low = std::min(low, vertices[i]);
            high = std::max(high, vertices[i]);
        }
        EXPECT_EQ(accessor.minValues[k], static_cast<double>(low));
        EXPECT_EQ(accessor.maxValues[k], static_cast<double>(high));
    }
}

TEST_P(Gltf, RequiresNoExtension)
{
    for (const Material material : materials()) {
        const tinygltf::Model model =
            parsed(written(roundDroplet(), {.binary = GetParam(), .material = material}), GetParam());
        EXPECT_THAT(model.extensionsRequired, ::testing::IsEmpty());
        ASSERT_EQ(model.materials.size(), 1U);
        EXPECT_EQ(model.materials[0].name, lookOf(material).name);
        EXPECT_EQ(onlyPrimitive(model).material, 0);
        std::vector<std::string> used;
        for (const auto& [extension, value] : model.materials[0].extensions) {
            used.push_back(extension);
        }
        EXPECT_THAT(model.extensionsUsed, ::testing::UnorderedElementsAreArray(used));
    }
}

TEST_P(Gltf, TheSameSurfaceGivesTheSameBytes)
{
    const GltfOptions options{.binary = GetParam(), .material = Material::Ink};
    EXPECT_EQ(written(roundDroplet(), options), written(roundDroplet(), options));
}

TEST_P(Gltf, IsByteForByteWhatTinygltfWrites)
{
    for (const Surface& surface : {roundDroplet(), withContactAngles(roundDroplet()), strip(5), strip(70'000)}) {
        for (const Material material : materials()) {
            const std::string bytes = written(surface, {.binary = GetParam(), .material = material});
            const tinygltf::Model model = parsed(bytes, GetParam());
            std::ostringstream again;
            tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, again, true, GetParam());
            EXPECT_TRUE(bytes == again.str()) << lookOf(material).name;
        }
    }
}

TEST_P(Gltf, IsWrittenInPieces)
{
    const Surface surface = strip(70'000);
    Pieces pieces;
    std::ostream out(&pieces);
    writeGltf(surface, out, {.binary = GetParam()});
    EXPECT_GT(pieces.taken().size(), 3'000'000U);
    EXPECT_LE(pieces.largest(), 65'536U);
}

TEST_P(Gltf, NamesItsGeneratorButNoTime)
{
    const tinygltf::Model model = parsed(written(roundDroplet(), {.binary = GetParam()}), GetParam());
    EXPECT_EQ(model.asset.version, "2.0");
    EXPECT_EQ(model.asset.generator, std::string("droplet-shape ") + kVersion);
    EXPECT_EQ(model.asset.extras.Type(), tinygltf::NULL_TYPE);
}

TEST_P(Gltf, SixteenBitIndicesEndBelow65535Vertices)
{
    const tinygltf::Model small = parsed(written(strip(65534), {.binary = GetParam()}), GetParam());
    const auto narrow = numbersOf<std::uint16_t>(small, onlyPrimitive(small).indices);
    EXPECT_EQ(*std::max_element(narrow.begin(), narrow.end()), 65533);
    const tinygltf::Model large = parsed(written(strip(65535), {.binary = GetParam()}), GetParam());
    const auto wide = numbersOf<std::uint32_t>(large, onlyPrimitive(large).indices);
    EXPECT_EQ(*std::max_element(wide.begin(), wide.end()), 65534U);
}

TEST_P(Gltf, RefusesNumbersThatAreNotFinite)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<std::function<void(Surface&)>> spoils = {
        [](Surface& s) { s.vertices[3].z = kNan; },
        [](Surface& s) { s.vertices[3].z = std::numeric_limits<double>::infinity(); },
        [](Surface& s) { s.vertices[0].x = 1e39; },  // finite, but not as a float
        [](Surface& s) { s.normals[3].x = kNan; },
        [](Surface& s) { s.uvs[3].y = kNan; },
        [](Surface& s) { s.uvs.back().y = -1e39; },
        [](Surface& s) { s.mean_height = kNan; },
        [](Surface& s) { s.contact_angle[3] = std::numeric_limits<float>::quiet_NaN(); },
        [](Surface& s) { s.contact_angle.pop_back(); },
    };
    for (std::size_t i = 0; i < spoils.size(); ++i) {
        Surface surface = withContactAngles(roundDroplet());
        spoils[i](surface);
        std::ostringstream out;
        try {
            writeGltf(surface, out, {.binary = GetParam()});
            ADD_FAILURE() << "accepted spoil " << i;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        }
        EXPECT_EQ(out.str(), "");
    }
}

TEST_P(Gltf, RefusesFilesOf2GiB)
{
    // A vertex has 32 bytes, 42.7 in base64: this number just exceeds the limit.
    const std::size_t vertices = GetParam() ? 67'200'000 : 50'400'000;
    const long wanted = static_cast<long>(vertices * sizeof(Vec3) / 1024) * 5 / 4;
    if (::sysconf(_SC_AVPHYS_PAGES) * (::sysconf(_SC_PAGESIZE) / 1024) < wanted) {
        GTEST_SKIP() << "too little memory for a surface this large";
    }
    Surface surface = roundDroplet();
    surface.vertices.resize(vertices);
    const auto complaint = [&] {
        std::ostringstream out;
        try {
            writeGltf(surface, out, {.binary = GetParam()});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(complaint(), HasSubstr("2 GiB"));
    surface.vertices.resize(vertices - 200'000);
    EXPECT_THAT(complaint(), HasSubstr("normals"));  // the next error
}

TEST(Glb, IsAHeaderAndTwoPaddedChunks)
{
    const std::string bytes = written(withContactAngles(roundDroplet()), {.material = Material::Honey});
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), bytes.size());
    const std::uint32_t json = word(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(json % 4, 0U);
    EXPECT_EQ(word(20 + json) + 28 + json, bytes.size());
    EXPECT_EQ(bytes.substr(24 + json, 4), std::string("BIN\0", 4));
    // The check of the file's size assumes this.
    EXPECT_LT(json + 28, 4096U);
}

TEST(GltfText, HoldsTheSameBufferAsTheBinary)
{
    const Surface surface = roundDroplet({.inner = 1e-3});
    const std::string text = written(surface, {.binary = false, .material = Material::Honey});
    EXPECT_THAT(text, HasSubstr("\"uri\": \"data:application/octet-stream;base64,"));
    const tinygltf::Model from_text = parsed(text, false);
    const tinygltf::Model from_binary = parsed(written(surface, {.material = Material::Honey}), true);
    EXPECT_EQ(from_text.buffers.at(0).data, from_binary.buffers.at(0).data);
    EXPECT_EQ(from_text.accessors, from_binary.accessors);
    EXPECT_EQ(from_text.materials, from_binary.materials);
}

// Base64 pads lengths that are not multiples of three bytes.
TEST(GltfText, HoldsBuffersOfAnyLength)
{
    std::vector<std::size_t> fills(3);
    for (std::uint32_t vertices = 3; vertices < 12; ++vertices) {
        const std::string text = written(strip(vertices), {.binary = false});
        const tinygltf::Model from_text = parsed(text, false);
        EXPECT_EQ(from_text.buffers.at(0).data, parsed(written(strip(vertices)), true).buffers.at(0).data);
        const auto end = text.find('"', text.find("base64,"));
        ++fills.at(
            static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '=')));
    }
    EXPECT_THAT(fills, ::testing::Each(3));
}

class GltfMaterial : public ::testing::Test {
protected:
    static tinygltf::Material made(Material material, bool closed)
    {
        tinygltf::Model model = parsed(
            written(roundDroplet({.height = 2e-3, .open = !closed}), {.material = material, .closed = closed}), true);
        EXPECT_EQ(model.materials.size(), 1U);
        EXPECT_EQ(model.materials.at(0).alphaMode, "OPAQUE");
        EXPECT_FALSE(model.materials.at(0).doubleSided);
        return model.materials.at(0);
    }

    static double number(const tinygltf::Material& material, const std::string& extension, const std::string& key)
    {
        const tinygltf::Value& value = material.extensions.at("KHR_materials_" + extension).Get(key);
        EXPECT_TRUE(value.IsNumber());
        return value.GetNumberAsDouble();
    }

    static bool uses(const tinygltf::Material& material, const std::string& extension)
    {
        return material.extensions.count("KHR_materials_" + extension) == 1;
    }
};

TEST_F(GltfMaterial, WaterIsClear)
{
    const tinygltf::Material water = made(Material::Water, true);
    EXPECT_EQ(water.pbrMetallicRoughness.metallicFactor, 0.0);
    EXPECT_EQ(water.pbrMetallicRoughness.roughnessFactor, 0.0);
    EXPECT_THAT(water.pbrMetallicRoughness.baseColorFactor, ::testing::Each(1.0));
    EXPECT_EQ(number(water, "transmission", "transmissionFactor"), 1.0);
    EXPECT_EQ(number(water, "ior", "ior"), 1.333);
    EXPECT_EQ(number(water, "volume", "thicknessFactor"), 1e-3);
    EXPECT_FALSE(water.extensions.at("KHR_materials_volume").Has("attenuationColor"));
    EXPECT_FALSE(water.extensions.at("KHR_materials_volume").Has("attenuationDistance"));
}

TEST_F(GltfMaterial, ColouredLiquidsDeepenWithTheirHeight)
{
    for (const Material material : {Material::Ink, Material::Honey}) {
        const tinygltf::Material liquid = made(material, true);
        EXPECT_THAT(liquid.pbrMetallicRoughness.baseColorFactor, ::testing::Each(1.0));
        EXPECT_EQ(number(liquid, "transmission", "transmissionFactor"), 1.0);
        EXPECT_EQ(number(liquid, "volume", "thicknessFactor"), 1e-3);
        EXPECT_EQ(number(liquid, "volume", "attenuationDistance"), 2e-3);
        const tinygltf::Value& colour = liquid.extensions.at("KHR_materials_volume").Get("attenuationColor");
        ASSERT_EQ(colour.ArrayLen(), 3U);
        const double red = colour.Get(0).GetNumberAsDouble();
        const double blue = colour.Get(2).GetNumberAsDouble();
        EXPECT_EQ(material == Material::Ink, blue > red);
    }
    EXPECT_EQ(number(made(Material::Ink, true), "ior", "ior"), 1.333);
    EXPECT_NEAR(number(made(Material::Honey, true), "ior", "ior"), 1.49, 5e-3);
}

TEST_F(GltfMaterial, AnOpenLiquidIsThinAndTinted)
{
    for (const Material material : {Material::Water, Material::Ink, Material::Honey}) {
        const tinygltf::Material open = made(material, false);
        EXPECT_FALSE(uses(open, "volume"));
        EXPECT_EQ(number(open, "transmission", "transmissionFactor"), 1.0);
        EXPECT_TRUE(uses(open, "ior"));
        const std::vector<double>& tint = open.pbrMetallicRoughness.baseColorFactor;
        ASSERT_EQ(tint.size(), 4U);
        EXPECT_EQ(tint[3], 1.0);
        if (material == Material::Water) {
            EXPECT_THAT(tint, ::testing::Each(1.0));
        } else {
            const tinygltf::Value colour =
                made(material, true).extensions.at("KHR_materials_volume").Get("attenuationColor");
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(tint[k], colour.Get(static_cast<int>(k)).GetNumberAsDouble());
            }
        }
    }
}

TEST_F(GltfMaterial, WithoutHeightThereIsNoVolume)
{
    Surface flat = roundDroplet();
    flat.mean_height = 0.0;
    const tinygltf::Model model = parsed(written(flat, {.material = Material::Ink}), true);
    EXPECT_FALSE(uses(model.materials.at(0), "volume"));
}

TEST_F(GltfMaterial, MercuryIsAMirror)
{
    const tinygltf::Material mercury = made(Material::Mercury, true);
    EXPECT_EQ(mercury.pbrMetallicRoughness.metallicFactor, 1.0);
    EXPECT_LT(mercury.pbrMetallicRoughness.roughnessFactor, 0.1);
    EXPECT_TRUE(mercury.extensions.empty());
}

TEST_F(GltfMaterial, PlainIsOpaqueGrey)
{
    const tinygltf::Material plain = made(Material::Plain, true);
    EXPECT_EQ(plain.pbrMetallicRoughness.metallicFactor, 0.0);
    EXPECT_GT(plain.pbrMetallicRoughness.roughnessFactor, 0.3);
    const std::vector<double>& colour = plain.pbrMetallicRoughness.baseColorFactor;
    EXPECT_EQ(colour[0], colour[1]);
    EXPECT_EQ(colour[1], colour[2]);
    EXPECT_TRUE(plain.extensions.empty());
}

// Light that passes the mean height down and up has the look's colour; what a cloudy liquid scatters is not white.
TEST_F(GltfMaterial, CloudyLiquidsHaveTheirColourOnBothWays)
{
    for (const Material material : {Material::Blood, Material::Gel, Material::Ice}) {
        const tinygltf::Material cloudy = made(material, true);
        const Look look = lookOf(material);
        EXPECT_EQ(number(cloudy, "transmission", "transmissionFactor"), look.transmission);
        const std::vector<double>& base = cloudy.pbrMetallicRoughness.baseColorFactor;
        const tinygltf::Value& absorbed = cloudy.extensions.at("KHR_materials_volume").Get("attenuationColor");
        const std::array colour{look.colour.x, look.colour.y, look.colour.z};
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(base[k] * absorbed.Get(static_cast<int>(k)).GetNumberAsDouble(), colour[k], 1e-12);
        }
        EXPECT_LT(*std::min_element(base.begin(), base.end()), 0.9);
    }
}

TEST_F(GltfMaterial, OilIsIridescent)
{
    const tinygltf::Material oil = made(Material::Oil, true);
    const ThinFilm film = lookOf(Material::Oil).film.value();
    EXPECT_EQ(number(oil, "iridescence", "iridescenceFactor"), 1.0);
    EXPECT_EQ(number(oil, "iridescence", "iridescenceIor"), film.ior);
    EXPECT_NEAR(number(oil, "iridescence", "iridescenceThicknessMaximum"), 1e9 * film.thickness, 1e-6);
    EXPECT_TRUE(uses(oil, "volume"));
    EXPECT_FALSE(uses(made(Material::Water, true), "iridescence"));
}

TEST(MaterialOf, IsTheLiquidsOwnOrWater)
{
    EXPECT_EQ(materialOf(liquidNamed("honey")), Material::Honey);
    EXPECT_EQ(materialOf(liquidNamed("mercury")), Material::Mercury);
    EXPECT_EQ(materialOf(liquidNamed("glycerol")), Material::Water);
    EXPECT_EQ(materialOf({"custom", 0.05, 900.0}), Material::Water);
}

TEST(MaterialNamed, KnowsAllLooksAndNoOther)
{
    std::string names;
    for (const Material material : materials()) {
        const std::string name = lookOf(material).name;
        EXPECT_EQ(materialNamed(name), material);
        names += (names.empty() ? "" : ", ") + name;
    }
    EXPECT_EQ(
        names,
        "water, ink, mercury, honey, plain, gel, enamel, glass, resin, oil, milk, lacquer, blood, gold, frosted, ice");
    for (const char* wrong : {"", "Water", "beer", "water "}) {
        try {
            materialNamed(wrong);
            ADD_FAILURE() << wrong;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_EQ(error.what(), "material is '" + std::string(wrong) + "', must be one of " + names);
        }
    }
}

std::vector<FileDroplet> redAndWater()
{
    Look red = lookOf(Material::Water);
    red.name = "red";
    red.colour = {1.0, 0.0, 0.0};
    red.tinted = true;
    return {{"red_1", red, 4e-9, 0.5, 2e-3, 70.0}, {"droplet_2", lookOf(Material::Water), 1e-9, 0.25, 1e-3, 40.0}};
}

TEST(Gltf, EveryDropletHasItsNode)
{
    const Surface surface = testing::pairOfDroplets();
    GltfOptions options;
    options.nodes = Nodes::Each;
    options.droplets = redAndWater();
    for (const bool binary : {true, false}) {
        options.binary = binary;
        const tinygltf::Model model = parsed(written(surface, options), binary);
        ASSERT_EQ(model.nodes.size(), 2U);
        EXPECT_EQ(model.scenes.at(0).nodes, (std::vector<int>{0, 1}));
        std::size_t vertices = 0;
        std::size_t indices = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const tinygltf::Node& node = model.nodes[k];
            const FileDroplet& droplet = options.droplets[k];
            EXPECT_EQ(node.name, droplet.name);
            EXPECT_DOUBLE_EQ(node.extras.Get("volume_m3").GetNumberAsDouble(), droplet.volume);
            EXPECT_DOUBLE_EQ(node.extras.Get("contact_angle_deg").GetNumberAsDouble(), droplet.contact_angle / kDegree);
            EXPECT_DOUBLE_EQ(node.extras.Get("height_max_m").GetNumberAsDouble(), droplet.height_max);
            EXPECT_DOUBLE_EQ(node.extras.Get("pressure_pa").GetNumberAsDouble(), droplet.pressure);
            const tinygltf::Primitive& primitive =
                model.meshes.at(static_cast<std::size_t>(node.mesh)).primitives.at(0);
            const auto& place = model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("POSITION")));
            EXPECT_EQ(place.minValues[0] > 0.0, k == 0) << "the first droplet is on the right";
            vertices += place.count;
            indices += model.accessors.at(static_cast<std::size_t>(primitive.indices)).count;
            const tinygltf::Material& material = model.materials.at(static_cast<std::size_t>(primitive.material));
            EXPECT_EQ(material.name, droplet.look.name);
            const tinygltf::Value& volume = material.extensions.at("KHR_materials_volume");
            EXPECT_DOUBLE_EQ(volume.Get("thicknessFactor").GetNumberAsDouble(), k == 0 ? 2e-3 : 1e-3);
        }
        EXPECT_EQ(vertices, surface.vertices.size());
        EXPECT_EQ(indices, 3 * surface.triangles.size());
    }
}

TEST(Gltf, LooksArePrimitivesOfOneMesh)
{
    const Surface surface = testing::pairOfDroplets();
    GltfOptions options;
    options.droplets = redAndWater();
    const tinygltf::Model model = parsed(written(surface, options), true);
    ASSERT_EQ(model.meshes.size(), 1U);
    ASSERT_EQ(model.meshes[0].primitives.size(), 2U);
    EXPECT_EQ(model.materials[0].name, "red");
    const tinygltf::Value& volume = model.materials[0].extensions.at("KHR_materials_volume");
    EXPECT_DOUBLE_EQ(volume.Get("attenuationDistance").GetNumberAsDouble(), 4e-3);
    // Droplets that look alike are written as without looks.
    options.droplets[0].look = options.droplets[1].look;
    EXPECT_EQ(written(surface, options), written(surface));
}

TEST(Gltf, TextureIsTheBaseColourOfAllMaterials)
{
    GltfOptions options;
    options.droplets = redAndWater();
    options.texture = "any bytes of a picture";
    const std::string bytes = written(testing::pairOfDroplets(), options);
    EXPECT_NE(bytes.find(options.texture), std::string::npos);
    const std::string text = bytes.substr(0, bytes.find("BIN"));
    EXPECT_THAT(text, HasSubstr("image/png"));
    std::size_t count = 0;
    for (std::size_t at = text.find("baseColorTexture"); at != std::string::npos;
         at = text.find("baseColorTexture", at + 1)) {
        ++count;
    }
    EXPECT_EQ(count, 2U);
}

TEST(Gltf, DropletsMustFitTheSurface)
{
    std::ostringstream out;
    GltfOptions options;
    options.nodes = Nodes::Each;
    EXPECT_THROW(writeGltf(testing::pairOfDroplets(), out, options), Error);
    options.droplets = redAndWater();
    options.droplets.pop_back();
    EXPECT_THROW(writeGltf(testing::pairOfDroplets(), out, options), Error);
    options.droplets = redAndWater();
    EXPECT_THROW(writeGltf(roundDroplet(), out, options), Error) << "it has no parts";
}

}  // namespace
}  // namespace droplet
