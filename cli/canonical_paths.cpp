// SPDX-License-Identifier: GPL-3.0-or-later
#include "canonical_paths.h"

#include <filesystem>
#include <system_error>

namespace cli {

namespace fs = std::filesystem;

std::string CanonicalPaths::of(const std::string& path)
{
    std::error_code ignored;
    fs::path absolute = fs::absolute(path, ignored);
    // A link to a file that does not exist yet is followed, too, as writing does.
    constexpr int kMaxLinks = 40;  // Linux's own limit
    for (int links = 0; links < kMaxLinks && fs::is_symlink(fs::symlink_status(absolute, ignored)); ++links) {
        absolute = absolute.parent_path() / fs::read_symlink(absolute, ignored);
    }
    auto [folder, is_new] = folders_.try_emplace(absolute.parent_path().string());
    if (is_new) {
        folder->second = fs::weakly_canonical(absolute.parent_path(), ignored).string();
    }
    return (fs::path(folder->second) / absolute.filename()).lexically_normal().string();
}

}  // namespace cli
