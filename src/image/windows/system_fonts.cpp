// SPDX-License-Identifier: GPL-3.0-or-later
// Windows lists its fonts in the registry: "Arial Bold (TrueType)" is arialbd.ttf in the folder of fonts, "Cambria &
// Cambria Math (TrueType)" a collection. Fonts of one user have whole paths.
#include "image/windows/system_fonts.h"

#include <windows.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

namespace droplet {
namespace {

namespace fs = std::filesystem;

struct Font {
    std::string name;  ///< in lower case
    fs::path file;
};

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

fs::path folderOfFonts()
{
    std::array<wchar_t, MAX_PATH + 1> windows{};
    ::GetWindowsDirectoryW(windows.data(), static_cast<UINT>(windows.size()));
    return fs::path(windows.data()) / "Fonts";
}

void listFonts(HKEY root, std::vector<Font>& fonts)
{
    HKEY key = nullptr;
    if (::RegOpenKeyExW(root, L"Software\\Microsoft\\Windows NT\\CurrentVersion\\Fonts", 0, KEY_READ, &key) !=
        ERROR_SUCCESS) {
        return;
    }
    std::array<wchar_t, 16384> name{};
    std::array<wchar_t, 32768> file{};
    for (DWORD i = 0;; ++i) {
        DWORD name_size = static_cast<DWORD>(name.size());
        DWORD file_size = static_cast<DWORD>(sizeof file - sizeof(wchar_t));
        DWORD type = 0;
        const LSTATUS status = ::RegEnumValueW(key, i, name.data(), &name_size, nullptr, &type,
                                               reinterpret_cast<BYTE*>(file.data()), &file_size);
        if (status != ERROR_SUCCESS) {
            break;
        }
        if (type == REG_SZ) {
            file[file_size / sizeof(wchar_t)] = L'\0';
            const fs::path path(file.data());
            fonts.push_back({lower(fs::path(std::wstring(name.data(), name_size)).string()),
                             path.has_root_path() ? path : folderOfFonts() / path});
        }
    }
    ::RegCloseKey(key);
}

const std::vector<Font>& allFonts()
{
    static const std::vector<Font> fonts = [] {
        std::vector<Font> all;
        listFonts(HKEY_LOCAL_MACHINE, all);
        listFonts(HKEY_CURRENT_USER, all);
        std::sort(all.begin(), all.end(), [](const Font& a, const Font& b) { return a.name < b.name; });
        return all;
    }();
    return fonts;
}

}  // namespace

std::vector<fs::path> systemFonts(const std::string& family)
{
    const std::string name = lower(family);
    std::vector<fs::path> files;
    for (const Font& font : allFonts()) {
        const bool begins =
            font.name.starts_with(name) && (font.name.size() == name.size() || font.name[name.size()] == ' ');
        const std::string extension = lower(font.file.extension().string());
        if (begins && (extension == ".ttf" || extension == ".otf" || extension == ".ttc") &&
            std::find(files.begin(), files.end(), font.file) == files.end()) {
            files.push_back(font.file);
        }
    }
    return files;
}

}  // namespace droplet
