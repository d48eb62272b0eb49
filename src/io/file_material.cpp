// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/file_material.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <locale>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

namespace droplet {
namespace {

constexpr std::uint64_t kMaxImage = std::uint64_t{256} << 20U;   // [bytes]
constexpr std::uint64_t kMaxLibrary = std::uint64_t{16} << 20U;  // [bytes], of a .mtl

/// File that another one names: a path to a place in its folder, or else the last part of any path, since programs
/// write the places of the computer that they ran on.
std::optional<std::filesystem::path> beside(const std::filesystem::path& folder, std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    std::filesystem::path path(std::u8string(name.begin(), name.end()));
    if (path.has_root_path() || name.find(':') != std::string::npos) {
        path = path.relative_path();
    }
    // The path, or the longest end of it that is there; ".." and what comes before it name no place in the folder.
    for (std::error_code none; !path.empty();) {
        const bool is_inside = std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
        if (is_inside && std::filesystem::is_regular_file(folder / path, none)) {
            return folder / path;
        }
        std::filesystem::path shorter;
        for (auto part = std::next(path.begin()); part != path.end(); ++part) {
            shorter /= *part;
        }
        path = shorter;
    }
    return std::nullopt;
}

/// A name as it may be meant: with blanks, in quotes, or before a comment.
/// @return  the first that is a file beside another one, else the first
std::string meant(const std::string& written, const std::filesystem::path& folder)
{
    std::vector<std::string> names{written};
    if (const std::size_t comment = written.find(" #"); comment != std::string::npos) {
        names.push_back(written.substr(0, written.find_last_not_of(" \t", comment) + 1));
    }
    if (const std::string& last = names.back(); last.size() > 2 && last.front() == '"' && last.back() == '"') {
        names.push_back(last.substr(1, last.size() - 2));
    }
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return beside(folder, name).has_value(); });
    return found != names.end() ? *found : names.back();
}

std::string restOf(std::istringstream& line)
{
    std::string rest;
    std::getline(line >> std::ws, rest);
    rest.erase(rest.find_last_not_of(" \t\r") + 1);
    return rest;
}

/// Statement of a texture: options, then the name of a file.
struct TextureLine {
    std::string name;
    double bump = 1.0;       ///< option -bm
    TexturePlace place;      ///< options -s and -o
    std::string is_ignored;  ///< an option that changes what is seen; or empty
};

