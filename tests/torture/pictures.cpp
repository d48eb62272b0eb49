// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "torture/corpus.h"

namespace droplet::torture {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIcons = "/usr/share/icons/elementary-xfce";

std::vector<fs::path> filesBelow(const fs::path& folder)
{
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        // A theme has many names for one picture.
        if (entry.is_regular_file() && !entry.is_symlink()) {
            found.push_back(entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::byte> contentOf(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string content(std::istreambuf_iterator<char>(file), {});
    if (!file) {
        throw std::runtime_error(path.string() + " cannot be read");
    }
    std::vector<std::byte> bytes(content.size());
    std::transform(content.begin(), content.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

Corpus corpusOf(const std::string& name, std::vector<fs::path> paths)
{
    const std::size_t count = paths.size();
    return {name, count, [paths = std::move(paths)](std::size_t index) {
                return Item{paths[index].string(), contentOf(paths[index])};
            }};
}

}  // namespace

Item greymapItem(const std::string& name, const Mask& mask)
{
    const std::string header = "P5\n" + std::to_string(mask.width) + " " + std::to_string(mask.height) + "\n65535\n";
    Item item{name, {}};
    item.bytes.reserve(header.size() + 2 * mask.coverage.size());
    for (const char c : header) {
        item.bytes.push_back(static_cast<std::byte>(c));
    }
    for (const std::uint16_t level : mask.coverage) {
        item.bytes.push_back(static_cast<std::byte>(level >> 8));
        item.bytes.push_back(static_cast<std::byte>(level & 255));
    }
    return item;
}

Corpus icons()
{
    if (!fs::is_directory(kIcons)) {
        throw std::runtime_error(std::string(kIcons) + " is missing; it comes with elementary-xfce-icon-theme");
    }
    std::vector<fs::path> pictures = filesBelow(kIcons);
    std::erase_if(pictures, [](const fs::path& path) { return path.extension() != ".png"; });
    if (pictures.empty()) {
        throw std::runtime_error(std::string("there is no PNG below ") + kIcons);
    }
    return corpusOf("icons", std::move(pictures));
}

Corpus files(const std::vector<fs::path>& paths)
{
    std::vector<fs::path> all;
    for (const fs::path& path : paths) {
        if (fs::is_directory(path)) {
            const std::vector<fs::path> below = filesBelow(path);
            all.insert(all.end(), below.begin(), below.end());
        } else {
            all.push_back(path);
        }
    }
    if (all.empty()) {
        throw std::runtime_error("there are no files in " + paths.front().string());
    }
    return corpusOf("files", std::move(all));
}

}  // namespace droplet::torture
