// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets by colour, nodes and materials of single droplets, and the picture as a tint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "support/colour_pictures.h"
#include "support/command.h"
#include "support/fonts.h"

namespace droplet {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using testing::CommandResult;
using ::testing::HasSubstr;
using testing::pie;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;
using testing::writeFile;

class ColoursTest : public ::testing::Test {
protected:
    ColoursTest()
    {
        writeFile(at("pie.ppm"), pie(120, 50.0));
        writeFile(at("two.pgm"), testing::greymap(96, 64, [](int x, int y) {
                      const double left = std::hypot(x - 30.0, y - 32.0);
                      const double right = std::hypot(x - 76.0, y - 32.0);
                      return left < 20.0 || right < 14.0 ? 255 : 0;
                  }));
    }

    [[nodiscard]] std::string at(const std::string& name) const { return (scratch_.path() / name).string(); }

    /// Runs the command in the scratch directory, which must succeed.
    CommandResult made(std::vector<std::string> arguments) const
    {
        CommandResult result = run(std::move(arguments));
        EXPECT_EQ(result.exit_code, 0) << result.error;
        return result;
    }
    CommandResult run(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.end(), {"--triangles", "2000"});
        testing::CommandOptions options;
        options.directory = scratch_.path();
        return runDroplet(arguments, options);
    }

    /// JSON chunk of a GLB.
    [[nodiscard]] json sceneOf(const std::string& name) const
    {
        const std::string bytes = readFile(at(name));
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 12, sizeof size);
        return json::parse(bytes.substr(20, size));
    }
    [[nodiscard]] json reportOf(const std::string& name) const { return json::parse(readFile(at(name))); }

private:
    ScratchDirectory scratch_;
};

std::set<std::string> namesOf(const json& list)
{
    std::set<std::string> names;
    for (const json& entry : list) {
        names.insert(entry.at("name"));
    }
    return names;
}

TEST_F(ColoursTest, MakesOneDropletForEachColour)
{
    const CommandResult result = made({"pie.ppm", "pie.glb", "--by-colour", "--nodes", "each", "--json", "pie.json"});
    EXPECT_THAT(result.error, HasSubstr("3 colours are liquid (--by-colour)"));
    const json report = reportOf("pie.json");
    EXPECT_EQ(report["input"]["background"], "#ffffff");
    ASSERT_EQ(report["input"]["palette"].size(), 3U);
    ASSERT_EQ(report["droplets"].size(), 3U);
    double area = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(report["droplets"][k]["colour"], report["input"]["palette"][k]["colour"]);
        area += report["droplets"][k]["footprint_area_m2"].get<double>();
    }
    EXPECT_NEAR(area, report["mesh"]["footprint_area_m2"].get<double>(), 1e-12);
    EXPECT_TRUE(report["output"]["closed"]);
    EXPECT_EQ(report["output"]["components"], 3);
    const json scene = sceneOf("pie.glb");
    EXPECT_EQ(namesOf(scene["nodes"]), (std::set<std::string>{"e30613_1", "ffcc00_1", "0062b8_1"}));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(scene["nodes"][k]["extras"]["volume_m3"], report["droplets"][k]["volume_m3"]);
        EXPECT_EQ(scene["nodes"][k]["extras"]["pressure_pa"], report["droplets"][k]["pressure_pa"]);
        EXPECT_EQ(scene["nodes"][k]["extras"]["height_max_m"], report["droplets"][k]["height_max_m"]);
        EXPECT_EQ(scene["nodes"][k]["extras"]["contact_angle_deg"], report["droplets"][k]["contact_angle_deg"]["mean"]);
    }
}

