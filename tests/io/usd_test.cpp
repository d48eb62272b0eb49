// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/usd.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/surfaces.h"
#include "support/usda.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::pairOfDroplets;
using testing::roundDroplet;
using ::testing::StartsWith;
using testing::UsdPrim;

using Writer = std::uint64_t (*)(const Surface&, std::ostream&, const UsdOptions&);

std::string written(Writer write, const Surface& surface, const UsdOptions& options = {})
{
    std::ostringstream out;
    const std::uint64_t bytes = write(surface, out, options);
    EXPECT_TRUE(out.good());
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

/// Numbers of a list, without its brackets; those of tuples one after another.
std::vector<float> listOf(const std::string& usda, const std::string& declaration)
{
    const std::string begin = "        " + declaration + " = [";
    const std::size_t at = usda.find(begin);
    EXPECT_NE(at, std::string::npos) << declaration;
    const std::size_t first = at + begin.size();
    std::string text = usda.substr(first, usda.find(']', first) - first);
    for (char& c : text) {
        c = c == '(' || c == ')' || c == ',' ? ' ' : c;
    }
    std::istringstream in(text);
    std::vector<float> numbers;
    for (float number = 0.0F; in >> number;) {
        numbers.push_back(number);
    }
    EXPECT_TRUE(in.eof()) << declaration;
    return numbers;
}

/// Text after the list, up to the end of its metadata.
std::string interpolationOf(const std::string& usda, const std::string& declaration)
{
    const std::size_t end = usda.find(']', usda.find("        " + declaration + " = [") + declaration.size() + 12);
    const std::string rest = usda.substr(end, 60);
    return rest.find("interpolation") == std::string::npos
               ? ""
               : rest.substr(rest.find('"') + 1, rest.rfind('"') - rest.find('"') - 1);
}

float nearestFloat(double value)
{
    return static_cast<float>(value);
}

template <class Number>
Number at(const std::string& bytes, std::size_t offset)
{
    Number number;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

TEST(Usda, StatesUnitAxisAndDefaultPrim)
{
    const std::string usda = written(writeUsda, roundDroplet());
    EXPECT_THAT(usda, StartsWith("#usda 1.0\n(\n    defaultPrim = \"droplet\"\n"));
    const std::string header = usda.substr(0, usda.find("\n)\n"));
    EXPECT_THAT(header, HasSubstr("\n    metersPerUnit = 1\n    upAxis = \"Y\""));
    EXPECT_THAT(usda, HasSubstr("\ndef Xform \"droplet\" ("));
    EXPECT_THAT(usda, HasSubstr("token orientation = \"rightHanded\""));
    EXPECT_THAT(usda, HasSubstr("token subdivisionScheme = \"none\""));
}

TEST(Usda, WeldsPointsAndKeepsNormalsApart)
{
    const Surface surface = testing::withContactAngles(roundDroplet({.inner = 1e-3, .centre = {1e-3, 2e-3}}));
    const std::string usda = written(writeUsda, surface);
    const auto counts = listOf(usda, "int[] faceVertexCounts");
    const auto corners = listOf(usda, "int[] faceVertexIndices");
    const auto points = listOf(usda, "point3f[] points");
    const auto normals = listOf(usda, "normal3f[] primvars:normals");
    const auto normal_indices = listOf(usda, "int[] primvars:normals:indices");
    const auto textures = listOf(usda, "texCoord2f[] primvars:st");
    const auto angles = listOf(usda, "float[] primvars:contact_angle");
    EXPECT_EQ(counts, std::vector<float>(surface.triangles.size(), 3.0F));
    ASSERT_EQ(corners.size(), 3 * surface.triangles.size());
    ASSERT_EQ(normal_indices.size(), corners.size());
    ASSERT_LT(points.size(), 3 * surface.vertices.size());
    EXPECT_EQ(textures.size(), points.size() / 3 * 2);
    EXPECT_EQ(angles.size(), points.size() / 3);
    EXPECT_EQ(interpolationOf(usda, "normal3f[] primvars:normals"), "faceVarying");
    EXPECT_EQ(interpolationOf(usda, "texCoord2f[] primvars:st"), "vertex");
    EXPECT_EQ(interpolationOf(usda, "float[] primvars:contact_angle"), "vertex");
    std::size_t angles_seen = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::uint32_t vertex = surface.triangles[c / 3][c % 3];
        const auto point = static_cast<std::size_t>(corners[c]);
        ASSERT_LT(3 * point, points.size());
        EXPECT_EQ(points[3 * point], nearestFloat(surface.vertices[vertex].x));
        EXPECT_EQ(points[3 * point + 1], nearestFloat(surface.vertices[vertex].z));
        EXPECT_EQ(points[3 * point + 2], nearestFloat(0.0 - surface.vertices[vertex].y));
        const auto normal = static_cast<std::size_t>(normal_indices[c]);
        ASSERT_LT(3 * normal, normals.size());
        EXPECT_EQ(normals[3 * normal + 1], nearestFloat(surface.normals[vertex].z));
        EXPECT_EQ(textures[2 * point], nearestFloat(surface.uvs[vertex].x));
        EXPECT_EQ(textures[2 * point + 1],
                  nearestFloat(1.0 - static_cast<double>(nearestFloat(surface.uvs[vertex].y))));
        if (const float angle = surface.contact_angle[vertex]; angle != 0.0F) {
            EXPECT_EQ(angles[point], nearestFloat(static_cast<double>(angle) / kDegree));
            ++angles_seen;
        }
    }
    EXPECT_GT(angles_seen, 0U);
    const auto extent = listOf(usda, "float3[] extent");
    ASSERT_EQ(extent.size(), 6U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_GE(points[i], extent[i % 3]);
        EXPECT_LE(points[i], extent[3 + i % 3]);
    }
}

TEST(Usda, QuadrilateralsAreFacesOfFourCorners)
{
    Surface surface = testing::asOnePart(roundDroplet({.inner = 1e-3, .centre = {1e-3, 2e-3}}));
    joinTriangles(surface);
    const std::size_t quads = surface.parts[0].quads -= 3;  // some triangles are left
    const std::string usda = written(writeUsda, surface);
    const auto counts = listOf(usda, "int[] faceVertexCounts");
    const auto corners = listOf(usda, "int[] faceVertexIndices");
    const auto points = listOf(usda, "point3f[] points");
    const auto normal_indices = listOf(usda, "int[] primvars:normals:indices");
    std::vector<float> expected(quads, 4.0F);
    expected.resize(surface.triangles.size() - quads, 3.0F);
    EXPECT_EQ(counts, expected);
    std::vector<std::uint32_t> vertices;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        vertices.insert(vertices.end(), surface.triangles[t].begin(), surface.triangles[t].end());
        if (t < 2 * quads) {
            vertices.push_back(surface.triangles[++t][2]);
        }
    }
    ASSERT_EQ(corners.size(), vertices.size());
    ASSERT_EQ(normal_indices.size(), vertices.size());
    for (std::size_t c = 0; c < vertices.size(); ++c) {
        const auto point = static_cast<std::size_t>(corners[c]);
        ASSERT_LT(3 * point, points.size());
        EXPECT_EQ(points[3 * point], nearestFloat(surface.vertices[vertices[c]].x));
        EXPECT_EQ(points[3 * point + 1], nearestFloat(surface.vertices[vertices[c]].z));
    }
}

