// SPDX-License-Identifier: GPL-3.0-or-later
// Bad inputs and outputs: one clear line, the right exit code, no file lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/refusal.h"
#include "support/command.h"
#include "support/gltf_draft.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using testing::canRespectPermissions;
using testing::CommandOptions;
using testing::discPicture;
using testing::greymap;
using ::testing::HasSubstr;
using testing::readFile;
using testing::RefusalTest;
using testing::writeFile;

class FailureTest : public RefusalTest {
protected:
    /// Expects that a picture of these bytes is refused, from a file and from standard input.
    void expectBadPicture(const std::string& bytes, const std::vector<std::string>& words) const
    {
        writeFile(directory() / "bad.png", bytes);
        auto named = words;
        named.emplace_back("bad.png");
        expectRefusal({"bad.png", "old.glb", "--json", "old.json"}, 3, named);
        CommandOptions options;
        options.input = bytes;
        named.back() = "standard input";
        expectRefusal({"-", "old.glb", "--json", "old.json"}, 3, named, options);
    }

    /// Runs droplet-shape with these arguments in a shell, after the commands in `before`.
    [[nodiscard]] testing::CommandResult runShell(const std::string& arguments, const std::string& before = "") const
    {
        CommandOptions options;
        options.directory = directory();
        return testing::runProgram({"sh", "-c", before + "exec \"$0\" " + arguments, testing::kCommand}, options);
    }

    void expectBadOutput(const std::vector<std::string>& outputs, const std::vector<std::string>& words,
                         const CommandOptions& options = {}) const
    {
        std::vector<std::string> arguments{"disc.pgm"};
        arguments.insert(arguments.end(), outputs.begin(), outputs.end());
        expectRefusal(arguments, 4, words, options);
    }
};

TEST_F(FailureTest, ReportsMissingPicture)
{
    expectRefusal({"missing.png", "old.glb", "--json", "old.json"}, 3, {"missing.png", "No such file"});
}

TEST_F(FailureTest, ReportsEmptyPicture)
{
    expectBadPicture("", {"empty"});
}

TEST_F(FailureTest, ReportsTruncatedPicture)
{
    const std::string whole = discPicture(64, 24.0);
    expectBadPicture(whole.substr(0, whole.size() / 2), {});
    expectBadPicture(whole.substr(0, 5), {});
}

TEST_F(FailureTest, ReportsFileThatIsNotAPicture)
{
    expectBadPicture("This is no picture, but a sentence of some length.\n", {});
}

TEST_F(FailureTest, ReportsDirectoryInsteadOfPicture)
{
    fs::create_directory(directory() / "folder.png");
    expectRefusal({"folder.png", "old.glb"}, 3, {"folder.png", "irectory"});
}

TEST_F(FailureTest, ReportsUnreadablePicture)
{
    if (!canRespectPermissions()) {
        GTEST_SKIP() << "runs as root that cannot drop its privileges";
    }
    fs::permissions(directory() / "disc.pgm", fs::perms::none);
    CommandOptions options;
    options.respect_permissions = true;
    expectRefusal({"disc.pgm", "old.glb", "--json", "old.json"}, 3, {"disc.pgm", "Permission denied"}, options);
}

TEST_F(FailureTest, ReportsTinyFileOfAHugePicture)
{
    expectBadPicture("P5\n20000 20000\n255\nabc", {"20000"});
    // A PNG of 100000 × 100000 one-bit pixels with valid checksums and almost no data.
    constexpr std::array<unsigned char, 45> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0,    0,    0,    13,
                                                 'I',  'H', 'D', 'R', 0,    0x01, 0x86, 0xa0, 0,    0x01, 0x86, 0xa0,
                                                 1,    0,   0,   0,   0,    0x80, 0x29, 0x36, 0x65, 0,    0,    0,
                                                 0,    'I', 'E', 'N', 'D',  0xae, 0x42, 0x60, 0x82};
    expectBadPicture(std::string(kPng.begin(), kPng.end()), {"100000"});
}

