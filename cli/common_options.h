// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "droplet/io/output.h"
#include "droplet/scene/format.h"

namespace cli {

inline constexpr std::size_t kMaxThreads = 1024;  // more than any machine this runs on

enum class Verbosity { Quiet, Normal, Verbose };

enum class ProgressMode {
    Auto,  ///< a bar on a terminal, after one second
    None,
    Json,  ///< a line of JSON per stage, no summary
};

/// Options of every run.
struct RunOptions {
    std::optional<std::string> config;  ///< path of the configuration file
    droplet::OutputOptions files;
    std::optional<std::size_t> threads;
    Verbosity verbosity = Verbosity::Normal;
    ProgressMode progress = ProgressMode::Auto;
    CommandTerms terms;  ///< for messages

    /// Progress to show: none of a quiet run that does not ask for it.
    [[nodiscard]] ProgressMode shownProgress() const;
};

inline constexpr NumberRange kFrameRate{1.0, 1000.0, "a number from 1 to 1000"};
/// Range of the thickness of water that is white in a texture.
inline constexpr Range kMapThickness{droplet::Dimension::Length, 1e-6, 1.0, "from 1um to 1m"};

/// Declares --threads, --quiet, --config, --help and --version.
/// @param example  line of a configuration file, for the help
void declareCommon(CommandLine& line, const char* group, const std::string& example);

/// Declares --progress of a command that goes through stages.
/// @param percents  when there is a line for each percent, for the help
void declareStageProgress(CommandLine& line, const char* group, const std::string& percents);

/// Declares --progress of a command that makes frames.
void declareFrameProgress(CommandLine& line, const char* group);

/// Declares --compress; readCompression() reads it.
void declareCompression(CommandLine& line, const char* group);

/// Compression of a file; Compression::None if --compress is not given.
/// @param format          of the file
/// @throws droplet::Error InvalidArgument, naming the option and what is allowed
droplet::Compression readCompression(const CommandLine& line, droplet::Format format);

/// Declares --droplets-only of a command that places droplets on an object; hasObject() reads it.
void declareDropletsOnly(CommandLine& line, const char* group, const std::string& when = "");

/// Whether a file of droplets on an object has the object, too: in formats that show scenes, without --droplets-only.
/// @param output          path, for the message
/// @throws droplet::Error InvalidArgument: --droplets-only with a format that holds the droplets alone
bool hasObject(const CommandLine& line, droplet::Format format, const std::string& output);

/// Text that --help or --version prints, if one of them is given.
std::optional<std::string> requestedText(const CommandLine& line);

/// Value of --threads; empty for all cores.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
std::optional<std::size_t> readThreads(const CommandLine& line);

/// Reads --threads, --quiet, --verbose, --progress, --no-clobber and --config, as far as the command has them.
/// @throws droplet::Error InvalidArgument, naming option, value and what is allowed
RunOptions readRun(const CommandLine& line);

/// Text of the given options that decide what the frames of a film show: all but those of every run, and `neutral`.
/// @param output  path of the frames
std::string optionsOfFrames(const CommandLine& line, const std::string& output,
                            const std::vector<std::string>& neutral = {});

}  // namespace cli