// A surface that leans out is spread over its footprint, so copies on the rim may differ.
TEST(Usda, GivesCornersTheirOwnTextureWhereCopiesDiffer)
{
    Surface surface = roundDroplet();
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        if (surface.weld[i] != i) {
            surface.uvs[i].x += 0.125;
        }
    }
    const std::string usda = written(writeUsda, surface);
    EXPECT_EQ(interpolationOf(usda, "texCoord2f[] primvars:st"), "faceVarying");
    const auto textures = listOf(usda, "texCoord2f[] primvars:st");
    const auto indices = listOf(usda, "int[] primvars:st:indices");
    ASSERT_EQ(indices.size(), 3 * surface.triangles.size());
    for (std::size_t c = 0; c < indices.size(); ++c) {
        EXPECT_EQ(textures[2 * static_cast<std::size_t>(indices[c])],
                  nearestFloat(surface.uvs[surface.triangles[c / 3][c % 3]].x));
    }
}

TEST(Usda, BindsTheMaterial)
{
    const std::string ink = written(writeUsda, roundDroplet(), {.material = Material::Ink});
    EXPECT_THAT(ink, HasSubstr("rel material:binding = </droplet/ink>"));
    EXPECT_THAT(ink, HasSubstr("def Material \"ink\""));
    EXPECT_THAT(ink, HasSubstr("outputs:surface.connect = </droplet/ink/preview.outputs:surface>"));
    EXPECT_THAT(ink, HasSubstr("color3f inputs:diffuseColor = (0.03, 0.06, 0.35)\n"));
    EXPECT_THAT(ink, HasSubstr("float inputs:ior = 1.333\n"));
    EXPECT_THAT(ink, HasSubstr("float inputs:opacity = 0.35\n"));
    const std::string mercury = written(writeUsda, roundDroplet(), {.material = Material::Mercury});
    EXPECT_THAT(mercury, HasSubstr("float inputs:metallic = 1\n"));
    EXPECT_THAT(mercury, HasSubstr("float inputs:opacity = 1\n"));
    EXPECT_THAT(mercury, HasSubstr("float inputs:roughness = 0.02\n"));
}