TEST_F(FailureTest, ReportsUnreadableGround)
{
    const std::vector<std::string> run{"disc.pgm", "old.glb", "--json", "old.json", "--surface-depth", "1mm"};
    const auto expect_bad = [&](const std::string& path, const std::vector<std::string>& words) {
        auto arguments = run;
        arguments.insert(arguments.end(), {"--surface", path});
        auto named = words;
        named.push_back(path);
        expectRefusal(arguments, 3, named);
    };
    expect_bad("missing.png", {"No such file"});
    expect_bad("sphere.R=40mm", {"No such file"});
    fs::create_directory(directory() / "folder.png");
    expect_bad("folder.png", {"irectory"});
    const std::string whole = discPicture(64, 24.0);
    writeFile(directory() / "cut.pgm", whole.substr(0, whole.size() / 2));
    expect_bad("cut.pgm", {});
    writeFile(directory() / "empty.png", "");
    expect_bad("empty.png", {"empty"});
    writeFile(directory() / "words.png", "This is no picture, but a sentence of some length.\n");
    expect_bad("words.png", {});
}

TEST_F(FailureTest, ReportsMissingDepthOfAnIntegerHeightMap)
{
    expectRefusal({"disc.pgm", "old.glb", "--surface", "disc.pgm"}, 2, {"--surface-depth is missing", "disc.pgm"});
}

TEST_F(FailureTest, ReportsFootprintLargerThanTheGround)
{
    // The disc is 7.5 mm in radius.
    expectRefusal({"disc.pgm", "old.glb", "--surface", "sphere:R=7mm"}, 2, {"radius 7", "sphere", "must exceed 7.5"});
    expectRefusal({"disc.pgm", "old.glb", "--surface", "cylinder:R=-7mm,axis=20deg"}, 2,
                  {"radius 7", "cylinder", "must exceed 7."});
}

TEST_F(FailureTest, ReportsUnreadableObject)
{
    writeFile(directory() / "words.glb", "This is no object, but a sentence of some length.\n");
    fs::create_directory(directory() / "folder.glb");
    for (const char* object : {"missing.glb", "words.glb", "folder.glb"}) {
        expectRefusal({"disc.pgm", "old.glb", "--json", "old.json", "--onto", object}, 3, {"--onto", object});
    }
}

// A triangle whose uv are all at one place: the object is to blame, not the picture.
TEST_F(FailureTest, ReportsAnObjectWithoutAreaInUv)
{
    testing::Draft draft;
    draft.addFloats({0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F}, "VEC3");
    draft.addFloats({0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F}, "VEC2");
    writeFile(directory() / "flat.glb",
              draft.file(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                         R"({"POSITION":0,"TEXCOORD_0":1}}]}])"));
    expectRefusal({"disc.pgm", "old.glb", "--onto", "flat.glb"}, 3, {"droplet-shape: --onto flat.glb: ", "in uv"});
    expectRefusal({"disc.pgm", "old.glb", "--onto", "flat.glb", "--width", "1cm"}, 3,
                  {"droplet-shape: --onto flat.glb: ", "in uv"});
}

TEST_F(FailureTest, NamesTheOptionOfAFile)
{
    writeFile(directory() / "words.exr", "This is no picture, but a sentence of some length.\n");
    fs::create_directory(directory() / "folder");
    const auto refused = [&](const std::string& option, const std::string& value, int exit_code) {
        expectRefusal({"disc.pgm", "old.glb", option, value}, exit_code, {"droplet-shape: " + option + ": ", value});
    };
    refused("--surface", "words.exr", 3);
    refused("--surface", "missing.exr", 3);
    refused("--json", "folder", 4);
    refused("--mask-out", "nowhere/mask.png", 4);
    refused("--html", "folder", 4);
    for (const char* option : {"--ground", "--environment"}) {
        expectRefusal({"disc.pgm", "old.glb", "--preview", "p.png", option, "words.exr"}, 3,
                      {"droplet-shape: " + std::string(option) + ": words.exr"});
    }
    expectRefusal({"disc.pgm", "folder"}, 2, {"OUTPUT"});
    expectRefusal({"disc.pgm", "old.glb", "--smooth", "100m"}, 3, {"smooth less (--smooth)"});
    expectRefusal({"disc.pgm", "old.glb", "--edge", "1m"}, 2, {"the edge length (--edge) 1 m must be at most"});
    expectRefusal({"disc.pgm", "old.glb", "--surface", "sphere:R=1mm"}, 2, {"the ground's sphere (--surface)"});
}

