// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace droplet::testing {

/// How the program under test is started.
struct CommandOptions {
    std::string input;                                             ///< bytes for its standard input
    std::filesystem::path directory;                               ///< working directory; ours if empty
    std::filesystem::path output_file;                             ///< standard output goes there, not to the result
    bool output_closed = false;                                    ///< nobody reads its standard output
    bool error_is_terminal = false;                                ///< standard error is a pseudo-terminal
    bool respect_permissions = false;                              ///< root, too, is held to the modes of files
    std::vector<std::pair<std::string, std::string>> environment;  ///< added to ours
    /// The input is sent only once the program has written this to standard error.
    std::string input_waits_for;
};

/// What came of it.
struct CommandResult {
    int exit_code = -1;  ///< 128 + signal if one ended it
    std::string output;
    std::string error;

    /// Lines of standard error, without their line breaks.
    [[nodiscard]] std::vector<std::string> errorLines() const;
};

/// Runs the built droplet-shape and waits for it.
CommandResult runDroplet(const std::vector<std::string>& arguments, const CommandOptions& options = {});

/// Runs any program found in PATH.
CommandResult runProgram(const std::vector<std::string>& command, const CommandOptions& options = {});

/// Whether `respect_permissions` can be had: not when root may not give up its privileges.
bool canRespectPermissions();

/// An empty directory of its own for the running test, removed with its contents at the end.
class ScratchDirectory {
public:
    ScratchDirectory();
    ~ScratchDirectory();
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Names of everything in it, sorted, temporary files included.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

void writeFile(const std::filesystem::path& path, const std::string& bytes);
std::string readFile(const std::filesystem::path& path);

/// A binary greymap (PGM) with the brightness given for every pixel.
std::string greymap(int width, int height, const std::function<int(int x, int y)>& brightness);

/// A white disc on black, radius in pixels, in the middle of a square picture; hard edges.
std::string discPicture(int size, double radius);

}  // namespace droplet::testing
