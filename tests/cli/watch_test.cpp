// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape --watch`: the droplet is made again whenever its picture is saved.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::CommandOptions;
using testing::CommandResult;
using testing::discPicture;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::readFile;
using testing::runDroplet;
using testing::runProgram;
using testing::ScratchDirectory;
using testing::writeFile;

CommandOptions in(const ScratchDirectory& scratch)
{
    CommandOptions options;
    options.directory = scratch.path();
    return options;
}

constexpr int kEndedBySigterm = 128 + SIGTERM;

/// Runs a script with the command in the background: `until CONDITION` waits, `$droplet` is the command, and it is
/// terminated at the end.
CommandResult runWatched(const ScratchDirectory& scratch, const std::string& script)
{
    const std::string frame = R"(set -eu
        until_true() { for _ in $(seq 1500); do if "$@"; then return; fi; sleep 0.02; done; echo "never: $*"; exit 9; }
        differ() { ! cmp -s "$1" "$2"; }
        "$0" in.pgm out.stl --watch --quiet --triangles 500 2> words.txt & droplet=$!
        trap 'kill $droplet 2> /dev/null || true' EXIT
        until_true test -s out.stl
        cp out.stl first.stl
    )" + script + R"(
        kill $droplet
        code=0
        wait $droplet || code=$?
        exit $code)";
    return runProgram({"bash", "-c", frame, testing::kCommand}, in(scratch));
}

TEST(Watch, MakesTheDropletAgainHoweverThePictureIsSaved)
{
    const ScratchDirectory scratch;
    writeFile(scratch.path() / "in.pgm", discPicture(64, 20.0));
    writeFile(scratch.path() / "large.pgm", discPicture(64, 25.0));
    writeFile(scratch.path() / "small.pgm", discPicture(64, 15.0));
    const CommandResult result = runWatched(scratch, R"(
        cp in.pgm first.pgm
        mv large.pgm in.pgm
        until_true differ out.stl first.stl
        cp out.stl large.stl
        cat small.pgm > in.pgm
        until_true differ out.stl large.stl
        cp out.stl small.stl
        cat first.pgm > in.pgm
        until_true cmp -s out.stl first.stl)");
    EXPECT_EQ(result.exit_code, kEndedBySigterm) << result.output << result.error;
    EXPECT_EQ(readFile(scratch.path() / "words.txt"), "");
    for (const std::string size : {"25", "15"}) {
        writeFile(scratch.path() / "alone.pgm", discPicture(64, std::stod(size)));
        ASSERT_EQ(runDroplet({"alone.pgm", "alone.stl", "--triangles", "500"}, in(scratch)).exit_code, 0);
        EXPECT_EQ(readFile(scratch.path() / (size == "25" ? "large.stl" : "small.stl")),
                  readFile(scratch.path() / "alone.stl"));
    }
}

TEST(Watch, GoesOnAfterAPictureThatCannotBeUsed)
{
    const ScratchDirectory scratch;
    writeFile(scratch.path() / "in.pgm", discPicture(64, 20.0));
    writeFile(scratch.path() / "large.pgm", discPicture(64, 25.0));
    writeFile(scratch.path() / "cut.pgm", "P5\n64 64\n255\n");
    const CommandResult result = runWatched(scratch, R"(
        cp cut.pgm in.pgm
        until_true test -s words.txt
        cmp out.stl first.stl
        mv large.pgm in.pgm
        until_true differ out.stl first.stl)");
    EXPECT_EQ(result.exit_code, kEndedBySigterm) << result.output << result.error;
    EXPECT_THAT(readFile(scratch.path() / "words.txt"), HasSubstr("droplet-shape: in.pgm"));
}

TEST(Watch, WaitsForAPictureThatIsNotThereYet)
{
    const ScratchDirectory scratch;
    writeFile(scratch.path() / "later.pgm", discPicture(64, 20.0));
    const CommandResult result = runProgram({"bash", "-c", R"(set -eu
        "$0" in.pgm out.stl --watch --quiet --triangles 500 2> words.txt & droplet=$!
        trap 'kill $droplet 2> /dev/null || true' EXIT
        for _ in $(seq 1500); do test -s words.txt && break; sleep 0.02; done
        mv later.pgm in.pgm
        for _ in $(seq 1500); do test -s out.stl && exit 0; sleep 0.02; done
        exit 9)",
                                             testing::kCommand},
                                            in(scratch));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(readFile(scratch.path() / "words.txt"), HasSubstr("in.pgm"));
}

TEST(Watch, EndsIfItsFolderIsGone)
{
    const ScratchDirectory scratch;
    std::filesystem::create_directory(scratch.path() / "folder");
    writeFile(scratch.path() / "folder" / "in.pgm", discPicture(64, 20.0));
    const CommandResult result = runProgram({"bash", "-c", R"(set -eu
        timeout 60 "$0" folder/in.pgm out.stl --watch --quiet --triangles 500 & droplet=$!
        for _ in $(seq 1500); do test -s out.stl && break; sleep 0.02; done
        rm -r folder
        code=0
        wait $droplet || code=$?
        exit $code)",
                                             testing::kCommand},
                                            in(scratch));
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.errorLines(), ElementsAre(HasSubstr("the folder is gone")));
}

TEST(Watch, ExcludesStreamsAndNoClobber)
{
    const ScratchDirectory scratch;
    writeFile(scratch.path() / "in.pgm", discPicture(64, 20.0));
    for (const auto& arguments : std::vector<std::vector<std::string>>{{"-", "out.stl"},
                                                                       {"in.pgm", "-", "--format", "stl"},
                                                                       {"in.pgm", "out.stl", "--json", "-"},
                                                                       {"in.pgm", "out.stl", "--html", "-"},
                                                                       {"in.pgm", "out.stl", "--no-clobber"}}) {
        std::vector<std::string> all = arguments;
        all.emplace_back("--watch");
        const CommandResult result = runDroplet(all, in(scratch));
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.errorLines(), ElementsAre(HasSubstr("--watch")));
    }
}

}  // namespace
}  // namespace droplet
