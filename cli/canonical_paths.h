// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <unordered_map>

namespace cli {

/// Canonical paths: absolute and without symbolic links, so that each file has one.
class CanonicalPaths {
public:
    std::string of(const std::string& path);

private:
    std::unordered_map<std::string, std::string> folders_;  ///< canonical folders by given folder: many files share one
};

}  // namespace cli
