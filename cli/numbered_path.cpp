// SPDX-License-Identifier: GPL-3.0-or-later
#include "numbered_path.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "droplet/error.h"
#include "option_values.h"
#include "path_separators.h"

namespace cli {

namespace fs = std::filesystem;

std::optional<NumberedPath> NumberedPath::of(const std::string& text, const std::string& subject)
{
    if (text.find('%') == std::string::npos) {
        return std::nullopt;
    }
    const Given given{text, subject};
    const std::string allowed = "a path with one %d or %04d, for the number, in the file's name";
    NumberedPath path;
    path.text_ = text;
    const auto slash = text.find_last_of(kPathSeparators.data());
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    std::size_t numbers = 0;
    std::string* part = &path.folder_;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (i == name) {
            part = &path.before_;
        }
        if (text[i] != '%') {
            part->push_back(text[i]);
        } else if (i + 1 < text.size() && text[i + 1] == '%') {
            part->push_back('%');
            ++i;
        } else {
            ++i;
            if (i + 1 < text.size() && text[i] == '0' && text[i + 1] >= '1' && text[i + 1] <= '9') {
                path.digits_ = static_cast<std::size_t>(text[i + 1] - '0');
                i += 2;
            }
            if (i >= text.size() || text[i] != 'd' || i < name || ++numbers > 1) {
                refuse(given, allowed);
            }
            part = &path.after_;
        }
    }
    if (numbers != 1) {
        refuse(given, allowed);
    }
    return path;
}

std::string NumberedPath::nameAt(std::size_t number) const
{
    return fmt::format("{}{:0{}}{}", before_, number, digits_, after_);
}

std::string NumberedPath::at(std::size_t number) const
{
    return folder_ + nameAt(number);
}

std::optional<std::size_t> NumberedPath::numberIn(const std::string& name) const
{
    if (name.size() <= before_.size() + after_.size() || name.compare(0, before_.size(), before_) != 0) {
        return std::nullopt;
    }
    const char* const begin = name.data() + before_.size();
    const char* const end = name.data() + name.size() - after_.size();
    std::size_t number = 0;
    const auto [stop, failure] = std::from_chars(begin, end, number);
    if (failure != std::errc{} || stop != end || nameAt(number) != name) {
        return std::nullopt;
    }
    return number;
}

std::vector<std::size_t> NumberedPath::numbers() const
{
    std::vector<std::size_t> numbers;
    std::error_code failure;
    for (fs::directory_iterator entry(folder_.empty() ? "." : folder_, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (const auto number = numberIn(entry->path().filename().string())) {
            numbers.push_back(*number);
        }
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

std::vector<std::pair<std::size_t, std::string>> NumberedPath::existing() const
{
    std::vector<std::size_t> numbers;
    std::error_code failure;
    for (fs::directory_iterator entry(folder_.empty() ? "." : folder_, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (const auto number = numberIn(entry->path().filename().string())) {
            numbers.push_back(*number);
        }
    }
    if (failure) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput, folder_ + ": " + failure.message());
    }
    if (numbers.empty()) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput, text_ + ": there is no such file");
    }
    std::sort(numbers.begin(), numbers.end());
    std::vector<std::pair<std::size_t, std::string>> files;
    for (const std::size_t number : numbers) {
        const std::size_t expected = numbers.front() + files.size();
        if (number != expected) {
            throw droplet::Error(droplet::ErrorCode::InvalidInput,
                                 fmt::format("{} is missing; the frames are numbered from {} to {}", at(expected),
                                             numbers.front(), numbers.back()));
        }
        files.emplace_back(number, at(number));
    }
    return files;
}

NumberedPath NumberedPath::beside(const std::string& word) const
{
    NumberedPath path = *this;
    for (std::string* const part : {&path.text_, &path.after_}) {
        part->insert(std::min(part->rfind('.'), part->size()), "-" + word);
    }
    return path;
}

std::vector<NumberedPath> withMaps(const NumberedPath& frames, const std::optional<NumberedPath>& maps,
                                   std::span<const char* const> names)
{
    std::vector<NumberedPath> all{frames};
    for (const char* const name : names) {
        if (maps) {
            all.push_back(maps->beside(name));
        }
    }
    return all;
}

}  // namespace cli
