// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_node.h"

#include <windows.h>

#include <filesystem>

namespace cli {
namespace {

std::optional<FileNode> nodeOfHandle(HANDLE file)
{
    BY_HANDLE_FILE_INFORMATION information{};
    if (::GetFileType(file) != FILE_TYPE_DISK || ::GetFileInformationByHandle(file, &information) == FALSE) {
        return std::nullopt;
    }
    return FileNode(information.dwVolumeSerialNumber,
                    std::uint64_t{information.nFileIndexHigh} << 32U | information.nFileIndexLow);
}

}  // namespace

std::optional<FileNode> nodeOf(const std::string& path)
{
    // Backup semantics open folders, too.
    const HANDLE file =
        ::CreateFileW(std::filesystem::path(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                      nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (file == INVALID_HANDLE_VALUE) {
        return std::nullopt;
    }
    const auto node = nodeOfHandle(file);
    ::CloseHandle(file);
    return node;
}

std::optional<FileNode> nodeOf(Stream stream)
{
    return nodeOfHandle(::GetStdHandle(stream == Stream::Input ? STD_INPUT_HANDLE : STD_OUTPUT_HANDLE));
}

}  // namespace cli