// Fields of the library and limits of several options together.
TEST_F(FailureTest, NamesTheOptionsOfOtherCommands)
{
    writeFile(directory() / "plate.obj", "v 0 0 0\nv 40 0 0\nv 40 0 -40\nv 0 0 -40\nf 1 2 3\nf 1 3 4\n");
    writeFile(directory() / "bad.csv", "no table\n");
    writeFile(directory() / "bad.png", "no picture\n");
    const auto flow = [&](std::vector<std::string> more, int exit_code, const std::vector<std::string>& words) {
        more.insert(more.begin(), {"flow", "plate.obj", "new.glb"});
        expectRefusal(more, exit_code, words);
    };
    flow({"--drops", "1", "--volume", "100mL"}, 2, {"a droplet's volume (--volume) is 0.0001 m3"});
    flow({"--drops", "1", "--object-size", "1mm"}, 2, {"and the object (--object-size) "});
    flow({"--drops", "1", "--mask", "bad.png"}, 3, {"droplet-shape: --mask: bad.png"});
    flow({"--start", "bad.csv"}, 3, {"droplet-shape: --start: bad.csv"});
    flow({"--drops", "1", "--motion", "bad.csv"}, 3, {"droplet-shape: --motion: bad.csv"});
    flow({"--drops", "1", "--from", "0,-1,0"}, 3, {"faces the rain (--from)"});
    expectRefusal({"dew", "plate.obj", "new.glb", "--scale", "1e-9"}, 3, {"another scale or size (--scale)"});
    expectRefusal({"dew", "plate.obj", "new.glb", "--from", "0,-1,0"}, 3, {"faces the rain (--from)"});
    expectRefusal({"windshield", "new.png", "--slope", "0deg", "--time", "0.1s", "--frame-size", "96x54"}, 2,
                  {"droplet-shape: --eye-distance 0.5 m: the eye sees nothing of the glass", "(--look-at)"});
    expectRefusal({"windshield", "new.png", "--eye", "0m,1m,0m"}, 2, {"droplet-shape: --eye ", "behind the glass"});
    expectRefusal({"windshield", "new.png", "--drive-cycle", "bad.csv"}, 3, {"droplet-shape: --drive-cycle: bad.csv"});
    expectRefusal({"glyphs", "--font", "bad.png", "--text", "a", "-o", "new.glb"}, 3,
                  {"droplet-shape: --font: bad.png"});
    expectRefusal({"wind-tunnel", "--chart", "nowhere/a.png"}, 4, {"droplet-shape: --chart: output"});
    expectRefusal({"compare", "old.glb", "old.glb", "--json", "nowhere/a.json"}, 4, {"droplet-shape: --json: output"});
}

TEST_F(FailureTest, ReportsDropletsThatDoNotExist)
{
    const std::vector<std::string> run{"disc.pgm",         "old.glb", "--json",      "old.json", "-q",
                                       "--export-evolver", "old.fe",  "--triangles", "2k"};
    const auto expect_none = [&](const std::vector<std::string>& options, const std::vector<std::string>& words) {
        auto arguments = run;
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectRefusal(arguments, 5, words);
    };
    // On a wall, gravity pulls the liquid to the lower rim: the mean angle along the rim stays small.
    expect_none({"--tilt", "90deg", "--contact-angle", "150deg"}, {"on this footprint", "mean contact angle", " uL"});
    // A linear droplet that hangs from a disc has a Bond number below 3.8317², the first zero of J₁; here it is 17.
    for (const std::vector<std::string>& upside_down :
         {std::vector<std::string>{"--gravity", "-9.81m/s2"}, std::vector<std::string>{"--tilt", "180deg"}}) {
        auto options = upside_down;
        options.insert(options.end(), {"--volume", "100uL", "--width", "30mm"});
        expect_none(options, {"Bond number is 1", "at most 14."});
    }
}