TEST(Usda, ASurfaceWithoutLiquidHasNoMesh)
{
    const std::string usda = written(writeUsda, {});
    EXPECT_THAT(usda, HasSubstr("def Xform \"droplet\""));
    EXPECT_THAT(usda, Not(HasSubstr("Mesh")));
}

TEST(Usd, DoesNotDependOnTheLocale)
{
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    for (const Writer write : {writeUsda, writeUsdz}) {
        const std::string expected = written(write, roundDroplet());
        const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
        const std::string bytes = written(write, roundDroplet());
        std::locale::global(before);
        EXPECT_EQ(bytes, expected);
    }
}

TEST(Usd, RefusesInvalidSurfaces)
{
    Surface surface = roundDroplet();
    surface.vertices[3].x = std::numeric_limits<double>::quiet_NaN();
    Surface far = roundDroplet();
    far.vertices[0].z = 1e39;
    for (const Writer write : {writeUsda, writeUsdz}) {
        for (const Surface& wrong : {surface, far}) {
            std::ostringstream out;
            EXPECT_THROW(write(wrong, out, {}), Error);
        }
    }
}

TEST(Usd, LeavesAFullStreamFailed)
{
    struct Full : std::streambuf {};
    for (const Writer write : {writeUsda, writeUsdz}) {
        Full full;
        std::ostream out(&full);
        write(roundDroplet(), out, {});
        EXPECT_FALSE(out.good());
    }
}

/// Prim at an absolute path; null if there is none.
const UsdPrim* primAt(const UsdPrim& root, std::string path)
{
    const UsdPrim* prim = &root;
    while (!path.empty()) {
        const std::size_t end = std::min(path.find('/', 1), path.size());
        const auto found = prim->children.find(path.substr(1, end - 1));
        if (path[0] != '/' || found == prim->children.end()) {
            return nullptr;
        }
        prim = &found->second;
        path.erase(0, end);
    }
    return prim;
}

/// Checks names, types, schemas and the targets of paths of a prim and of all below it.
void expectSound(const UsdPrim& root, const UsdPrim& prim)
{
    static const std::set<std::string> types{
        "uniform token", "token",        "float",  "float3[]", "int[]",  "float[]",      "point3f[]",
        "normal3f[]",    "texCoord2f[]", "asset",  "string",   "float2", "rel",          "custom double",
        "color3f",       "float4",       "float3", "double3",  "quatf",  "uniform bool", "uniform token[]"};
    for (const auto& [name, property] : prim.properties) {
        EXPECT_TRUE(types.contains(property.type)) << property.type;
        if (property.type == "rel") {
            EXPECT_EQ(name, "material:binding");
            const UsdPrim* const target = primAt(root, property.value);
            ASSERT_NE(target, nullptr) << property.value;
            EXPECT_EQ(target->type, "Material");
            EXPECT_EQ(prim.metadata.at("prepend apiSchemas"), "[MaterialBindingAPI]");
        } else if (property.connects) {
            const std::size_t point = property.value.find('.');
            const UsdPrim* const target = primAt(root, property.value.substr(0, point));
            ASSERT_NE(target, nullptr) << property.value;
            ASSERT_TRUE(target->properties.contains(property.value.substr(point + 1))) << property.value;
        } else {
            EXPECT_NE(property.value.empty() && property.samples.empty(), name.starts_with("outputs:") == false)
                << name;
        }
    }
    for (const auto& [name, child] : prim.children) {
        EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(name.at(0))) == 0) << name;
        EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](unsigned char c) {
            return c < 0x80 && (std::isalnum(c) != 0 || c == '_');
        })) << name;
        expectSound(root, child);
    }
}

