// SPDX-License-Identifier: GPL-3.0-or-later
// Videos are read by ffmpeg, which must open no other file, and has limits of memory and time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/command.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using testing::CommandOptions;
using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;
using testing::writeFile;

TEST(Video, ListsOfOtherFilesAreRefused)
{
    const ScratchDirectory scratch;
    CommandOptions options;
    options.directory = scratch.path();
    const auto refused = [&](const std::string& name, const std::string& content) {
        writeFile(scratch.path() / name, content);
        const CommandResult result = runDroplet({"animate", name, "out.glb"}, options);
        EXPECT_EQ(result.exit_code, 3);
        EXPECT_THAT(result.errorLines(), ElementsAre(HasSubstr(name + ": is a list of other files")));
    };
    refused("list.mp4", "ffconcat version 1.0\nfile other.mp4\n");
    refused("list.m3u8", "#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:10,\nother.mp4\n#EXT-X-ENDLIST\n");
}

TEST(Video, FfmpegHasLimits)
{
    const ScratchDirectory scratch;
    const fs::path ffprobe = scratch.path() / "ffprobe";
    // The limits are set while the program already runs.
    writeFile(ffprobe,
              "#!/bin/sh\n"
              "k=0\n"
              "while [ \"$(ulimit -t)\" = unlimited ] && [ $k -lt 1000 ]; do k=$((k + 1)); done\n"
              "echo \"$(ulimit -t) $(ulimit -d) $(ulimit -c) $*\" > limits\n"
              "exit 1\n");
    fs::permissions(ffprobe, fs::perms::owner_all);
    writeFile(scratch.path() / "a.mp4", "no video");
    CommandOptions options;
    options.directory = scratch.path();
    options.environment = {{"PATH", scratch.path().string() + ":/usr/bin:/bin"}};
    EXPECT_EQ(runDroplet({"animate", "a.mp4", "out.glb"}, options).exit_code, 3);
    const std::string limits = readFile(scratch.path() / "limits");
    EXPECT_THAT(limits, ::testing::MatchesRegex("12[0-9] 8388608 0 [^\n]*\n")) << "seconds, KiB, no core file";
    EXPECT_THAT(limits, HasSubstr(" -protocol_whitelist file,pipe "));
    EXPECT_THAT(limits, HasSubstr(" -format_whitelist mov,matroska,"));
}

// What stands in for ffprobe and ffmpeg runs into the limits that it was given; of the time, a second is enough.
TEST(Video, BeyondTheLimitsIsRefused)
{
    const ScratchDirectory scratch;
    const std::string wait =
        "#!/bin/sh\n"
        "k=0\n"
        "while [ \"$(ulimit -t)\" = unlimited ] && [ $k -lt 1000 ]; do k=$((k + 1)); done\n";
    const std::string describe = "echo avg_frame_rate=25/1\necho duration=1.0\necho nb_frames=25\n";
    const std::string take_time = wait + "ulimit -S -t 1\nwhile :; do :; done\n";
    const std::string take_memory = wait + "exec dd if=/dev/zero of=/dev/null bs=9G count=1\n";
    writeFile(scratch.path() / "a.mp4", "no video");
    CommandOptions options;
    options.directory = scratch.path();
    options.environment = {{"PATH", scratch.path().string() + ":/usr/bin:/bin"}};
    const auto refused = [&](const std::string& ffprobe, const std::string& ffmpeg, const std::string& words) {
        for (const auto& [name, script] : {std::pair("ffprobe", ffprobe), std::pair("ffmpeg", ffmpeg)}) {
            writeFile(scratch.path() / name, script);
            fs::permissions(scratch.path() / name, fs::perms::owner_all);
        }
        const CommandResult result = runDroplet({"animate", "a.mp4", "out.glb"}, options);
        EXPECT_EQ(result.exit_code, 3);
        EXPECT_THAT(result.errorLines(), ElementsAre(HasSubstr(words)));
        EXPECT_FALSE(fs::exists(scratch.path() / "out.glb"));
    };
    const std::string slow = "a.mp4: a frame takes more than 120 s of processor time";
    refused(take_time, "", slow);
    refused("#!/bin/sh\n" + describe, take_time, slow);
    refused(take_memory, "", "a.mp4: ffprobe cannot read it: dd: memory exhausted");
    refused("#!/bin/sh\n" + describe, take_memory, "a.mp4: ffmpeg cannot read it: dd: memory exhausted");
}

}  // namespace
}  // namespace droplet