TEST_F(FailureTest, ReportsPictureWithoutLiquid)
{
    expectBadPicture(greymap(32, 32, [](int, int) { return 0; }), {"liquid"});
}

TEST_F(FailureTest, ReportsPictureOfSpecksOnly)
{
    const auto specks = greymap(32, 32, [](int x, int y) { return x % 8 == 4 && y % 8 == 4 ? 255 : 0; });
    expectBadPicture(specks, {"speck"});
}

TEST_F(FailureTest, ReportsMissingFolder)
{
    expectBadOutput({"nowhere/new.glb", "--json", "old.json"}, {"nowhere/new.glb", "No such file or directory"});
    expectBadOutput({"old.glb", "--json", "nowhere/new.json"}, {"nowhere/new.json", "No such file or directory"});
    expectBadOutput({"old.glb", "--json", "old.json", "--export-evolver", "nowhere/new.fe"},
                    {"nowhere/new.fe", "No such file or directory"});
}

TEST_F(FailureTest, ReportsFileInsteadOfFolder)
{
    expectBadOutput({"disc.pgm/new.glb", "--json", "old.json"}, {"disc.pgm/new.glb", "Not a directory"});
}

TEST_F(FailureTest, ReportsDirectoryInsteadOfOutput)
{
    fs::create_directory(directory() / "folder.glb");
    expectBadOutput({"folder.glb", "--json", "old.json"}, {"folder.glb", "Is a directory"});
    expectBadOutput({"old.glb", "--json", "folder.glb"}, {"folder.glb", "Is a directory"});
}

TEST_F(FailureTest, ReportsReadOnlyFolder)
{
    if (!canRespectPermissions()) {
        GTEST_SKIP() << "runs as root that cannot drop its privileges";
    }
    const fs::path locked = directory() / "locked";
    fs::create_directory(locked);
    writeFile(locked / "old.glb", kOlder);
    fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
    CommandOptions options;
    options.respect_permissions = true;
    expectBadOutput({"locked/new.glb", "--json", "old.json"}, {"locked/new.glb", "Permission denied"}, options);
    expectBadOutput({"locked/old.glb", "--json", "old.json"}, {"locked/old.glb", "Permission denied"}, options);
    expectBadOutput({"old.glb", "--json", "locked/new.json"}, {"locked/new.json", "Permission denied"}, options);
    EXPECT_EQ(readFile(locked / "old.glb"), kOlder);
    fs::permissions(locked, fs::perms::owner_all);
}

TEST_F(FailureTest, ReportsFullDevice)
{
    for (const char* format : {"glb", "gltf", "obj", "ply", "stl"}) {
        expectBadOutput({"/dev/full", "--format", format, "--json", "old.json"}, {"/dev/full", "No space left"});
    }
    // The droplet could be written, but must not appear without its report.
    expectBadOutput({"old.glb", "--json", "/dev/full"}, {"/dev/full", "No space left"});
    expectBadOutput({"old.glb", "--json", "old.json", "--export-evolver", "/dev/full"}, {"/dev/full", "No space left"});
    expectBadOutput({"old.glb", "--json", "/dev/full", "--export-evolver", "new.fe"}, {"/dev/full", "No space left"});
}

TEST_F(FailureTest, ReportsFullStandardOutput)
{
    CommandOptions options;
    options.output_file = "/dev/full";
    expectBadOutput({"-", "--format", "stl", "--json", "old.json"}, {"No space left"}, options);
    expectBadOutput({"old.glb", "--json", "-"}, {"No space left"}, options);
}