// White light that passes the mean height of a droplet down to the ground and up again has its colour.
TEST_F(ColoursTest, TintIsTheRegionsColour)
{
    made({"pie.ppm", "pie.glb", "--by-colour"});
    const json scene = sceneOf("pie.glb");
    ASSERT_EQ(scene["meshes"].size(), 1U);
    EXPECT_EQ(scene["meshes"][0]["primitives"].size(), 3U);
    ASSERT_EQ(namesOf(scene["materials"]), (std::set<std::string>{"e30613", "ffcc00", "0062b8"}));
    for (const json& material : scene["materials"]) {
        const json& volume = material["extensions"]["KHR_materials_volume"];
        EXPECT_EQ(volume["attenuationDistance"], 2.0 * volume["thicknessFactor"].get<double>());
        if (material["name"] == "ffcc00") {
            EXPECT_NEAR(volume["attenuationColor"][0].get<double>(), 1.0, 1e-9);
            EXPECT_NEAR(volume["attenuationColor"][1].get<double>(), 0.6038, 1e-4);
            EXPECT_NEAR(volume["attenuationColor"][2].get<double>(), 0.02, 1e-9) << "no channel is black";
        }
    }
}

// A white sign on a blue disc: its transparency says nothing of the sign.
TEST_F(ColoursTest, AlphaThatHidesColoursIsTold)
{
    const auto icon = [&](const std::string& sign) {
        writeFile(at("icon.svg"),
                  "<svg xmlns='http://www.w3.org/2000/svg' width='64' height='64'><circle cx='32' "
                  "cy='32' r='30' fill='#229ed9'/><path fill='" +
                      sign + "' d='M16 22h32v20H16Z'/></svg>");
    };
    icon("#fff");
    const char* const warning = "(#229ed9, #ffffff); --by-colour makes a droplet of each colour, and --colour COLOUR";
    EXPECT_THAT(made({"icon.svg", "icon.stl"}).error, HasSubstr(warning));
    for (const std::vector<std::string>& chosen :
         {std::vector<std::string>{"--by-colour"}, {"--colour", "#fff"}, {"--channel", "alpha"}, {"--colour-map"}}) {
        std::vector<std::string> arguments{"icon.svg", "icon.glb"};
        arguments.insert(arguments.end(), chosen.begin(), chosen.end());
        EXPECT_THAT(made(arguments).error, ::testing::Not(HasSubstr("whatever their colour"))) << chosen.front();
    }
    icon("#229eda");
    EXPECT_THAT(made({"icon.svg", "icon.stl"}).error, ::testing::Not(HasSubstr("whatever their colour")));
}

std::vector<std::string> typeOf(const std::string& text, std::vector<std::string> more)
{
    more.insert(more.begin(), {"glyphs", "--font", testing::colourFont(), "--text", text});
    return more;
}

TEST_F(ColoursTest, LayersOfFontsAreDroplets)
{
    const CommandResult result =
        made(typeOf("O", {"-o", "o.glb", "--by-colour", "--nodes", "each", "--json", "o.json"}));
    EXPECT_THAT(result.error, HasSubstr("'O' in Droplet Colours Regular, em 20 mm, 2 colours (--by-colour)"));
    const json report = reportOf("o.json");
    EXPECT_EQ(report["input"]["path"], testing::colourFont());
    EXPECT_EQ(report["input"]["type"]["text"], "O");
    EXPECT_EQ(report["input"]["palette"][0]["colour"], "#ff0000");
    EXPECT_EQ(report["input"]["palette"][1]["colour"], "#0066cc");
    EXPECT_GT(report["input"]["width_px"], 0);
    ASSERT_EQ(report["droplets"].size(), 2U);
    double volume = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(report["droplets"][k]["colour"], report["input"]["palette"][k]["colour"]);
        volume += report["droplets"][k]["volume_m3"].get<double>();
    }
    EXPECT_NEAR(volume, report["shape"]["volume_m3"].get<double>(), 1e-9 * volume);
    EXPECT_TRUE(report["output"]["closed"]);
    EXPECT_EQ(report["output"]["components"], 2);
    const json scene = sceneOf("o.glb");
    EXPECT_EQ(namesOf(scene["nodes"]), (std::set<std::string>{"red_1", "0066cc_1"}));
    EXPECT_EQ(namesOf(scene["materials"]), (std::set<std::string>{"red", "0066cc"}));
}

