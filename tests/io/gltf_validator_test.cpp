// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/io/animation.h"
#include "droplet/io/gltf.h"
#include "droplet/io/output.h"
#include "support/paths.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;

struct Verdict {
    int exit_code = -1;
    std::string text;
};

// Output of the Khronos validator; a missing node or package is a failure, too.
Verdict validated(const std::vector<fs::path>& files)
{
    std::string command = "node '" + std::string(testing::kValidator) + "'";
    for (const fs::path& file : files) {
        command += " '" + file.string() + "'";
    }
    Verdict verdict;
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) {
        return verdict;
    }
    std::array<char, 4096> chunk{};
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe)) {
        verdict.text.append(chunk.data(), count);
    }
    const int status = ::pclose(pipe);
    verdict.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return verdict;
}

fs::path folder()
{
    fs::path path = fs::path(testing::kScratchDir) / "gltf_validator";
    fs::create_directories(path);
    return path;
}

fs::path stored(const std::string& name, const std::string& bytes)
{
    fs::path path = folder() / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string written(const Surface& surface, const GltfOptions& options)
{
    std::ostringstream out;
    writeGltf(surface, out, options);
    return out.str();
}

TEST(GltfValidator, EveryKindOfFileHasNoErrorOrWarning)
{
    std::vector<fs::path> files;
    const auto add = [&](const std::string& name, const Surface& surface, Material material, bool closed) {
        for (const bool binary : {true, false}) {
            files.push_back(stored(name + (binary ? ".glb" : ".gltf"), written(surface, {binary, material, closed})));
        }
    };
    for (const Material material : materials()) {
        for (const bool closed : {true, false}) {
            add(lookOf(material).name + (closed ? "_closed" : "_open"),
                testing::withContactAngles(testing::roundDroplet({.open = !closed})), material, closed);
        }
    }
    add("ring", testing::roundDroplet({.inner = 1e-3}), Material::Water, true);
    add("two", testing::together(testing::roundDroplet(), testing::roundDroplet({.centre = {9e-3, 0.0}})),
        Material::Ink, true);
    add("refill", testing::withRefill(testing::withContactAngles(testing::roundDroplet())), Material::Water, true);
    add("refill_wide_indices", testing::withRefill(testing::roundDroplet({.rings = 200, .segments = 200})),
        Material::Water, true);
    add("wide_indices", testing::roundDroplet({.rings = 200, .segments = 200}), Material::Water, true);
    add("flat", testing::roundDroplet({.height = 1e-12}), Material::Honey, true);
    add("nanometres", testing::roundDroplet({.outer = 1e-9, .height = 1e-10}), Material::Water, true);
    add("kilometres", testing::roundDroplet({.outer = 1e3, .height = 1.0}), Material::Water, true);
    GltfOptions by_droplet;
    by_droplet.droplets = {{"red_1", lookOf(Material::Ink), 1e-9, 0.5, 1e-3, 40.0},
                           {"droplet_2", lookOf(Material::Mercury), 1e-9, 0.5, 1e-3, 40.0}};
    for (const Nodes nodes : {Nodes::One, Nodes::Each}) {
        by_droplet.nodes = nodes;
        for (const bool binary : {true, false}) {
            by_droplet.binary = binary;
            const std::string name = nodes == Nodes::One ? "looks" : "nodes";
            files.push_back(stored(name + (binary ? ".glb" : ".gltf"),
                                   written(testing::withRefill(testing::pairOfDroplets()), by_droplet)));
        }
    }
    for (const Compression compression : {Compression::Quantize, Compression::Meshopt}) {
        for (const bool wide : {false, true}) {
            const std::uint32_t rings = wide ? 200 : 4;
            const Surface surface = testing::roundDroplet({.rings = rings, .segments = 200});
            files.push_back(stored(
                std::string(name(compression)) + (wide ? "_wide.glb" : ".glb"),
                written(testing::withContactAngles(surface), {.material = Material::Ink, .compression = compression})));
        }
    }
    std::ostringstream picture;
    writePng(Picture{2, 1, {255, 0, 0, 0, 0, 255}}, picture);
    by_droplet.binary = true;
    by_droplet.texture = picture.str();
    for (const Compression compression : {Compression::None, Compression::Quantize, Compression::Meshopt}) {
        for (const Nodes nodes : {Nodes::One, Nodes::Each}) {
            by_droplet.compression = compression;
            by_droplet.nodes = nodes;
            files.push_back(stored(std::string(nodes == Nodes::One ? "looks_" : "nodes_") + name(compression) + ".glb",
                                   written(testing::withContactAngles(testing::pairOfDroplets()), by_droplet)));
        }
    }
    const auto animate = [&](const std::string& name, const std::vector<Surface>& frames, std::size_t run,
                             bool closed) {
        Animation animation({.frames_per_second = 25.0, .material = Material::Ink, .closed = closed});
        for (std::size_t k = 0; k < frames.size(); ++k) {
            animation.add(frames[k], k % run != 0);
        }
        std::ostringstream out;
        animation.write(out);
        files.push_back(stored(name, out.str()));
    };
    std::vector<Surface> film;
    for (int k = 0; k < 70; ++k) {
        film.push_back(testing::roundDroplet({.height = 1e-3 + 1e-5 * k, .centre = {1e-4 * k, 0.0}}));
    }
    animate("one_run.glb", film, 100, true);
    animate("runs_of_four.glb", film, 4, true);
    animate("single_frames.glb", {film[0], film[1], film[2]}, 1, true);
    animate("single_frame.glb", {film[0]}, 1, true);
    const Surface odd = testing::soup({{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}, 5);
    animate("odd_number_of_triangles.glb", {odd, odd, odd}, 2, false);
    Animation paused({.frames_per_second = 25.0});
    for (int k = 0; k < 8; ++k) {
        if (k % 4 < 2) {
            paused.addDry();
        } else {
            paused.add(film[static_cast<std::size_t>(k)], k % 4 == 3);
        }
    }
    std::ostringstream out;
    paused.write(out);
    files.push_back(stored("paused.glb", out.str()));
    files.push_back(stored("nothing.glb", written(Surface{}, {})));
    files.push_back(stored("nothing.gltf", written(Surface{}, {.binary = false})));

    const Verdict verdict = validated(files);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.text;
    for (const fs::path& file : files) {
        EXPECT_THAT(verdict.text, ::testing::HasSubstr(file.string() + ": 0 errors, 0 warnings"));
    }
}

TEST(GltfValidator, WouldSeeAnError)
{
    std::string text = written(testing::roundDroplet(), {.binary = false});
    const std::string type = "\"VEC3\"";
    ASSERT_NE(text.find(type), std::string::npos);
    text.replace(text.find(type), type.size(), "\"VEC4\"");
    const Verdict verdict = validated({stored("wrong_type.gltf", text)});
    EXPECT_EQ(verdict.exit_code, 1) << verdict.text;
    EXPECT_THAT(verdict.text, ::testing::HasSubstr("error"));
}

TEST(GltfValidator, WouldSeeAWarning)
{
    std::string text = written(testing::roundDroplet(), {.binary = false});
    const std::string asset = "\"asset\":";
    ASSERT_NE(text.find(asset), std::string::npos);
    text.insert(text.find(asset), "\"unheardOf\": 1, ");
    const Verdict verdict = validated({stored("unexpected_property.gltf", text)});
    EXPECT_EQ(verdict.exit_code, 1) << verdict.text;
    EXPECT_THAT(verdict.text, ::testing::HasSubstr("0 errors, 1 warnings"));
}

TEST(GltfValidator, WouldSeeThatThereIsNothingToValidate)
{
    EXPECT_EQ(validated({}).exit_code, 2);
    EXPECT_EQ(validated({folder() / "missing.glb"}).exit_code, 1);
    EXPECT_EQ(validated({stored("no.glb", "glTF, but not really")}).exit_code, 1);
}

}  // namespace
}  // namespace droplet
