// SPDX-License-Identifier: GPL-3.0-or-later
// --preview and its options: files, effects, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "cli/refusal.h"
#include "droplet/drawing/picture.h"
#include "support/command.h"
#include "support/gltf_draft.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::RefusalTest;

class PreviewTest : public RefusalTest {
protected:
    /// Runs on the disc with small pictures, and expects success.
    CommandResult made(std::vector<std::string> options) const
    {
        std::vector<std::string> arguments = {"disc.pgm", "out.glb", "--triangles", "500", "--preview-size", "64x48"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.error;
        return result;
    }
    [[nodiscard]] Picture pictureOf(const std::string& name) const { return readPicture(directory() / name); }
};

TEST_F(PreviewTest, WritesAPngOfTheGivenSize)
{
    EXPECT_THAT(made({"--preview", "look.png"}).output, IsEmpty());
    const Picture picture = pictureOf("look.png");
    EXPECT_EQ(picture.width, 64);
    EXPECT_EQ(picture.height, 48);
    EXPECT_GT(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 200) << "a highlight";
    EXPECT_TRUE(fs::exists(directory() / "out.glb"));
}

TEST_F(PreviewTest, IsTheSameWithAnyNumberOfThreads)
{
    made({"--preview", "one.png", "-j", "1"});
    made({"--preview", "two.png", "-j", "2"});
    EXPECT_EQ(readFile(directory() / "one.png"), readFile(directory() / "two.png"));
    EXPECT_EQ(made({"--preview", "-", "-q"}).output, readFile(directory() / "one.png"));
}

TEST_F(PreviewTest, EveryOptionChangesThePicture)
{
    made({"--preview", "plain.png"});
    const Picture plain = pictureOf("plain.png");
    const std::vector<std::vector<std::string>> changes = {
        {"--view", "top"},
        {"--view", "side"},
        {"--material", "ink"},
        {"--material", "plain"},
        {"--colour", "contours"},
        {"--colour", "contact-angle"},
        {"--ground", "disc.pgm"},
        {"--surface", "sphere:R=30mm"},
        {"--camera", "-30deg,20deg"},
        {"--environment", "disc.pgm"},
    };
    std::vector<Picture> seen = {plain};
    for (const std::vector<std::string>& change : changes) {
        std::vector<std::string> options = {"--preview", "changed.png"};
        options.insert(options.end(), change.begin(), change.end());
        made(options);
        seen.push_back(pictureOf("changed.png"));
        EXPECT_EQ(std::count(seen.begin(), seen.end(), seen.back()), 1) << change[0] << ' ' << change[1];
    }
    made({"--preview", "same.png", "--view", "three-quarter", "--material", "water", "--colour", "look"});
    EXPECT_EQ(pictureOf("same.png"), plain);
}

/// Mean colour of a part of a picture's rows, between two columns.
std::array<double, 3> meanOf(const Picture& picture, int begin, int end)
{
    std::array<double, 3> sum{};
    for (int y = picture.height / 3; y < 2 * picture.height / 3; ++y) {
        for (int x = begin; x < end; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                           static_cast<std::size_t>(x)) +
                                      c];
            }
        }
    }
    return sum;
}

// A plate in the ground, red on its left half and blue on its right half.
TEST_F(PreviewTest, ObjectsHaveTheirOwnLooks)
{
    testing::Draft draft;
    draft.addFloats({-0.05F, 0.0F, 0.05F, 0.05F, 0.0F, 0.05F, 0.05F, 0.0F, -0.05F, -0.05F, 0.0F, -0.05F}, "VEC3");
    draft.addFloats({0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F}, "VEC2");
    draft.add(std::string("\0\1\2\0\2\3", 6), 5121, "SCALAR", 6);
    const auto write = [&](const std::string& name, const std::string& image) {
        testing::writeFile(
            directory() / name,
            draft.file(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                       R"({"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],"materials":[)"
                       R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0}}],)"
                       R"("textures":[{"source":0}],"images":[{"uri":")" +
                       image + R"("}])"));
    };
    std::ostringstream png;
    writePng(Picture{4, 1, {200, 10, 10, 200, 10, 10, 10, 10, 200, 10, 10, 200}}, png);
    testing::writeFile(directory() / "halves.png", png.str());
    write("plate.glb", "halves.png");
    const auto seen = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--onto", "plate.glb", "--view", "top", "--preview", "onto.png"});
        made(more);
        return pictureOf("onto.png");
    };
    const Picture own = seen({});
    const auto left = meanOf(own, 10, 22);
    const auto right = meanOf(own, 42, 54);
    EXPECT_GT(left[0], 2.0 * left[2]);
    EXPECT_GT(right[2], 2.0 * right[0]);
    EXPECT_EQ(seen({"-j", "1"}), own);
    std::ostringstream green;
    writePng(Picture{1, 1, {30, 200, 30}}, green);
    testing::writeFile(directory() / "green.png", green.str());
    const auto covered = meanOf(seen({"--ground", "green.png"}), 10, 54);
    EXPECT_GT(covered[1], 2.0 * covered[0]) << "another texture replaces the object's";
    const auto painted = meanOf(seen({"--colour", "contact-angle"}), 10, 22);
    EXPECT_NEAR(painted[0], painted[2], 0.05 * painted[0]) << "colours that have a meaning are on grey";

    write("plate.glb", "none.png");
    const auto without = made({"--onto", "plate.glb", "--view", "top", "--preview", "onto.png"}).error;
    EXPECT_THAT(without, HasSubstr("plate.glb is shown without a texture: none.png"));
    EXPECT_THAT(made({"--onto", "plate.glb"}).error, HasSubstr("none.png")) << "the file has the object";
    EXPECT_THAT(made({"--onto", "plate.glb", "--droplets-only"}).error, Not(HasSubstr("none.png")))
        << "nothing is shown";
}