TEST_F(ColoursTest, PaletteTextColourAndGapAreOptionsOfType)
{
    made(typeOf("OP", {"-o", "p.glb", "--by-colour", "--palette", "1", "--text-colour", "navy"}));
    EXPECT_EQ(namesOf(sceneOf("p.glb")["materials"]), (std::set<std::string>{"009933", "666666", "navy"}));
    const auto area = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"-o", "g.glb", "--by-colour", "--json", "g.json"});
        made(typeOf("O", more));
        return reportOf("g.json")["mesh"]["footprint_area_m2"].get<double>();
    };
    const double boundary = (128.0 + 256.0) / 1024.0 * 20e-3;
    EXPECT_NEAR(area({}) - area({"--gap", "0.2mm"}), boundary * 0.2e-3, 0.05 * boundary * 0.2e-3);
    EXPECT_THAT(run(typeOf("O", {"-o", "x.glb", "--by-colour", "--palette", "2"})).error,
                HasSubstr("palette 2 does not exist: the font has palettes 0 to 1"));
    EXPECT_EQ(run(typeOf("O", {"-o", "x.glb", "--by-colour", "--palette", "few"})).exit_code, 2);
    EXPECT_EQ(run(typeOf("O", {"-o", "x.glb", "--by-colour", "--text-colour", "few"})).exit_code, 2);
    EXPECT_EQ(run(typeOf("O", {"-o", "x.glb", "--by-colour", "--equal-height"})).exit_code, 2);
    for (const std::vector<std::string>& useless :
         {std::vector<std::string>{"--palette", "1"}, {"--text-colour", "red"}, {"--gap", "1mm"}}) {
        EXPECT_THAT(made(typeOf("O", {"-o", "x.glb", useless[0], useless[1]})).error,
                    HasSubstr(useless[0] + " has no effect without --by-colour"));
    }
}

// Bytes of the file are those without --by-colour.
TEST_F(ColoursTest, GlyphsWithoutLayersStayAsTheyAre)
{
    made(typeOf("P", {"-o", "without.glb"}));
    EXPECT_THAT(made(typeOf("P", {"-o", "with.glb", "--by-colour"})).error,
                HasSubstr("--by-colour has no effect: no glyph of the text has colour layers"));
    EXPECT_EQ(readFile(at("without.glb")), readFile(at("with.glb")));
    EXPECT_THAT(made({"glyphs", "--font", testing::kSans, "--text", "o", "-o", "o.glb", "--by-colour"}).error,
                HasSubstr("--by-colour has no effect: the font has no colour layers (COLR)"));
}

TEST_F(ColoursTest, SetsOfGlyphsHaveColoursToo)
{
    const std::vector<std::string> set{"glyphs",      "--font",      testing::colourFont(), "--charset",
                                       "OCP01",       "-o",          "{name}.glb",          "--json",
                                       "{name}.json", "--by-colour", "--keep-going"};
    const CommandResult result = run(set);
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_THAT(result.error, AllOf(HasSubstr("made       3 of 5, 2 failed"),
                                    HasSubstr("('gradient') has gradients or other paints of COLR version 1"),
                                    HasSubstr("the colour layers have no ink")));
    EXPECT_EQ(reportOf("curved.json")["input"]["palette"].size(), 2U);
    EXPECT_EQ(reportOf("curved.json")["input"]["type"]["glyph_name"], "curved");
    EXPECT_TRUE(reportOf("plain.json")["input"]["palette"].is_null());
    made(typeOf("C", {"-o", "text.glb", "--by-colour"}));
    EXPECT_EQ(readFile(at("text.glb")), readFile(at("curved.glb")));
}

TEST_F(ColoursTest, RefusesColoursThatAreNotLayers)
{
    std::string font = readFile(testing::colourFont());
    const std::size_t tag = font.find("COLR");
    for (const std::string other : {"SVG ", "sbix"}) {
        writeFile(at("other.ttf"), font.replace(tag, 4, other));
        const CommandResult result =
            run({"glyphs", "--font", "other.ttf", "--text", "O", "-o", "x.glb", "--by-colour"});
        EXPECT_EQ(result.exit_code, 3);
        EXPECT_THAT(result.error, HasSubstr("other.ttf: the font has its colours in the table " + other.substr(0, 3)));
    }
    EXPECT_EQ(run(typeOf("1", {"-o", "x.glb", "--by-colour"})).exit_code, 3);
    EXPECT_EQ(run(typeOf("0", {"-o", "x.glb", "--by-colour"})).exit_code, 3);
}

