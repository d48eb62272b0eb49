// SPDX-License-Identifier: GPL-3.0-or-later
// Compares droplets from the masks with the reference droplets in tests/golden. Geometry is compared, not bytes:
// rounding differs between machines, and one flipped edge changes all bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/compare.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::compare;
using testing::Difference;
using testing::runDroplet;
using testing::ScratchDirectory;
using testing::TriangleMesh;

const std::filesystem::path kRoot = testing::kSourceDir;

/// One line of tests/golden/cases.
struct Case {
    std::string name;
    double mean_distance = 0.0;          ///< allowed mean distance, as a share of the droplet's height
    std::vector<std::string> arguments;  ///< arguments of droplet-shape, without the output
};

void PrintTo(const Case& golden, std::ostream* out)
{
    *out << golden.name;
}

std::vector<Case> cases()
{
    std::vector<Case> result;
    std::ifstream file(kRoot / "tests/golden/cases");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        Case golden;
        if (line.empty() || line[0] == '#') {
            continue;
        }
        words >> golden.name >> golden.mean_distance;
        for (std::string word; words >> word;) {
            golden.arguments.push_back(word);
        }
        golden.arguments.at(0) = (kRoot / golden.arguments.at(0)).string();
        result.push_back(std::move(golden));
    }
    return result;
}

/// Values of a tightly packed accessor.
template <typename T>
std::vector<T> values(const tinygltf::Model& model, int accessor, std::size_t components)
{
    const tinygltf::Accessor& a = model.accessors.at(static_cast<std::size_t>(accessor));
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
    const std::vector<unsigned char>& data = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
    std::vector<T> result(a.count * components);
    const std::size_t begin = view.byteOffset + a.byteOffset;
    if (begin + result.size() * sizeof(T) > data.size()) {
        throw std::runtime_error("accessor beyond its buffer");
    }
    std::memcpy(result.data(), data.data() + begin, result.size() * sizeof(T));
    return result;
}

/// Triangles of a GLB, with Y up.
TriangleMesh readGlb(const std::filesystem::path& path)
{
    tinygltf::Model model;
    std::string error;
    std::string warning;
    if (!tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path.string())) {
        throw std::runtime_error(path.string() + ": " + error);
    }
    const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
    const auto vertices = values<float>(model, primitive.attributes.at("POSITION"), 3);
    // Golden droplets are small enough for 16-bit indices.
    const auto corners = values<std::uint16_t>(model, primitive.indices, 1);
    TriangleMesh mesh;
    for (std::size_t k = 0; k + 2 < vertices.size(); k += 3) {
        mesh.vertices.push_back({vertices[k], vertices[k + 1], vertices[k + 2]});
    }
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
        mesh.triangles.push_back({corners[k], corners[k + 1], corners[k + 2]});
    }
    return mesh;
}

double height(const TriangleMesh& mesh)
{
    double top = 0.0;
    for (const Vec3 p : mesh.vertices) {
        top = std::max(top, p.y);
    }
    return top;
}

/// Quantity with its unit, such as `30uL`, times a factor.
std::string times(double factor, const std::string& quantity)
{
    std::size_t end = 0;
    const double number = std::stod(quantity, &end);
    return std::to_string(factor * number) + quantity.substr(end);
}

constexpr std::size_t kTriangles = 1500;

class GoldenTest : public ::testing::TestWithParam<Case> {
protected:
    /// Difference of a new droplet from the golden one; distances are shares of the height.
    /// @param more  factor of the amount of liquid
    [[nodiscard]] Difference difference(std::size_t triangles = kTriangles, double more = 1.0) const
    {
        std::vector<std::string> arguments = GetParam().arguments;
        for (std::size_t k = 0; k + 1 < arguments.size() && more != 1.0; ++k) {
            if (arguments[k] == "--height" || arguments[k] == "--volume" || arguments[k] == "--contact-angle") {
                arguments[k + 1] = times(more, arguments[k + 1]);
            }
        }
        const std::filesystem::path output = scratch_.path() / "droplet.glb";
        arguments.insert(arguments.begin() + 1, output.string());
        arguments.insert(arguments.end(), {"--triangles", std::to_string(triangles), "--quiet"});
        const auto result = runDroplet(arguments);
        if (result.exit_code != 0) {
            throw std::runtime_error(result.error);
        }
        const TriangleMesh golden = readGlb(kRoot / "tests/golden" / (GetParam().name + ".glb"));
        Difference found = compare(readGlb(output), golden);
        found.distance.mean /= height(golden);
        found.distance.largest /= height(golden);
        return found;
    }

