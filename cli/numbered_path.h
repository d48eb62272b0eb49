// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

/// A path with a place for a number, as in `frames/%04d.png`; `%%` stands for a percent sign.
class NumberedPath {
public:
    /// @param subject          of messages: what the path is of
    /// @return                 nothing if there is no percent sign in it
    /// @throws droplet::Error InvalidArgument if it is no such path: another place than one %d or %0Nd in the file's
    ///                         name, N from 1 to 9
    static std::optional<NumberedPath> of(const std::string& text, const std::string& subject);

    [[nodiscard]] std::string at(std::size_t number) const;
    /// As it was given.
    [[nodiscard]] const std::string& text() const { return text_; }
    /// The number of a path that is one of these.
    [[nodiscard]] std::optional<std::size_t> numberOf(const std::string& path) const;
    /// Numbers of the files there are, in order; none if there is no such folder.
    [[nodiscard]] std::vector<std::size_t> numbers() const;
    /// The path with a word in the number's place.
    [[nodiscard]] std::string with(const std::string& word) const { return folder_ + before_ + word + after_; }

    /// The files there are, with their numbers, which follow one another.
    /// @throws droplet::Error InvalidInput if there is none, or one is missing between two others
    [[nodiscard]] std::vector<std::pair<std::size_t, std::string>> existing() const;

private:
    /// The number of a file's name.
    [[nodiscard]] std::optional<std::size_t> numberIn(const std::string& name) const;
    [[nodiscard]] std::string nameAt(std::size_t number) const;

    std::string text_;    ///< as given
    std::string folder_;  ///< with a slash behind it, or empty
    std::string before_;  ///< of the file's name
    std::string after_;
    std::size_t digits_ = 0;  ///< at least, with zeros before
};

}  // namespace cli
