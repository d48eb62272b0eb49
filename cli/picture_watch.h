// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

namespace cli {

/// Waits until a file is saved, whether a program writes it in place or replaces it.
class PictureWatch {
public:
    /// @param path            file in an existing folder; the file itself may be missing. Of a symbolic link, the file
    ///                        that it leads to is watched
    /// @throws droplet::Error InvalidInput: the folder cannot be watched
    explicit PictureWatch(const std::filesystem::path& path);
    ~PictureWatch();
    PictureWatch(const PictureWatch&) = delete;
    PictureWatch& operator=(const PictureWatch&) = delete;

    /// Returns once the file was saved after the construction, or after the last call, and has stayed so for a moment.
    /// @throws droplet::Error InvalidInput: its folder is gone
    void wait();

private:
    struct Watched;
    std::unique_ptr<Watched> watched_;
};

}  // namespace cli
