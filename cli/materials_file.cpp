// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials_file.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <utility>

#include "droplet/error.h"
#include "option_values.h"
#include "text_lines.h"

namespace cli {
namespace {

constexpr double kMaxIor = 4.0;  // as in RenderOptions

/// Reader of one file.
class Reader {
public:
    explicit Reader(std::string path) : path_(std::move(path)) {}

    [[nodiscard]] Materials read() const
    {
        Materials materials{path_, {}};
        for (const auto& [key, value] : parse()) {
            const toml::array* const tables = value.as_array();
            if (key.str() != "droplet" || tables == nullptr || tables->empty()) {
                refuse(value, fmt::format("'{}' is unknown; allowed are tables [[droplet]]", key.str()));
            }
            for (const toml::node& table : *tables) {
                if (!table.is_table()) {
                    refuse(table, "'droplet' must be a table: [[droplet]]");
                }
                materials.entries.push_back(entryOf(*table.as_table()));
            }
        }
        if (materials.entries.empty()) {
            cli::refuse(fmt::format("--materials: {} has no table [[droplet]]", path_));
        }
        return materials;
    }

private:
    [[nodiscard]] toml::table parse() const
    {
        std::string text;
        for (const std::string& line : readLines("--materials", path_)) {
            text += line + "\n";
        }
        try {
            return toml::parse(text);
        } catch (const toml::parse_error& error) {
            cli::refuse(fmt::format("--materials: {}:{}: {}", path_, error.source().begin.line, error.description()));
        }
    }

    [[noreturn]] void refuse(const toml::node& at, const std::string& reason) const
    {
        cli::refuse(fmt::format("--materials: {}:{}: {}", path_, at.source().begin.line, reason));
    }

    [[nodiscard]] MaterialEntry entryOf(const toml::table& table) const
    {
        MaterialEntry entry;
        bool has_index = false;
        for (const auto& [key, value] : table) {
            const std::string_view name = key.str();
            if (name == "index") {
                entry.index = indexOf(value);
                has_index = true;
            } else if (name == "material") {
                entry.material = materialOf(value);
            } else if (name == "colour") {
                entry.colour = colourOf(value);
            } else if (name == "roughness") {
                entry.roughness = numberOf(value, name, 0.0, 1.0, "a number from 0 to 1");
            } else if (name == "ior") {
                entry.ior = numberOf(value, name, 1.0, kMaxIor, "a number from 1 to 4");
            } else {
                refuse(value,
                       fmt::format("'{}' is unknown; allowed are index, material, colour, roughness, ior", name));
            }
        }
        if (!has_index) {
            refuse(table, "index is missing; it must be \"all\" or the number of a droplet, from 1");
        }
        return entry;
    }

    [[nodiscard]] std::optional<std::size_t> indexOf(const toml::node& value) const
    {
        if (value.value_exact<std::string>() == "all") {
            return std::nullopt;
        }
        const auto number = value.value_exact<std::int64_t>();
        if (!number || *number < 1) {
            refuse(value, "index must be \"all\" or the number of a droplet, from 1");
        }
        return static_cast<std::size_t>(*number - 1);
    }

    [[nodiscard]] droplet::Material materialOf(const toml::node& value) const
    {
        try {
            return droplet::materialNamed(value.value_exact<std::string>().value_or(""));
        } catch (const droplet::Error& error) {
            refuse(value, error.what());
        }
    }

    [[nodiscard]] droplet::CssColour colourOf(const toml::node& value) const
    {
        try {
            return droplet::parseCssColour(value.value_exact<std::string>().value_or(""));
        } catch (const droplet::Error&) {
            refuse(value, "colour must be a colour such as \"red\", \"#e30613\" or \"#f00\"");
        }
    }

    [[nodiscard]] double numberOf(const toml::node& value, std::string_view name, double min, double max,
                                  const char* allowed) const
    {
        const auto number = value.is_number() ? value.value<double>() : std::nullopt;
        if (!number || !(*number >= min && *number <= max)) {
            refuse(value, fmt::format("{} must be {}", name, allowed));
        }
        return *number;
    }

    std::string path_;
};

}  // namespace

Materials readMaterials(const std::string& path)
{
    return Reader(path).read();
}

droplet::Look inColour(droplet::Look look, const droplet::CssColour& colour)
{
    look.colour = droplet::linearLight(colour);
    look.tinted = look.transmission > 0.0;
    return look;
}

std::vector<std::string> applyMaterials(const Materials& materials, std::vector<droplet::Look>& looks)
{
    std::vector<std::string> warnings;
    for (const MaterialEntry& entry : materials.entries) {
        if (entry.index && *entry.index >= looks.size()) {
            warnings.push_back(fmt::format("--materials: {} names droplet {}, but there are only {}", materials.path,
                                           *entry.index + 1, looks.size()));
            continue;
        }
        const std::size_t begin = entry.index.value_or(0);
        const std::size_t end = entry.index ? *entry.index + 1 : looks.size();
        for (std::size_t k = begin; k < end; ++k) {
            droplet::Look& look = looks[k];
            if (entry.material) {
                look = droplet::lookOf(*entry.material);
            }
            if (entry.colour) {
                look = inColour(std::move(look), *entry.colour);
                look.name += "_" + droplet::fileName(*entry.colour);
            }
            if (entry.roughness) {
                look.roughness = *entry.roughness;
                look.name += fmt::format("_roughness_{:g}", look.roughness);
            }
            if (entry.ior) {
                look.ior = *entry.ior;
                look.name += fmt::format("_ior_{:g}", look.ior);
            }
        }
    }
    return warnings;
}

}  // namespace cli
