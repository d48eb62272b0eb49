// SPDX-License-Identifier: GPL-3.0-or-later
// Replays every seed of the fuzzers and every input that ever failed, in the ordinary tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/targets.h"
#include "support/paths.h"

namespace droplet {
namespace {

void replay(const char* corpus, const std::function<void(std::span<const std::byte>)>& target)
{
    const std::filesystem::path folder = std::filesystem::path(testing::kSourceDir) / "tests/fuzz/corpus" / corpus;
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    ASSERT_FALSE(paths.empty()) << folder;
    for (const std::filesystem::path& path : paths) {
        SCOPED_TRACE(path.filename().string());
        std::ifstream file(path, std::ios::binary);
        const std::string content(std::istreambuf_iterator<char>(file), {});
        ASSERT_FALSE(file.bad());
        EXPECT_NO_THROW(target(std::as_bytes(std::span(content))));
    }
}

TEST(FuzzReplay, Mask)
{
    replay("mask", fuzzMask);
}

TEST(FuzzReplay, Object)
{
    replay("object", fuzzObject);
}

TEST(FuzzReplay, Particles)
{
    replay("particles", fuzzParticles);
}

TEST(FuzzReplay, Scene)
{
    replay("scene", fuzzScene);
}

TEST(FuzzReplay, Svg)
{
    replay("svg", fuzzSvg);
}

TEST(FuzzReplay, Footprint)
{
    replay("footprint", fuzzFootprint);
}

}  // namespace
}  // namespace droplet