TEST_F(ColoursTest, NumberAndGapAreOptions)
{
    made({"pie.ppm", "two.glb", "--by-colour", "--colours", "2", "--json", "two.json"});
    EXPECT_EQ(reportOf("two.json")["input"]["palette"].size(), 2U);
    made({"pie.ppm", "none.glb", "--by-colour", "--json", "none.json"});
    made({"pie.ppm", "gap.glb", "--by-colour", "--gap", "0.5mm", "--json", "gap.json"});
    const auto area = [&](const std::string& name) {
        return reportOf(name)["mesh"]["footprint_area_m2"].get<double>();
    };
    // Three radii of 50 of 120 pixels of a picture 20 mm wide, less what meets in the middle.
    const double radii = 3.0 * 50.0 / 120.0 * 20e-3;
    EXPECT_NEAR(area("none.json") - area("gap.json"), radii * 0.5e-3, 0.05 * radii * 0.5e-3);
    EXPECT_THAT(made({"pie.ppm", "x.glb", "--by-colour", "--colours", "9"}).error,
                HasSubstr("the picture has only 3 that stand out"));
}

TEST_F(ColoursTest, IsTheSameWithAnyNumberOfThreads)
{
    made({"pie.ppm", "one.glb", "--by-colour", "-j", "1"});
    made({"pie.ppm", "two.glb", "--by-colour", "-j", "2"});
    EXPECT_EQ(readFile(at("one.glb")), readFile(at("two.glb")));
}

TEST_F(ColoursTest, RefusesOptionsThatReadTheMaskOtherwise)
{
    for (const std::vector<std::string>& other : {std::vector<std::string>{"--segment", "grabcut"},
                                                  {"--colour", "red"},
                                                  {"--threshold", "0.3"},
                                                  {"--invert"},
                                                  {"--mask-out", "m.png"},
                                                  {"--colour-map"}}) {
        std::vector<std::string> arguments{"pie.ppm", "x.glb", "--by-colour"};
        arguments.insert(arguments.end(), other.begin(), other.end());
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.error, AllOf(HasSubstr("--by-colour"), HasSubstr(other[0]), HasSubstr("exclude")));
    }
    for (const char* wrong : {"0", "65", "few"}) {
        EXPECT_EQ(run({"pie.ppm", "x.glb", "--by-colour", "--colours", wrong}).exit_code, 2) << wrong;
    }
    EXPECT_THAT(made({"two.pgm", "x.glb", "--gap", "1mm"}).error, HasSubstr("--gap has no effect without --by-colour"));
}

TEST_F(ColoursTest, NodesKeepTheDefaultFileAsItIs)
{
    made({"two.pgm", "default.glb"});
    made({"two.pgm", "one.glb", "--nodes", "one"});
    EXPECT_EQ(readFile(at("default.glb")), readFile(at("one.glb")));
    made({"two.pgm", "each.glb", "--nodes", "each"});
    EXPECT_EQ(namesOf(sceneOf("each.glb")["nodes"]), (std::set<std::string>{"droplet_1", "droplet_2"}));
    EXPECT_THAT(made({"two.pgm", "each.stl", "--nodes", "each"}).error,
                HasSubstr("--nodes each has no effect: stl files have no nodes"));
}

TEST_F(ColoursTest, MaterialsComeFromAFile)
{
    writeFile(at("m.toml"),
              "[[droplet]]\nindex = \"all\"\nmaterial = \"honey\"\n\n"
              "[[droplet]]\nindex = 2\nmaterial = \"plain\"\ncolour = \"#e0312f\"\nroughness = 0.25\nior = 1.4\n");
    made({"two.pgm", "m.glb", "--materials", "m.toml"});
    const json scene = sceneOf("m.glb");
    EXPECT_EQ(scene["meshes"][0]["primitives"].size(), 2U);
    EXPECT_EQ(namesOf(scene["materials"]), (std::set<std::string>{"honey", "plain_e0312f_roughness_0.25_ior_1.4"}));
    const json& plain = scene["materials"][1]["pbrMetallicRoughness"];
    EXPECT_EQ(plain["roughnessFactor"], 0.25);
    EXPECT_NEAR(plain["baseColorFactor"][0].get<double>(), 0.7454, 1e-4);
    made({"two.pgm", "m.obj", "--materials", "m.toml"});
    EXPECT_THAT(readFile(at("m.mtl")), AllOf(HasSubstr("newmtl honey\n"), HasSubstr("newmtl plain_e0312f")));
    EXPECT_THAT(readFile(at("m.obj")), AllOf(HasSubstr("usemtl honey\nf"), HasSubstr("usemtl plain_e0312f")));
    EXPECT_THAT(made({"two.pgm", "m.ply", "--materials", "m.toml"}).error,
                HasSubstr("--materials m.toml has no effect: ply files have no material"));
}

