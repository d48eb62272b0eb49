// SPDX-License-Identifier: GPL-3.0-or-later
// The help states the library's defaults: a run that spells one out makes the same file, to the last byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/photographs.h"

namespace droplet {
namespace {

using testing::greymap;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;
using testing::writeFile;

/// Run of a command.
struct DefaultsOf {
    std::string name;                    ///< of the test
    std::vector<std::string> arguments;  ///< the command first, if it has a name
    std::string file;                    ///< what it writes
    std::size_t least = 0;               ///< number of defaults that the run can spell out
};

class StatedDefaults : public ::testing::TestWithParam<DefaultsOf> {};

TEST_P(StatedDefaults, AreThoseOfTheLibrary)
{
    const DefaultsOf& of = GetParam();
    const ScratchDirectory scratch;
    writeFile(scratch.path() / "mask.pgm", greymap(48, 40, [](int i, int j) {
                  return static_cast<int>(255.0 * std::clamp(14.0 - std::hypot(i - 23.5, j - 19.5), 0.0, 1.0));
              }));
    writeFile(scratch.path() / "plane.obj", "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nf 1 2 3 4\n");
    const auto file_of = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = of.arguments;
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::filesystem::remove(scratch.path() / of.file);
        testing::CommandOptions options;
        options.directory = scratch.path();
        const testing::CommandResult result = runDroplet(arguments, options);
        // Some options need others, or exclude them.
        return result.exit_code == 0 ? readFile(scratch.path() / of.file) : std::string();
    };
    const bool has_name = of.arguments.front().find('.') == std::string::npos;
    const auto told = runDroplet(has_name ? std::vector<std::string>{of.arguments.front(), "--help=json"}
                                          : std::vector<std::string>{"--help=json"});
    const std::string usual = file_of({});
    ASSERT_FALSE(usual.empty());
    const std::regex value(R"([-+\w./:,]+)");
    std::size_t spelt = 0;
    const auto help = nlohmann::json::parse(told.output);
    for (const auto& option : help["options"]) {
        const std::string name = option["name"];
        const std::string stated = option["default"];
        const bool is_given = std::find(of.arguments.begin(), of.arguments.end(), name) != of.arguments.end();
        if (is_given || !std::regex_match(stated, value)) {
            continue;  // those in words, such as `by preset`
        }
        const std::string made = file_of({name + "=" + stated});
        spelt += made.empty() ? 0 : 1;
        if (!made.empty()) {
            EXPECT_TRUE(made == usual) << name << " [" << stated << "]";
        }
    }
    EXPECT_GE(spelt, of.least);
}

INSTANTIATE_TEST_SUITE_P(
    , StatedDefaults,
    ::testing::Values(
        DefaultsOf{"Shape", {"mask.pgm", "out.obj", "--triangles", "300"}, "out.obj", 16},
        DefaultsOf{"Animate", {"animate", "mask.pgm", "out.glb", "--triangles", "300"}, "out.glb", 14},
        DefaultsOf{"Flow", {"flow", "plane.obj", "out.glb", "--time", "0.1s", "--drops", "5"}, "out.glb", 20},
        DefaultsOf{"Liquid2d", {"liquid2d", "out.svg", "--time", "0.1s", "--particle-count", "200"}, "out.svg", 6},
        DefaultsOf{"WindTunnel",
                   {"wind-tunnel", "out.csv", "--volume", "30uL", "--wind", "9m/s", "--slope", "30deg"},
                   "out.csv",
                   7},
        DefaultsOf{
            "Windshield",
            {"windshield", "out.png", "--time", "0.1s", "--warm-up", "0.5s", "--size", "64x48", "--samples", "1"},
            "out.png",
            16}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace droplet
