// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_message.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "files.h"

namespace cli {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Options of a list that a command has, with commas between them; if some of them are given, those alone.
std::string chosen(std::string_view list, const CommandTerms& terms)
{
    std::string known;
    std::string given;
    while (!list.empty()) {
        const std::string_view option = list.substr(0, list.find(','));
        list.remove_prefix(option.size());
        list.remove_prefix(std::min(list.find_first_not_of(", "), list.size()));
        const std::string_view name = option.substr(0, option.find(' '));
        const auto add = [&](std::string& to) { to.append(to.empty() ? "" : ", ").append(option); };
        if (contains(terms.options, name)) {
            add(known);
        }
        if (contains(terms.given, name)) {
            add(given);
        }
    }
    return given.empty() ? known : given;
}

/// Where a message begins to speak of a field: at its beginning or after a colon.
std::size_t findField(const std::string& message, std::string_view field)
{
    for (std::size_t at = message.find(field); at != std::string::npos; at = message.find(field, at + 1)) {
        const std::size_t end = at + field.size();
        const bool begins = at == 0 || (at > 1 && message.compare(at - 2, 2, ": ") == 0);
        if (begins && end < message.size() && (message[end] == ' ' || message[end] == ':')) {
            return at;
        }
    }
    return std::string::npos;
}

/// Whether a message names a path, as its subject: before a colon, in quotation marks or as the first word.
bool speaksOf(const std::string& message, const std::string& path)
{
    for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path, at + 1)) {
        const char before = at == 0 ? ' ' : message[at - 1];
        const std::size_t end = at + path.size();
        const char after = end < message.size() ? message[end] : ':';
        const bool is_word = (before == ' ' && (after == ':' || (after == ' ' && at == 0)));
        if (is_word || (before == '"' && after == '"')) {
            return true;
        }
    }
    return false;
}

/// Whether a message names one of a pattern's files, in quotation marks as output.
bool speaksOf(const std::string& message, const NumberedPath& pattern)
{
    const std::size_t begin = message.find('"');
    const std::size_t end = begin == std::string::npos ? begin : message.find('"', begin + 1);
    if (end == std::string::npos) {
        return false;
    }
    const std::string path = message.substr(begin + 1, end - begin - 1);
    const std::optional<std::size_t> number = pattern.numberIn(std::filesystem::path(path).filename().string());
    return number && pattern.at(*number) == path;
}

/// The option of a file's name, such as `a buffer of --onto`; empty for arguments.
std::string optionOf(const NamedFile& file)
{
    const std::size_t begin = file.name.find("--");
    return begin == std::string::npos ? "" : file.name.substr(begin);
}

}  // namespace

std::span<const NamedOption> namedOptions()
{
    static constexpr std::array kAll{NamedOption{"number of triangles", "--triangles"},
                                     NamedOption{"shorten the edges", "--edge"},
                                     NamedOption{"the edge length", "--edge"},
                                     NamedOption{"a smaller contact angle", "--contact-angle"},
                                     NamedOption{"less gravity or a smaller width", "--gravity, --width"},
                                     NamedOption{"check the footprint's width", "--width, --pixel-size, --em"},
                                     NamedOption{"a given volume", "--volume"},
                                     NamedOption{"ask for less liquid", "--contact-angle, --volume, --height"},
                                     NamedOption{"ask for less", "--contact-angle, --volume, --height"},
                                     NamedOption{"of the ground's sphere", "--surface"},
                                     NamedOption{"of the ground's cylinder", "--surface"},
                                     NamedOption{"the channel is alpha", "--channel"},
                                     NamedOption{"a segmentation method or a threshold", "--segment, --threshold"},
                                     NamedOption{"the segmentation method", "--segment"},
                                     NamedOption{"reaches the threshold", "--threshold"},
                                     NamedOption{"or a colour", "--colour"},
                                     NamedOption{"the speck size", "--speck-size"},
                                     NamedOption{"use the exact model", "--model exact"},
                                     NamedOption{"use the linear model", "--model linear"},
                                     NamedOption{"prevent penetration", "--no-penetration"},
                                     NamedOption{"the arc", "--arc"},
                                     NamedOption{"the text's path", "--path"},
                                     NamedOption{"another scale or size", "--scale, --object-size"},
                                     NamedOption{"a smaller object", "--scale, --object-size"},
                                     NamedOption{"and the object", "--scale, --object-size"},
                                     NamedOption{"a droplet's volume", "--volume, --radius, --volume-spread, --start"},
                                     NamedOption{"faces the rain", "--from"},
                                     NamedOption{"is in the mask", "--mask"},
                                     NamedOption{"has weight", "--vertex-weights"},
                                     NamedOption{"sees the outside", "--inside"},
                                     NamedOption{"a shorter time", "--time"},
                                     NamedOption{"fewer frames per second", "--fps"},
                                     NamedOption{"fewer droplets", "--drops"},
                                     NamedOption{"use a smaller width", "--map-width"},
                                     NamedOption{"look at the glass", "--look-at"},
                                     NamedOption{"face index", "--face-index"},
                                     NamedOption{"smooth less", "--smooth"},
                                     NamedOption{"let less flow in", "--feed"},
                                     NamedOption{"take shorter steps", "--slow, --fps"}};
    return kAll;
}

std::span<const NamedOption> namedFields()
{
    static constexpr std::array kAll{NamedOption{"emitter.place", "--emitter"},
                                     NamedOption{"eye_distance", "--eye-distance"},
                                     NamedOption{"eye", "--eye"},
                                     NamedOption{"look_at", "--look-at"},
                                     NamedOption{"inflow", "--feed"},
                                     NamedOption{"glass.width", "--glass-width"},
                                     NamedOption{"the glass's area", "--glass-width, --glass-height"}};
    return kAll;
}

std::string withOptions(std::string message, const CommandTerms& terms)
{
    for (const auto& [field, options] : namedFields()) {
        const std::string known = chosen(options, terms);
        const auto at = known.empty() ? std::string::npos : findField(message, field);
        if (at != std::string::npos) {
            message.replace(at, field.size(), known);
        }
    }
    for (const auto& [phrase, options] : namedOptions()) {
        const std::string known = chosen(options, terms);
        const auto at = message.find(phrase);
        if (at != std::string::npos && !known.empty() && message.find(known) == std::string::npos) {
            message.insert(at + phrase.size(), " (" + known + ")");
        }
    }
    return message;
}

std::string withOptionOfFile(const std::string& message, const RunFiles& files)
{
    std::string best;
    std::size_t longest = 0;  // a path may be part of another one
    for (const auto* const list : {&files.read, &files.written}) {
        for (const NamedFile& file : *list) {
            const bool is_named = file.pattern ? speaksOf(message, *file.pattern) : speaksOf(message, file.path);
            if (is_named && file.path.size() > longest) {
                longest = file.path.size();
                best = optionOf(file);
            }
        }
    }
    return best.empty() || message.find(best) != std::string::npos ? message : best + ": " + message;
}

}  // namespace cli
