// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace droplet::testing {

/// Options of a run of a program.
struct CommandOptions {
    std::string input;                                             ///< bytes for its standard input
    std::filesystem::path directory;                               ///< working directory; ours if empty
    std::filesystem::path output_file;                             ///< receives standard output instead of the result
    bool output_closed = false;                                    ///< nobody reads its standard output
    bool error_is_terminal = false;                                ///< standard error is a pseudo-terminal
    bool respect_permissions = false;                              ///< file modes apply even to root
    std::vector<std::pair<std::string, std::string>> environment;  ///< added to ours
    /// The input is sent only once the program has written this to standard error.
    std::string input_waits_for;
};

/// Result of a run.
struct CommandResult {
    int exit_code = -1;  ///< 128 + signal if a signal ended the program
    std::string output;
    std::string error;

    /// Lines of standard error, without their line breaks.
    [[nodiscard]] std::vector<std::string> errorLines() const;
};

/// Runs the built droplet-shape and waits for it.
CommandResult runDroplet(const std::vector<std::string>& arguments, const CommandOptions& options = {});

/// Runs any program found in PATH.
CommandResult runProgram(const std::vector<std::string>& command, const CommandOptions& options = {});

/// Whether `respect_permissions` works: root must be able to drop its privileges.
bool canRespectPermissions();

/// Empty directory for the running test, removed with its contents at the end.
class ScratchDirectory {
public:
    ScratchDirectory();
    ~ScratchDirectory();
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Sorted names of all files in it, including temporary files.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

void writeFile(const std::filesystem::path& path, const std::string& bytes);
std::string readFile(const std::filesystem::path& path);

/// Binary greymap (PGM) with a given brightness of every pixel.
std::string greymap(int width, int height, const std::function<int(int x, int y)>& brightness);

/// White disc on black in the middle of a square picture, with hard edges; radius in pixels.
std::string discPicture(int size, double radius);

}  // namespace droplet::testing
