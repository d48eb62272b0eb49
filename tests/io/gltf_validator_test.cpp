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

#include "droplet/io/gltf.h"
#include "droplet/io/output.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;

struct Verdict {
    int exit_code = -1;
    std::string text;
};

// Of the Khronos validator; a missing node or package is a failure as any other.
Verdict validated(const std::vector<fs::path>& files)
{
    std::string command = "node '" DROPLET_VALIDATOR "'";
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
    fs::path path = fs::path(DROPLET_TEST_TMP) / "gltf_validator";
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
    for (const char* name : {"water", "ink", "mercury", "honey", "plain"}) {
        for (const bool closed : {true, false}) {
            add(std::string(name) + (closed ? "_closed" : "_open"),
                testing::withContactAngles(testing::roundDroplet({.open = !closed})), materialNamed(name), closed);
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