/// Prims of a file, which is sound.
UsdPrim parsed(const std::string& usda)
{
    UsdPrim root = testing::UsdaReader(usda).read();
    expectSound(root, root);
    EXPECT_THAT(root.order, ElementsAre(root.metadata.at("defaultPrim")));
    return root.child("droplet");
}

std::vector<std::size_t> numbersOf(const std::string& list)
{
    std::vector<std::size_t> numbers;
    std::istringstream in(list.substr(1));
    for (std::size_t number = 0; in >> number; in.ignore()) {
        numbers.push_back(number);
    }
    return numbers;
}

/// Tuples of a list, as text.
std::vector<std::string> tuplesOf(const std::string& list)
{
    std::vector<std::string> tuples;
    for (std::size_t at = list.find('('); at != std::string::npos; at = list.find('(', at + 1)) {
        tuples.push_back(list.substr(at, list.find(')', at) + 1 - at));
    }
    return tuples;
}

Look looking(const std::string& name, Vec3 colour)
{
    Look look = lookOf(Material::Water);
    look.name = name;
    look.colour = colour;
    return look;
}

UsdOptions blueAndRed(Nodes nodes)
{
    return {.nodes = nodes,
            .droplets = {{"0000ff_1", looking("0000ff", {0.0, 0.0, 1.0}), 4e-9, 0.5, 2e-3, 70.0},
                         {"red_1", looking("red", {1.0, 0.0, 0.0}), 1e-9, 0.25, 1e-3, 40.0}}};
}

TEST(Usda, IsSound)
{
    for (const Surface& surface : {roundDroplet(), testing::withContactAngles(pairOfDroplets()), Surface{}}) {
        for (const Material material : {Material::Water, Material::Mercury}) {
            parsed(written(writeUsda, surface, {.material = material}));
        }
    }
}

TEST(Usda, EveryLookIsBoundToItsFaces)
{
    const Surface surface = pairOfDroplets();
    const UsdPrim droplet = parsed(written(writeUsda, surface, blueAndRed(Nodes::One)));
    ASSERT_THAT(droplet.order, ElementsAre("surface", "_0000ff", "red"));
    EXPECT_EQ(droplet.child("_0000ff").metadata.at("displayName"), "0000ff");
    EXPECT_FALSE(droplet.child("red").metadata.contains("displayName"));
    EXPECT_EQ(droplet.child("_0000ff").child("preview").value("inputs:diffuseColor"), "(0, 0, 1)");
    EXPECT_EQ(droplet.child("red").child("preview").value("inputs:diffuseColor"), "(1, 0, 0)");
    const UsdPrim& mesh = droplet.child("surface");
    EXPECT_EQ(mesh.value("subsetFamily:materialBind:familyType"), "partition");
    ASSERT_THAT(mesh.order, ElementsAre("_0000ff", "red"));
    std::vector<int> times(surface.triangles.size());
    const std::vector<std::size_t> corners = numbersOf(mesh.value("faceVertexIndices"));
    const std::vector<std::string> points = tuplesOf(mesh.value("points"));
    for (const auto& [name, subset] : mesh.children) {
        EXPECT_EQ(subset.type, "GeomSubset");
        EXPECT_EQ(subset.value("elementType"), "face");
        EXPECT_EQ(subset.value("familyName"), "materialBind");
        EXPECT_EQ(subset.value("material:binding"), "/droplet/" + name);
        for (const std::size_t face : numbersOf(subset.value("indices"))) {
            ASSERT_LT(face, times.size());
            ++times[face];
            const bool is_right = points.at(corners.at(3 * face)).starts_with("(-") == false;
            EXPECT_EQ(is_right, name == "_0000ff") << "the first droplet is on the right";
        }
    }
    EXPECT_EQ(times, std::vector<int>(times.size(), 1)) << "every face has one look";
}

TEST(Usda, OneLookNeedsNoSubsets)
{
    UsdOptions options = blueAndRed(Nodes::One);
    options.droplets[0].look = options.droplets[1].look = lookOf(Material::Water);
    EXPECT_EQ(written(writeUsda, pairOfDroplets(), options), written(writeUsda, pairOfDroplets()));
}

