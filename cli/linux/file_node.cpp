// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_node.h"

#include <sys/stat.h>
#include <unistd.h>

namespace cli {

std::optional<FileNode> nodeOf(const std::string& path)
{
    struct stat status = {};
    if (stat(path.c_str(), &status) != 0) {
        return std::nullopt;
    }
    return FileNode(status.st_dev, status.st_ino);
}

std::optional<FileNode> nodeOf(Stream stream)
{
    struct stat status = {};
    return fstat(stream == Stream::Input ? STDIN_FILENO : STDOUT_FILENO, &status) == 0 && S_ISREG(status.st_mode)
               ? std::optional(FileNode(status.st_dev, status.st_ino))
               : std::nullopt;
}

}  // namespace cli