TEST_F(ColoursTest, UsdHasNodesAndMaterials)
{
    const auto warned = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"two.pgm", "m.usda"});
        EXPECT_THAT(made(options).error, ::testing::Not(HasSubstr("warning")));
        return readFile(at("m.usda"));
    };
    writeFile(at("m.toml"), "[[droplet]]\nindex = 2\nmaterial = \"plain\"\nior = 1.4\n");
    EXPECT_THAT(warned({"--materials", "m.toml"}),
                AllOf(HasSubstr("def GeomSubset \"water\""), HasSubstr("def GeomSubset \"plain_ior_1_4\"")));
    EXPECT_THAT(warned({"--nodes", "each"}), AllOf(HasSubstr("def Mesh \"droplet_1\""),
                                                   HasSubstr("def Mesh \"droplet_2\""), HasSubstr("volume_m3 = ")));
}

// All that reads a GLB reads a compressed one, within the error that the report states.
TEST_F(ColoursTest, FilesOfSeveralLooksAreCompressed)
{
    writeFile(at("m.toml"), "[[droplet]]\nindex = 2\nmaterial = \"honey\"\n");
    const std::vector<std::vector<std::string>> kinds{{"pie.ppm", "f.glb", "--by-colour"},
                                                      {"pie.ppm", "f.glb", "--by-colour", "--nodes", "each"},
                                                      {"two.pgm", "f.glb", "--materials", "m.toml"},
                                                      {"two.pgm", "f.glb", "--colour-map"}};
    for (std::vector<std::string> kind : kinds) {
        SCOPED_TRACE(kind.back());
        made(kind);
        for (const char* compression : {"quantize", "meshopt"}) {
            kind[1] = "compressed.glb";
            kind.insert(kind.end(), {"--compress", compression, "--json", "r.json"});
            made(kind);
            kind.resize(kind.size() - 4);
            EXPECT_EQ(namesOf(sceneOf("compressed.glb")["nodes"]), namesOf(sceneOf("f.glb")["nodes"]));
            EXPECT_EQ(namesOf(sceneOf("compressed.glb")["materials"]), namesOf(sceneOf("f.glb")["materials"]));
            EXPECT_LT(readFile(at("compressed.glb")).size(), readFile(at("f.glb")).size());
            const double error = reportOf("r.json")["output"]["position_error_m"];
            EXPECT_GT(error, 0.0);
            EXPECT_LT(error, 0.3e-6);
            testing::CommandOptions options;
            options.directory = at("");
            const CommandResult compared = runDroplet(
                {"compare", "f.glb", "compressed.glb", "--tolerance", std::to_string(1e9 * error + 1.0) + "nm"},
                options);
            EXPECT_EQ(compared.exit_code, 0) << compared.output << compared.error;
        }
    }
}