TEST(Usda, EveryDropletIsAMesh)
{
    const Surface surface = pairOfDroplets();
    UsdOptions options = blueAndRed(Nodes::Each);
    const UsdPrim droplet = parsed(written(writeUsda, surface, options));
    ASSERT_THAT(droplet.order, ElementsAre("_0000ff_1", "red_1", "_0000ff", "red"));
    std::size_t faces = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        const UsdPrim& mesh = droplet.child(droplet.order[k]);
        EXPECT_EQ(mesh.type, "Mesh");
        EXPECT_EQ(mesh.value("material:binding"), "/droplet/" + droplet.order[2 + k]);
        EXPECT_TRUE(mesh.children.empty());
        EXPECT_EQ(std::stod(mesh.value("userProperties:volume_m3")), options.droplets[k].volume);
        EXPECT_EQ(std::stod(mesh.value("userProperties:pressure_pa")), options.droplets[k].pressure);
        EXPECT_EQ(std::stod(mesh.value("userProperties:height_max_m")), options.droplets[k].height_max);
        EXPECT_EQ(std::stod(mesh.value("userProperties:contact_angle_deg")),
                  options.droplets[k].contact_angle / kDegree);
        EXPECT_EQ(mesh.value("extent").starts_with("[(-"), k == 1) << "the first droplet is on the right";
        const auto own = numbersOf(mesh.value("faceVertexCounts"));
        faces += own.size();
        const auto corners = numbersOf(mesh.value("faceVertexIndices"));
        EXPECT_EQ(corners.size(), 3 * own.size());
        const std::string& points = mesh.value("points");
        EXPECT_EQ(1 + *std::max_element(corners.begin(), corners.end()),
                  static_cast<std::size_t>(std::count(points.begin(), points.end(), '(')));
    }
    EXPECT_EQ(faces, surface.triangles.size());
    options.droplets[0].look = options.droplets[1].look;
    EXPECT_THAT(parsed(written(writeUsda, surface, options)).order, ElementsAre("_0000ff_1", "red_1", "red"))
        << "equal looks share a material";
    EXPECT_THAT(parsed(written(writeUsda, {}, options)).order, ElementsAre("water"));
}

TEST(Usda, NamesArePrimsIdentifiersAndStayApart)
{
    UsdOptions options = blueAndRed(Nodes::One);
    options.droplets[0].look.name = "surface";
    options.droplets[1].look.name = "ior 1.4 \"\\\n";
    const UsdPrim droplet = parsed(written(writeUsda, pairOfDroplets(), options));
    ASSERT_THAT(droplet.order, ElementsAre("surface", "surface_2", "ior_1_4____"));
    EXPECT_EQ(droplet.child("surface_2").metadata.at("displayName"), "surface");
    EXPECT_EQ(droplet.child("ior_1_4____").metadata.at("displayName"), "ior 1.4 \"\\\\n");
    options.nodes = Nodes::Each;
    options.droplets[0].name = options.droplets[1].name = "";
    options.droplets[0].look.name = "a.b";
    options.droplets[1].look.name = "a-b";
    EXPECT_THAT(parsed(written(writeUsda, pairOfDroplets(), options)).order, ElementsAre("_", "__2", "a_b", "a_b_2"));
}

TEST(Usd, DropletsMustFitTheSurface)
{
    for (const Writer write : {writeUsda, writeUsdz}) {
        std::ostringstream out;
        EXPECT_THROW(write(pairOfDroplets(), out, {.nodes = Nodes::Each}), Error);
        UsdOptions options = blueAndRed(Nodes::One);
        EXPECT_THROW(write(roundDroplet(), out, options), Error) << "it has no parts";
        options.droplets.pop_back();
        EXPECT_THROW(write(pairOfDroplets(), out, options), Error);
    }
}

TEST(Usda, HoldsNoPicture)
{
    std::ostringstream out;
    EXPECT_THROW(writeUsda(roundDroplet(), out, {.texture = "any bytes of a picture"}), Error);
    EXPECT_EQ(out.str(), "");
}