    [[nodiscard]] static bool alike(const Difference& found)
    {
        // At sharp turns of the rim, two good triangulations with so few triangles differ by up to 11 % of the height
        // in one point. Their volumes agree within 0.4 %, prescribed or not, and their areas within 0.02 %.
        return found.distance.mean < GetParam().mean_distance && found.distance.largest < 0.16 &&
               std::abs(found.volume) < 6e-3 && std::abs(found.area) < 3e-4;
    }

private:
    ScratchDirectory scratch_;
};

std::string textOf(const Difference& found)
{
    std::ostringstream text;
    text << "distance " << found.distance.mean << " in the mean, " << found.distance.largest << " at most, volume "
         << found.volume << ", area " << found.area;
    return text.str();
}

TEST_P(GoldenTest, DropletIsUnchanged)
{
    const Difference found = difference();
    EXPECT_TRUE(alike(found)) << textOf(found);
}

TEST_P(GoldenTest, OtherTriangulationIsTheSameDroplet)
{
    for (const std::size_t triangles : {1400U, 1600U}) {
        const Difference found = difference(triangles);
        EXPECT_TRUE(alike(found)) << triangles << " triangles: " << textOf(found);
        EXPECT_GT(found.distance.largest, 0.0) << "not another triangulation";
    }
}

TEST_P(GoldenTest, FourPercentMoreOrLessLiquidIsAnotherDroplet)
{
    for (const double more : {0.96, 1.04}) {
        const Difference found = difference(kTriangles, more);
        EXPECT_FALSE(alike(found)) << more << ": " << textOf(found);
        // The distance alone shows the difference.
        EXPECT_GT(found.distance.mean, GetParam().mean_distance) << more;
    }
}

TEST(Golden, EveryCaseHasItsFile)
{
    std::vector<std::string> wanted;
    for (const Case& golden : cases()) {
        wanted.push_back(golden.name + ".glb");
    }
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(kRoot / "tests/golden")) {
        if (entry.path().extension() == ".glb") {
            found.push_back(entry.path().filename().string());
            EXPECT_LT(entry.file_size(), 100'000U);
        }
    }
    EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(wanted));
    EXPECT_GE(wanted.size(), 4U);
}

// The comparison itself, on shapes with known distance.

TEST(CompareSurfaces, MeasuresKnownDistances)
{
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const TriangleMesh other_diagonal{square.vertices, {{0, 1, 3}, {1, 2, 3}}};
    EXPECT_EQ(compare(square, other_diagonal).distance.largest, 0.0);

    TriangleMesh lifted = square;
    for (Vec3& p : lifted.vertices) {
        p.z = 0.25;
    }
    EXPECT_NEAR(compare(lifted, square).distance.mean, 0.25, 1e-15);
    EXPECT_NEAR(compare(lifted, square).distance.largest, 0.25, 1e-15);

    // Every point of the half lies on the square, but not the reverse: the far centre is 1/3 · 1/√2 away.
    const TriangleMesh half{square.vertices, {{0, 1, 2}}};
    const Difference missing = compare(half, square);
    EXPECT_NEAR(missing.distance.mean, 0.5 * std::sqrt(0.5) / 3.0, 1e-15);
    EXPECT_NEAR(missing.distance.largest, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(missing.area, -0.5, 1e-15);
}

TEST(CompareSurfaces, MeasuresDistanceFromEveryPartOfATriangle)
{
    const Vec3 a{0, 0, 0};
    const Vec3 b{4, 0, 0};
    const Vec3 c{0, 3, 0};
    EXPECT_EQ(testing::distance({1, 1, -2}, a, b, c), 2.0);
    EXPECT_EQ(testing::distance({-3, -4, 0}, a, b, c), 5.0);
    EXPECT_EQ(testing::distance({2, -3, 4}, a, b, c), 5.0);
    EXPECT_NEAR(testing::distance({2 + 3, 1.5 + 4, 0}, a, b, c), 5.0, 1e-15);
    EXPECT_EQ(testing::distance({4, 0, 0}, a, b, c), 0.0);
    // A triangle without area equals its longest side.
    EXPECT_EQ(testing::distance({1, 3, 0}, a, b, b), 3.0);
}

TEST(CompareSurfaces, KnowsVolumeAndAreaOfATetrahedron)
{
    const TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    EXPECT_NEAR(testing::volume(tetrahedron), 1.0 / 6.0, 1e-15);
    EXPECT_NEAR(testing::area(tetrahedron), 1.5 + 0.5 * std::sqrt(3.0), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Case, GoldenTest, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace droplet