TEST_F(ColoursTest, RefusesWrongMaterialsWithFileLineAndKey)
{
    const auto refused = [&](const std::string& text, const std::string& why) {
        writeFile(at("m.toml"), text);
        const CommandResult result = run({"two.pgm", "x.glb", "--materials", "m.toml"});
        EXPECT_EQ(result.exit_code, 2) << text;
        EXPECT_THAT(result.error, AllOf(HasSubstr("--materials: m.toml:"), HasSubstr(why))) << text;
    };
    refused("[[droplet]]\nindex = 1\nshine = 2\n", "m.toml:3: 'shine' is unknown; allowed are index, material, colour");
    refused("[[drop]]\nindex = 1\n", "'drop' is unknown; allowed are tables [[droplet]]");
    refused("[[droplet]]\nmaterial = \"ink\"\n", "index is missing");
    refused("[[droplet]]\nindex = 0\n", "index must be \"all\" or the number of a droplet, from 1");
    refused("[[droplet]]\nindex = 1\nmaterial = \"beer\"\n", "material is 'beer', must be one of water, ink");
    refused("[[droplet]]\nindex = 1\ncolour = 7\n", "colour must be a colour such as");
    refused("[[droplet]]\nindex = 1\nroughness = 2\n", "roughness must be a number from 0 to 1");
    refused("[[droplet]]\nindex = 1\nior = 0.9\n", "ior must be a number from 1 to 4");
    refused("[[droplet]\n", "m.toml:1:");
    EXPECT_THAT(run({"two.pgm", "x.glb", "--materials", "missing.toml"}).error,
                HasSubstr("--materials: missing.toml cannot be read: No such file"));
    EXPECT_THAT(run({"two.pgm", "x.glb", "--materials", "."}).error,
                HasSubstr("--materials: . cannot be read: Is a directory"));
    for (const char* nothing : {"", "# nothing\n"}) {
        writeFile(at("m.toml"), nothing);
        EXPECT_THAT(run({"two.pgm", "x.glb", "--materials", "m.toml"}).error,
                    HasSubstr("--materials: m.toml has no table [[droplet]]"));
    }
    writeFile(at("m.toml"), "[[droplet]]\nindex = 7\n");
    EXPECT_THAT(made({"two.pgm", "x.glb", "--materials", "m.toml"}).error,
                HasSubstr("m.toml names droplet 7, but there are only 2"));
}

TEST_F(ColoursTest, PictureTintsTheLiquid)
{
    made({"pie.ppm", "map.glb", "--colour-map"});
    const json scene = sceneOf("map.glb");
    ASSERT_EQ(scene["images"].size(), 1U);
    EXPECT_EQ(scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    const json& view = scene["bufferViews"][scene["images"][0]["bufferView"].get<std::size_t>()];
    const std::string bytes = readFile(at("map.glb"));
    EXPECT_EQ(bytes.substr(bytes.find("BIN") + 4 + view["byteOffset"].get<std::size_t>(), 4), "\x89PNG");
    made({"pie.ppm", "map.usdz", "--colour-map"});
    EXPECT_THAT(readFile(at("map.usdz")), AllOf(HasSubstr("picture.png@"), HasSubstr("\x89PNG")));
    EXPECT_THAT(made({"pie.ppm", "map.stl", "--colour-map"}).error,
                HasSubstr("--colour-map has no effect: stl files have no texture"));
    EXPECT_THAT(made({"pie.ppm", "map.usda", "--colour-map"}).error,
                HasSubstr("--colour-map has no effect: usda files have no texture; usdz files have one"));
}

TEST_F(ColoursTest, PreviewAndPageShowTheMap)
{
    const auto preview = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"pie.ppm", "a.stl", "--preview", "a.png", "--preview-size", "64x48"});
        EXPECT_THAT(made(options).error, ::testing::Not(HasSubstr("warning")));
        return readFile(at("a.png"));
    };
    EXPECT_NE(preview({"--colour-map"}), preview({}));
    EXPECT_NE(preview({"--colour-map", "--material", "plain"}), preview({"--material", "plain"}));
    EXPECT_THAT(made({"pie.ppm", "a.stl", "--colour-map", "--html", "a.html"}).error,
                ::testing::Not(HasSubstr("warning")));
    // The page holds the GLB with its picture as base64.
    made({"pie.ppm", "a.stl", "--html", "b.html"});
    EXPECT_GT(readFile(at("a.html")).size(), readFile(at("b.html")).size() + 100);
}

TEST_F(ColoursTest, PreviewShowsTheColours)
{
    made({"pie.ppm", "a.glb", "--by-colour", "--preview", "a.png", "--preview-size", "64x48"});
    made({"pie.ppm", "b.glb", "--by-colour", "--preview", "b.png", "--preview-size", "64x48", "--material", "plain"});
    EXPECT_NE(readFile(at("a.png")), readFile(at("b.png")));
    EXPECT_EQ(namesOf(sceneOf("a.glb")["materials"]), namesOf(sceneOf("b.glb")["materials"]));
}

}  // namespace
}  // namespace droplet