std::optional<double> numberIn(const std::string& word)
{
    std::istringstream in(word);
    in.imbue(std::locale::classic());
    double value = 0.0;
    return in >> value && in.eof() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

TextureLine textureLine(std::istringstream& line)
{
    TextureLine texture;
    std::string rest = restOf(line);
    const auto take_word = [&] {
        const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
        std::string word = rest.substr(0, end);
        rest.erase(0, std::min(rest.find_first_not_of(" \t", end), rest.size()));
        return word;
    };
    Vec2 scale{1.0, 1.0};
    Vec2 offset;
    while (rest.starts_with('-')) {
        const std::string option = take_word();
        if (option == "-s" || option == "-o" || option == "-t") {
            Vec2& to = option == "-s" ? scale : offset;
            for (int k = 0; k < 3; ++k) {
                const auto value = numberIn(rest.substr(0, rest.find_first_of(" \t")));
                if (!value) {
                    break;
                }
                take_word();
                if (option == "-t") {
                    texture.is_ignored = *value != 0.0 ? option : texture.is_ignored;
                } else if (k < 2) {
                    (k == 0 ? to.x : to.y) = *value;
                }
            }
        } else if (option == "-mm") {
            take_word();
            take_word();
            texture.is_ignored = option;
        } else {
            const std::string value = take_word();
            texture.bump = option == "-bm" ? numberIn(value).value_or(1.0) : texture.bump;
        }
    }
    texture.name = std::move(rest);
    // In the file v counts from below.
    texture.place.scale = scale;
    texture.place.offset = {offset.x, 1.0 - scale.y - offset.y};
    return texture;
}

FileTexture readTexture(const TextureLine& line, const std::filesystem::path& folder)
{
    if (line.name.empty()) {
        return {};
    }
    FileTexture texture = readTextureBeside(folder, meant(line.name, folder));
    texture.place = line.place;
    if (texture.fault.empty() && !line.is_ignored.empty()) {
        texture.fault = "is shown without the material's option " + line.is_ignored;
    }
    return texture;
}

/// What a library says of a material, and what follows from all of it.
struct ObjMaterial {
    FileMaterial material = plainMaterial();
    std::optional<Vec3> filter;  ///< Tf
    bool has_opacity = false;
    bool has_roughness = false;
    bool has_glow = false;
    int illumination = 2;

    FileMaterial finish() &&
    {
        constexpr std::array<int, 2> kRefracts = {6, 7};
        if (std::find(kRefracts.begin(), kRefracts.end(), illumination) != kRefracts.end()) {
            material.refracts = true;
            material.look.transmission = has_opacity ? 1.0 - material.opacity : 1.0;
            material.opacity = 1.0;
            material.look.colour = filter.value_or(material.look.colour);
            material.look.roughness = has_roughness ? material.look.roughness : 0.0;
        }
        if (!has_glow && !material.glows.image.empty()) {
            material.glow = {1.0, 1.0, 1.0};
        }
        return std::move(material);
    }
};

/// Channels of a colour; those that are missing are the first.
/// @param max  of a channel
std::optional<Vec3> colourIn(std::istringstream& line, double max = 1.0)
{
    Vec3 colour;
    if (!(line >> colour.x)) {
        return std::nullopt;
    }
    if (!(line >> colour.y >> colour.z)) {
        colour.y = colour.z = colour.x;
    }
    const auto share = [max](double a) { return std::isfinite(a) ? std::clamp(a, 0.0, max) : 1.0; };
    return Vec3{share(colour.x), share(colour.y), share(colour.z)};
}

void readStatement(std::string key, std::istringstream& line, const std::filesystem::path& folder, ObjMaterial& to)
{
    if (key.starts_with("map_")) {
        std::transform(key.begin(), key.end(), key.begin(),  // map_kd is written, too
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    }
    FileMaterial& material = to.material;
    Look& look = material.look;
    const auto number = [&]() -> std::optional<double> {
        double value = 0.0;
        return line >> value && std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    const auto share = [&](double otherwise) { return std::clamp(number().value_or(otherwise), 0.0, 1.0); };
    if (key == "Kd") {
        look.colour = colourIn(line).value_or(look.colour);
    } else if (key == "Tf") {
        to.filter = colourIn(line);
    } else if (key == "d" || key == "Tr") {
        const double value = share(key == "d" ? 1.0 : 0.0);
        material.opacity = key == "d" ? value : 1.0 - value;
        to.has_opacity = material.opacity < 1.0;  // "d 1" stands in files of all kinds of glass
    } else if (key == "illum") {
        to.illumination = static_cast<int>(std::clamp(number().value_or(2.0), 0.0, 10.0));
    } else if (key == "Pr") {
        look.roughness = share(look.roughness);
        to.has_roughness = true;
    } else if (key == "Pm") {
        look.metallic = share(look.metallic);
    } else if (key == "Ns") {
        // Blinn's exponent as roughness: B. Burley, "Physically Based Shading at Disney" (2012), α = r².
        if (const auto value = number(); value && *value >= 0.0) {
            look.roughness = std::pow(2.0 / (*value + 2.0), 0.25);
            to.has_roughness = true;
        }
    } else if (key == "Ni") {
        if (const auto value = number(); value && *value >= 1.0 && *value <= 4.0) {
            look.ior = *value;
        }
    } else if (key == "Ke") {
        material.glow = colourIn(line, kMaxGlow).value_or(material.glow);
        to.has_glow = true;
    } else if (key == "map_kd") {
        material.colours = readTexture(textureLine(line), folder);
    } else if (key == "map_ke") {
        material.glows = readTexture(textureLine(line), folder);
    } else if (key == "map_d") {
        material.coverage = readTexture(textureLine(line), folder);
    } else if (key == "norm" || key == "map_bump" || key == "bump") {
        const TextureLine texture = textureLine(line);
        material.normals = readTexture(texture, folder);
        material.relief = texture.bump;
    }
}

void readLibrary(std::string_view text, const std::filesystem::path& folder,
                 std::map<std::string, FileMaterial>& materials)
{
    std::string lines(withoutMark(text));
    std::replace(lines.begin(), lines.end(), '\r', '\n');  // old files have no other ends of lines
    std::istringstream in(std::move(lines));
    std::optional<std::string> name;
    ObjMaterial material;
    const auto keep = [&] {
        if (name) {
            materials.insert_or_assign(*name, std::exchange(material, {}).finish());
        }
    };
    for (std::string written; std::getline(in, written);) {
        std::istringstream line(written);
        line.imbue(std::locale::classic());
        std::string key;
        line >> key;
        if (key == "newmtl") {
            keep();
            name = materialName(restOf(line));
        } else if (name) {
            readStatement(key, line, folder, material);
        }
    }
    keep();
}

/// Names in a statement of libraries: one with blanks if that is a file, else words.
std::vector<std::string> librariesIn(std::istringstream& line, const std::filesystem::path& folder)
{
    const std::string rest = restOf(line);
    const std::string whole = meant(rest, folder);
    if (beside(folder, whole)) {
        return {whole};
    }
    std::istringstream words(rest);
    std::vector<std::string> names;
    for (std::string word; words >> word && word != "#";) {
        names.push_back(word);
    }
    const bool are_files = std::any_of(names.begin(), names.end(),
                                       [&](const std::string& name) { return beside(folder, name).has_value(); });
    return are_files ? names : std::vector{whole};
}

}  // namespace

std::string_view withoutMark(std::string_view text)
{
    constexpr std::string_view kMark = "\xef\xbb\xbf";  // UTF-8's byte order mark
    return text.substr(text.starts_with(kMark) ? kMark.size() : 0);
}

std::string materialName(std::string_view written)
{
    const std::size_t comment = std::min(written.find(" #"), written.find("\t#"));
    std::string_view name = written.substr(0, comment);
    name = name.substr(0, name.find_last_not_of(" \t\r") + 1);
    return std::string(name);
}

FileMaterial plainMaterial()
{
    FileMaterial material;
    material.look.colour = {0.6, 0.6, 0.6};
    material.look.roughness = 0.6;
    material.look.transmission = 0.0;
    material.look.ior = 1.5;
    return material;
}

FileTexture readTextureBeside(const std::filesystem::path& folder, const std::string& name)
{
    FileTexture texture;
    texture.name = name;
    const auto path = beside(folder, name);
    if (!path) {
        texture.fault = "is not a file beside it or in a folder there";
        return texture;
    }
    try {
        texture.image = readBytes(*path, kMaxImage, [](std::byte) { return true; });
        texture.fault = texture.image.empty() ? "is empty" : "";
    } catch (const Damage& damage) {
        texture.fault = damage.what();
    }
    return texture;
}

ObjMaterials objMaterials(std::string_view text, const std::filesystem::path& folder)
{
    ObjMaterials materials;
    constexpr std::string_view kKey = "mtllib";
    text = withoutMark(text);
    for (std::size_t at = text.find(kKey); at != std::string_view::npos; at = text.find(kKey, at + kKey.size())) {
        if (at > 0 && text[at - 1] != '\n') {
            continue;
        }
        std::istringstream line(std::string(text.substr(at + kKey.size(), text.find('\n', at) - at - kKey.size())));
        for (const std::string& name : librariesIn(line, folder)) {
            const auto path = beside(folder, name);
            if (!path) {
                materials.faults.push_back(name + " is not a file beside it or in a folder there");
                continue;
            }
            try {
                const Bytes bytes = readBytes(*path, kMaxLibrary, [](std::byte) { return true; });
                const std::string_view library(reinterpret_cast<const char*>(bytes.data()), bytes.size());
                if (library.find('\0') != std::string_view::npos) {
                    materials.faults.push_back(name + " is not text in UTF-8");
                    continue;
                }
                readLibrary(library, path->parent_path(), materials.by_name);
            } catch (const Damage& damage) {
                materials.faults.push_back(name + ": " + damage.what());
            }
        }
    }
    return materials;
}

}  // namespace droplet