TEST_F(PreviewTest, TurntablePicturesAreNumberedAndTurned)
{
    made({"--preview", "turn.png", "--turntable", "3"});
    for (const char* name : {"turn-001.png", "turn-002.png", "turn-003.png"}) {
        EXPECT_EQ(pictureOf(name).width, 64) << name;
    }
    EXPECT_FALSE(fs::exists(directory() / "turn.png"));
    EXPECT_FALSE(fs::exists(directory() / "turn-004.png"));
    EXPECT_NE(pictureOf("turn-001.png"), pictureOf("turn-002.png")) << "the table's ruling turns";
}

TEST_F(PreviewTest, TurntableIsOneVideo)
{
    made({"--preview", "turn.mp4", "--turntable", "2", "--preview-background", "none"});
    EXPECT_EQ(readFile(directory() / "turn.mp4").substr(4, 4), "ftyp");
    EXPECT_FALSE(fs::exists(directory() / "turn-001.mp4"));
    made({"--preview", "best.mkv", "--turntable", "2", "--quality", "100"});
    made({"--preview", "worst.mkv", "--turntable", "2", "--quality", "1"});
    EXPECT_GT(readFile(directory() / "best.mkv").size(), readFile(directory() / "worst.mkv").size());
}

TEST_F(PreviewTest, TurntableAloneNamesItsVideo)
{
    EXPECT_THAT(made({"--turntable", "turn.mp4", "-q"}).error, IsEmpty());
    const auto seen = testing::runProgram({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                           "stream=nb_read_frames,avg_frame_rate,width,height", "-of", "csv=p=0",
                                           (directory() / "turn.mp4").string()});
    EXPECT_EQ(seen.output, "64,48,24/1,120\n");
}

TEST_F(PreviewTest, BackgroundNoneIsTransparent)
{
    made({"--preview", "cut.png", "--preview-background", "none"});
    constexpr std::size_t kColourType = 25;  // offset in a PNG
    EXPECT_EQ(readFile(directory() / "cut.png").at(kColourType), 6) << "with alpha";
    made({"--preview", "cut.png", "--preview-background", "ground"});
    EXPECT_EQ(readFile(directory() / "cut.png").at(kColourType), 2);
}

TEST_F(PreviewTest, WarnsAboutOptionsWithoutEffect)
{
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--view", "top"},
                                                   {"--ground", "disc.pgm"},
                                                   {"--preview-colour", "contours"},
                                                   {"--camera", "0deg,9deg"},
                                                   {"--preview-background", "none"},
                                                   {"--environment", "disc.pgm"},
                                                   {"--turntable", "2"}}) {
        EXPECT_THAT(made(option).error, HasSubstr("warning: " + option[0] + " has no effect without --preview"));
    }
    EXPECT_THAT(made({"--preview", "a.png", "--colour", "contours", "--ground", "disc.pgm"}).error,
                HasSubstr("--ground has no effect with --preview-colour contours"));
    // With a preview, the material has an effect even if the mesh has none.
    const CommandResult stl = run({"disc.pgm", "out.stl", "--triangles", "500", "--material", "ink", "--preview",
                                   "ink.png", "--preview-size", "32x32"});
    EXPECT_EQ(stl.exit_code, 0);
    EXPECT_THAT(stl.error, Not(HasSubstr("--material")));
}