/// Names and contents of a zip's files, which are stored without compression and aligned.
/// Offsets of headers: PKWARE's specification, sections 4.3.7, 4.3.12 and 4.3.16.
std::vector<std::pair<std::string, std::string>> filesOf(const std::string& zip)
{
    std::vector<std::pair<std::string, std::string>> files;
    const std::size_t end = zip.size() - 22;
    EXPECT_EQ(at<std::uint32_t>(zip, end), 0x06054b50U);
    const std::size_t count = at<std::uint16_t>(zip, end + 10);
    EXPECT_EQ(at<std::uint16_t>(zip, end + 8), count);
    std::size_t entry = at<std::uint32_t>(zip, end + 16);
    EXPECT_EQ(at<std::uint32_t>(zip, end + 12), end - entry);
    std::size_t expected_begin = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t header = at<std::uint32_t>(zip, entry + 42);
        EXPECT_EQ(header, expected_begin);
        EXPECT_EQ(at<std::uint32_t>(zip, entry), 0x02014b50U);
        EXPECT_EQ(at<std::uint32_t>(zip, header), 0x04034b50U);
        const std::size_t name_bytes = at<std::uint16_t>(zip, header + 26);
        const std::size_t begin = header + 30U + name_bytes + at<std::uint16_t>(zip, header + 28);
        EXPECT_EQ(begin % 64, 0U);
        const std::string name = zip.substr(header + 30, name_bytes);
        EXPECT_EQ(zip.substr(entry + 46, name_bytes), name);
        const std::string content = zip.substr(begin, at<std::uint32_t>(zip, header + 22));
        const auto crc = static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
        for (const std::size_t fields : {header + 4, entry + 6}) {
            EXPECT_EQ(at<std::uint16_t>(zip, fields + 2), 0);  // flags
            EXPECT_EQ(at<std::uint16_t>(zip, fields + 4), 0);  // stored
            EXPECT_EQ(at<std::uint32_t>(zip, fields + 10), crc);
            EXPECT_EQ(at<std::uint32_t>(zip, fields + 14), content.size());
            EXPECT_EQ(at<std::uint32_t>(zip, fields + 18), content.size());
        }
        files.emplace_back(name, content);
        expected_begin = begin + content.size();
        entry += 46 + name_bytes;
    }
    EXPECT_EQ(entry, end);
    EXPECT_EQ(at<std::uint32_t>(zip, end + 16), expected_begin);
    return files;
}

TEST(Usdz, IsAnAlignedZipWithoutCompression)
{
    const auto files = filesOf(written(writeUsdz, roundDroplet()));
    ASSERT_EQ(files.size(), 1U);
    EXPECT_EQ(files[0].first, "droplet.usda");
    EXPECT_EQ(files[0].second, written(writeUsda, roundDroplet()));
}

TEST(Usdz, PictureIsTheColourOfAllMaterials)
{
    for (const std::size_t bytes : {1U, 63U, 70'000U}) {
        UsdOptions options = blueAndRed(Nodes::One);
        options.texture = std::string(bytes, 'x');
        const auto files = filesOf(written(writeUsdz, pairOfDroplets(), options));
        ASSERT_EQ(files.size(), 2U);
        EXPECT_EQ(files[0].first, "droplet.usda") << "the layer is the first file";
        EXPECT_EQ(files[1].first, "picture.png");
        EXPECT_EQ(files[1].second, options.texture);
        const UsdPrim droplet = parsed(files[0].second);
        for (const char* name : {"_0000ff", "red"}) {
            const UsdPrim& material = droplet.child(name);
            const std::string path = std::string("/droplet/") + name;
            EXPECT_EQ(material.child("preview").value("inputs:diffuseColor"), path + "/picture.outputs:rgb");
            const UsdPrim& picture = material.child("picture");
            EXPECT_EQ(picture.value("info:id"), "UsdUVTexture");
            EXPECT_EQ(picture.value("inputs:file"), files[1].first);
            EXPECT_EQ(picture.value("inputs:sourceColorSpace"), "sRGB");
            EXPECT_EQ(picture.value("inputs:st"), path + "/st.outputs:result");
            EXPECT_EQ(picture.value("inputs:scale"), name == std::string("red") ? "(1, 0, 0, 1)" : "(0, 0, 1, 1)");
            EXPECT_EQ(material.child("st").value("inputs:varname"), "st");
        }
    }
}

}  // namespace
}  // namespace droplet
