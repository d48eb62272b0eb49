// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace droplet {

/// Why a file cannot be read as a picture: it is unreadable, or it does not begin like one of a format that is read. A
/// picture of another common format is named, with a program that converts it.
/// @return  one line without the path; none if the file begins like a picture, which may be damaged
std::optional<std::string> whyNoPicture(const std::filesystem::path& path);

}  // namespace droplet
