// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cli {

/// Path with a placeholder for a number, as in `frames/%04d.png`; `%%` stands for a percent sign.
class NumberedPath {
public:
    /// Parses a path.
    /// @param subject          name of the path's option in messages
    /// @return                 nothing if the text has no percent sign
    /// @throws droplet::Error InvalidArgument unless the file's name has exactly one %d or %0Nd, N from 1 to 9
    static std::optional<NumberedPath> of(const std::string& text, const std::string& subject);

    /// Path of one number.
    [[nodiscard]] std::string at(std::size_t number) const;
    /// Pattern as given.
    [[nodiscard]] const std::string& text() const { return text_; }
    /// Name of one file, without its folder.
    [[nodiscard]] std::string nameAt(std::size_t number) const;
    /// Number in a file's name, if it matches the pattern.
    [[nodiscard]] std::optional<std::size_t> numberIn(const std::string& name) const;
    /// Numbers of the existing files, in order; empty if the folder does not exist.
    [[nodiscard]] std::vector<std::size_t> numbers() const;
    /// Path with a word instead of the number.
    [[nodiscard]] std::string with(const std::string& word) const { return folder_ + before_ + word + after_; }

    /// Pattern of another file for each number, with `-word` before the extension, such as `maps/%04d-normal.png`.
    [[nodiscard]] NumberedPath beside(const std::string& word) const;

    /// Existing files with their consecutive numbers.
    /// @throws droplet::Error InvalidInput if there is none, or a number is missing
    [[nodiscard]] std::vector<std::pair<std::size_t, std::string>> existing() const;

private:
    std::string text_;        ///< as given
    std::string folder_;      ///< with a trailing slash, or empty
    std::string before_;      ///< part of the file's name before the number
    std::string after_;       ///< part of the file's name behind the number
    std::size_t digits_ = 0;  ///< minimum number of digits, padded with zeros
};

/// Patterns of all files of a frame: its own, and one for each of its maps.
/// @param maps   pattern of the maps, if there are any
/// @param names  of the maps
std::vector<NumberedPath> withMaps(const NumberedPath& frames, const std::optional<NumberedPath>& maps,
                                   std::span<const char* const> names);

}  // namespace cli