TEST_F(PreviewTest, RefusesWrongOptions)
{
    const auto refused = [&](std::vector<std::string> options, int exit_code, const std::vector<std::string>& words) {
        std::vector<std::string> arguments = {"disc.pgm", "new.glb"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectRefusal(arguments, exit_code, words);
    };
    for (const char* size :
         {"1280", "1280x", "x960", "0x0", "8x8", "8193x16", "16x8193", "64x48x3", "-64x48", "64X48"}) {
        refused({"--preview", "a.png", "--preview-size", size}, 2, {"--preview-size", size, "from 16 to 8192"});
    }
    refused({"--preview", "a.jpg"}, 2, {"--preview", "a.jpg", ".png"});
    refused({"--preview", "a.png", "--view", "below"}, 2, {"--view", "three-quarter, top, side"});
    refused({"--preview", "a.png", "--preview-colour", "red"}, 2,
            {"--preview-colour", "look, contours, contact-angle"});
    refused({"--preview", "a.png", "--camera", "20deg"}, 2, {"--camera", "-60deg,30deg"});
    refused({"--preview", "a.png", "--camera", "0deg,91deg"}, 2, {"--camera: elevation", "from 0deg to 90deg"});
    refused({"--preview", "a.png", "--preview-background", "white"}, 2, {"--preview-background", "ground, none"});
    refused({"--preview", "a.png", "--preview-background", "none", "--preview-colour", "contours"}, 2,
            {"--preview-background none", "--preview-colour"});
    refused({"--preview", "a.png", "--preview-background", "none", "--ground", "old.json"}, 2,
            {"--preview-background none", "--ground"});
    refused({"--preview", "a.png", "--turntable", "0"}, 2, {"--turntable"});
    refused({"--preview", "a.png", "--turntable", "361"}, 2, {"--turntable", "360"});
    refused({"--preview", "-", "--turntable", "3"}, 2, {"--turntable", "--preview must name a file"});
    refused({"--preview", "a.mp4"}, 2, {"a.mp4", "needs --turntable"});
    refused({"--turntable", "nowhere/a.mp4"}, 4, {"nowhere"});
    refused({"--preview", "a.png", "--turntable", "b.mp4"}, 2, {"--turntable b.mp4", "--preview exclude each other"});
    refused({"--preview", "a.mp4", "--turntable", "2", "--preview-size", "33x32"}, 2, {"--preview-size", "even"});
    refused({"--preview", "a.mp4", "--turntable", "2", "--codec", "none"}, 2, {"--codec", "'none'", "ffmpeg"});
    refused({"--preview", "a.png", "--codec", "libx264"}, 2, {"--codec needs a video as --preview"});
    refused({"--preview", "a.png", "--preview-colour", "contours", "--onto", "o.glb"}, 2,
            {"--preview-colour contours", "--onto"});
    refused({"--preview", "a.png", "--ground", "missing.png"}, 3, {"missing.png"});
    refused({"--preview", "a.png", "--ground", "old.json"}, 3, {"old.json"});
    refused({"--preview", "a.png", "--environment", "old.json"}, 3, {"old.json"});
    refused({"--preview", "nowhere/a.png"}, 4, {"nowhere"});
    expectRefusal({"disc.pgm", "a.png", "--format", "glb", "--preview", "./a.png"}, 2, {"--preview", "OUTPUT"});
    testing::writeFile(directory() / "ground.png", "not read yet");
    expectRefusal({"disc.pgm", "new.glb", "--preview", "ground.png", "--ground", "ground.png"}, 2,
                  {"--preview", "--ground"});
    expectRefusal({"disc.pgm", "new.glb", "--preview", "-", "--json", "-"}, 2, {"--preview", "--json"});
}

// All files are written, or none.
TEST_F(PreviewTest, WritesNothingIfAPictureCannotBeWritten)
{
    expectRefusal({"disc.pgm", "new.glb", "--triangles", "500", "--preview-size", "64x48", "--preview", "/dev/full"}, 2,
                  {"--preview"});
    fs::create_directory(directory() / "b-002.png");
    expectRefusal({"disc.pgm", "new.glb", "--triangles", "500", "--preview", "b.png", "--turntable", "2"}, 4,
                  {"b-002.png"});
    testing::writeFile(directory() / "older.png", "older");
    expectRefusal({"disc.pgm", "new.glb", "--preview", "older.png", "--no-clobber"}, 4, {"older.png"});
}

}  // namespace
}  // namespace droplet