TEST_F(FailureTest, ReportsClosedPipe)
{
    CommandOptions options;
    options.output_closed = true;
    expectBadOutput({"-", "--format", "stl", "--json", "old.json"}, {"Broken pipe"}, options);
    expectBadOutput({"old.glb", "--json", "-"}, {"Broken pipe"}, options);
}

TEST_F(FailureTest, NoClobberProtectsExistingFiles)
{
    expectBadOutput({"old.glb", "--no-clobber"}, {"old.glb", "exists"});
    expectBadOutput({"new.glb", "--json", "old.json", "--no-clobber"}, {"old.json", "exists"});
    expectBadOutput({"new.glb", "--export-evolver", "old.json", "--no-clobber"}, {"old.json", "exists"});
}

TEST_F(FailureTest, RefusesToReplaceStandardInput)
{
    const std::string before = readFile(directory() / "disc.pgm");
    const auto result = runShell("- disc.pgm --format glb < disc.pgm");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.error, HasSubstr("OUTPUT and INPUT are the same"));
    EXPECT_EQ(readFile(directory() / "disc.pgm"), before);
}

TEST_F(FailureTest, ReportsClosedStandardStreams)
{
    const auto no_input = runShell("- old.glb <&-");
    EXPECT_EQ(no_input.exit_code, 3);
    EXPECT_THAT(no_input.error, HasSubstr("standard input"));
    const auto no_output = runShell("disc.pgm - --format stl --json old.json >&-");
    EXPECT_EQ(no_output.exit_code, 4);
    EXPECT_THAT(no_output.error, HasSubstr("/dev/stdout"));
    expectOlderFiles();

    // An output file that got the number of standard error would receive its messages, too.
    EXPECT_EQ(runShell("disc.pgm silent.ply -v 2>&-").exit_code, 0);
    EXPECT_EQ(runShell("disc.pgm loud.ply -v").exit_code, 0);
    EXPECT_TRUE(readFile(directory() / "silent.ply") == readFile(directory() / "loud.ply"));
}

TEST_F(FailureTest, PrintsNamesWithLineBreaksOnOneLine)
{
    expectRefusal({"two\nlines.png", "old.glb"}, 3, {"lines.png"});
    expectRefusal({"disc.pgm", "two\nlines"}, 2, {"lines"});
    expectRefusal({"disc.pgm", "old.glb", "--width", "4\nmm"}, 2, {"--width"});
}

TEST_F(FailureTest, EscapesBytesOfNamesThatAreNotUtf8)
{
    expectRefusal({"bad\xff.png", "old.glb"}, 3, {"bad\\xff.png"});
    expectRefusal({"two\nlines.png", "old.glb"}, 3, {"two\\nlines.png"});
    expectRefusal({"disc.pgm", "old.glb", "--width", "4\xe6\xb0mm"}, 2, {"--width", "4\\xe6\\xb0mm"});
    expectRefusal({"disc.pgm", "old.glb", "--bad\xff"}, 2, {"--bad\\xff"});
    writeFile(directory() / "options.toml", "wid\xffth = 3\n");
    expectRefusal({"disc.pgm", "old.glb", "--config", "options.toml"}, 2, {"options.toml"});
    const auto result = run({"disc.pgm", "made\xff.glb", "--triangles", "500"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.error, HasSubstr("made\\xff.glb"));
}

TEST_F(FailureTest, RefusesEdgeTooShortForTheFootprint)
{
    expectRefusal({"disc.pgm", "old.glb", "--edge", "1nm", "--json", "old.json"}, 2,
                  {"--edge", "1e-06mm", "triangles", "at least"});
}

TEST_F(FailureTest, ReportsOutOfMemory)
{
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer itself takes terabytes of address space";
#endif
    const auto result = runShell("disc.pgm old.glb --triangles 5M -j 1", "ulimit -d 100000; ");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.error, ::testing::StartsWith("droplet-shape: out of memory"));
    expectOlderFiles();
}

}  // namespace
}  // namespace droplet
