// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/file_material.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <system_error>

namespace droplet {
namespace {

constexpr std::uint64_t kMaxImage = std::uint64_t{256} << 20U;   // [bytes]
constexpr std::uint64_t kMaxLibrary = std::uint64_t{16} << 20U;  // [bytes], of a .mtl

std::optional<std::filesystem::path> beside(const std::filesystem::path& folder, std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::filesystem::path path(std::u8string(name.begin(), name.end()));
    const bool is_inside = !name.empty() && path.is_relative() && name.find(':') == std::string::npos &&
                           std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
    std::error_code none;
    return is_inside && std::filesystem::is_regular_file(folder / path, none) ? std::optional(folder / path)
                                                                              : std::nullopt;
}

std::string restOf(std::istringstream& line)
{
    std::string rest;
    std::getline(line >> std::ws, rest);
    rest.erase(rest.find_last_not_of(" \t\r") + 1);
    return rest;
}

void readLibrary(std::string_view text, const std::filesystem::path& folder,
                 std::map<std::string, FileMaterial>& materials)
{
    std::istringstream in{std::string(text)};
    FileMaterial* material = nullptr;
    for (std::string written; std::getline(in, written);) {
        std::istringstream line(written);
        line.imbue(std::locale::classic());
        std::string key;
        line >> key;
        if (key == "newmtl") {
            material = &materials.insert_or_assign(restOf(line), plainMaterial()).first->second;
            continue;
        }
        if (material == nullptr) {
            continue;
        }
        Look& look = material->look;
        const auto share = [&](const auto& set) {
            if (double value = 0.0; line >> value && std::isfinite(value)) {
                set(std::clamp(value, 0.0, 1.0));
            }
        };
        if (key == "Kd") {
            share([&](double value) { look.colour = {value, value, value}; });
            share([&](double value) { look.colour.y = value; });
            share([&](double value) { look.colour.z = value; });
        } else if (key == "d") {
            share([&](double value) { material->opacity = value; });
        } else if (key == "Tr") {
            share([&](double value) { material->opacity = 1.0 - value; });
        } else if (key == "Pr") {
            share([&](double value) { look.roughness = value; });
        } else if (key == "Pm") {
            share([&](double value) { look.metallic = value; });
        } else if (key == "Ns") {
            // Blinn's exponent as roughness: B. Burley, "Physically Based Shading at Disney" (2012), α = r².
            if (double value = 0.0; line >> value && value >= 0.0) {
                look.roughness = std::pow(2.0 / (value + 2.0), 0.25);
            }
        } else if (key == "Ni") {
            if (double value = 0.0; line >> value && value >= 1.0 && value <= 4.0) {
                look.ior = value;
            }
        } else if (key == "map_Kd") {
            if (const std::string name = restOf(line); !name.starts_with('-')) {
                readImageBeside(folder, name, *material);
            }
        }
    }
}

}  // namespace

FileMaterial plainMaterial()
{
    FileMaterial material;
    material.look.colour = {0.6, 0.6, 0.6};
    material.look.roughness = 0.6;
    material.look.transmission = 0.0;
    material.look.ior = 1.5;
    return material;
}

void readImageBeside(const std::filesystem::path& folder, const std::string& name, FileMaterial& material)
{
    const auto path = beside(folder, name);
    if (!path) {
        material.image_fault = name + " is not a file beside it";
        return;
    }
    try {
        material.image = readBytes(*path, kMaxImage, [](std::byte) { return true; });
    } catch (const Damage& damage) {
        material.image_fault = name + " " + damage.what();
    }
}

std::map<std::string, FileMaterial> objMaterials(std::string_view text, const std::filesystem::path& folder)
{
    std::map<std::string, FileMaterial> materials;
    constexpr std::string_view kKey = "mtllib";
    for (std::size_t at = text.find(kKey); at != std::string_view::npos; at = text.find(kKey, at + kKey.size())) {
        if (at > 0 && text[at - 1] != '\n') {
            continue;
        }
        std::istringstream line(std::string(text.substr(at + kKey.size(), text.find('\n', at) - at - kKey.size())));
        const auto path = beside(folder, restOf(line));
        if (!path) {
            continue;
        }
        try {
            const Bytes bytes = readBytes(*path, kMaxLibrary, [](std::byte) { return true; });
            readLibrary({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path->parent_path(), materials);
        } catch (const Damage&) {
            continue;  // as if it were not there
        }
    }
    return materials;
}

}  // namespace droplet
