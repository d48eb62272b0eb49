// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library names fields and files. The user has typed options: here fields and files become options.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "command_terms.h"
#include "droplet/error.h"
#include "run_files.h"

namespace cli {

/// Words of the library's messages, and the options that they speak of.
struct NamedOption {
    std::string_view words;
    std::string_view options;  ///< with commas between them
};

/// All phrases that options belong to. The options are added behind them.
std::span<const NamedOption> namedOptions();

/// All fields that options belong to. The options take their places.
std::span<const NamedOption> namedFields();

/// Message of the library with the command's options in it: the library speaks of a number of triangles, the command of
/// a number of triangles (--triangles). An option that the message has already is not added again, nor is one that the
/// command does not have. Where one of several options is given, it is named alone.
std::string withOptions(std::string message, const CommandTerms& terms);

/// Message with the option of the file that it speaks of before it: --mask: spots.png is empty. Arguments are not
/// named, as their files say enough.
std::string withOptionOfFile(const std::string& message, const RunFiles& files);

/// Runs a function, and puts the command's options into the message of an error.
/// @throws droplet::Error as the function throws it, but for the message
template <typename Function>
auto inTermsOf(const CommandTerms& terms, const RunFiles& files, const Function& run)
{
    try {
        return run();
    } catch (const droplet::Error& error) {
        throw droplet::Error(error.code(), withOptionOfFile(withOptions(error.what(), terms), files));
    }
}

}  // namespace cli
