// SPDX-License-Identifier: GPL-3.0-or-later
// "VTK file formats", docs.vtk.org: simple legacy formats, versions 2.0 to 5.1. Binary numbers are big-endian.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "file_bytes.h"
#include "liquid2d_io/raw_particles.h"

namespace droplet {
namespace {

NumberType typeNamed(std::string_view word)
{
    constexpr std::array<std::pair<std::string_view, NumberType>, 17> kTypes{{
        {"float", NumberType::Float32},
        {"double", NumberType::Float64},
        {"int", NumberType::Int32},
        {"unsigned_int", NumberType::UInt32},
        {"vtkidtype", NumberType::Int32},  // the writer narrows it
        {"vtktypeint64", NumberType::Int64},
        {"vtktypeuint64", NumberType::UInt64},
        {"long", NumberType::Int64},
        {"unsigned_long", NumberType::UInt64},
        {"long_long", NumberType::Int64},
        {"unsigned_long_long", NumberType::UInt64},
        {"short", NumberType::Int16},
        {"unsigned_short", NumberType::UInt16},
        {"char", NumberType::Int8},
        {"signed_char", NumberType::Int8},
        {"unsigned_char", NumberType::UInt8},
        {"vtktypeint32", NumberType::Int32},
    }};
    const std::string lower = lowerCase(word);
    for (const auto& [name, type] : kTypes) {
        if (name == lower) {
            return type;
        }
    }
    throw Damage("the type of an array is " + quotedShort(word));
}

class VtkLegacy {
public:
    explicit VtkLegacy(std::string_view bytes) : rest_(bytes)
    {
        line();
        line();
        const std::string kind = lowerCase(takeWord(rest_));
        binary_ = kind == "binary";
        if (!binary_ && kind != "ascii") {
            throw Damage("its third line is neither ASCII nor BINARY");
        }
        line();
    }

    RawParticles read()
    {
        std::string_view word = takeWord(rest_);
        if (lowerCase(word) != "dataset") {
            throw Damage("DATASET is missing");
        }
        const std::string set = lowerCase(takeWord(rest_));
        if (set != "polydata" && set != "unstructured_grid") {
            throw Damage("its DATASET is " + quotedShort(set) + ", must be POLYDATA or UNSTRUCTURED_GRID");
        }
        for (word = takeWord(rest_); !word.empty(); word = takeWord(rest_)) {
            section(lowerCase(word));
        }
        if (!has_points_) {
            throw Damage("it has no POINTS");
        }
        return std::move(particles_);
    }

private:
    std::string_view line()
    {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        const std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        return text;
    }

    /// Numbers that begin on the next line; kept only if wanted.
    std::vector<double> numbers(std::size_t count, NumberType type, bool wanted)
    {
        if (!binary_) {
            std::vector<double> values = takeNumbers(rest_, count);
            return wanted ? values : std::vector<double>{};
        }
        line();
        if (count > rest_.size() / sizeOf(type)) {
            throw Damage("it is cut off");
        }
        std::vector<double> values;
        if (wanted) {
            values = numbersIn(rest_, type, count, std::endian::big);
        }
        rest_.remove_prefix(count * sizeOf(type));
        return values;
    }

    void array(std::string_view name, std::size_t components, std::size_t tuples, NumberType type)
    {
        const ParticleRole role = on_points_ ? roleOf(name, components) : ParticleRole::None;
        const bool wanted = lacks(particles_, role, 0);
        const std::vector<double> values = numbers(components * tuples, type, wanted);
        if (wanted) {
            append(particles_, role, components, values);
        }
    }

    void cells()
    {
        const std::size_t first = countIn(takeWord(rest_), "cells", 2 * kMaxParticles);
        const std::size_t second = countIn(takeWord(rest_), "entries of cells", 4 * kMaxParticles);
        std::string_view ahead = rest_;
        if (binary_) {
            ahead.remove_prefix(std::min(ahead.find('\n'), ahead.size()));
        }
        if (lowerCase(takeWord(ahead)) != "offsets") {
            numbers(second, NumberType::Int32, false);
            return;
        }
        for (const std::size_t count : {first, second}) {  // OFFSETS, CONNECTIVITY
            takeWord(rest_);
            const NumberType type = typeNamed(takeWord(rest_));
            numbers(count, type, false);
        }
    }

    void field()
    {
        takeWord(rest_);
        const std::size_t arrays = countIn(takeWord(rest_), "arrays", 10000);
        for (std::size_t k = 0; k < arrays; ++k) {
            std::string_view name = takeWord(rest_);
            if (name == "METADATA") {
                metadata();
                name = takeWord(rest_);
            }
            const std::size_t components = countIn(takeWord(rest_), "components", 100);
            const std::size_t tuples = countIn(takeWord(rest_), "tuples");
            const NumberType type = typeNamed(takeWord(rest_));
            const std::string lower = lowerCase(name);
            if (section_ == Section::None && components * tuples == 1 && (lower == "time" || lower == "timevalue")) {
                particles_.time = numbers(1, type, true).front();
                continue;
            }
            if (on_points_ && tuples != points_) {
                throw Damage(fmt::format("{} has {} values for {} particles", quotedShort(name), tuples, points_));
            }
            array(name, components, tuples, type);
        }
    }

    void metadata()
    {
        line();
        while (!rest_.empty() && !line().empty()) {
        }
    }

    void points()
    {
        points_ = countIn(takeWord(rest_), "particles");
        if (has_points_) {
            throw Damage("it has POINTS twice");
        }
        has_points_ = true;
        const NumberType type = typeNamed(takeWord(rest_));
        append(particles_, ParticleRole::Position, 3, numbers(3 * points_, type, true));
    }

    void beginData(bool on_points)
    {
        section_ = on_points ? Section::Points : Section::Cells;
        on_points_ = on_points;
        tuples_ = countIn(takeWord(rest_), "tuples", 2 * kMaxParticles);
        if (on_points && tuples_ != points_) {
            throw Damage(fmt::format("POINT_DATA has {} values for {} particles", tuples_, points_));
        }
    }

    void scalars()
    {
        const std::string_view name = takeWord(rest_);
        const NumberType type = typeNamed(takeWord(rest_));
        std::string_view ahead = rest_.substr(0, rest_.find('\n'));
        std::size_t components = 1;
        if (const std::string_view word = takeWord(ahead); !word.empty()) {
            components = countIn(word, "components", 4);
            takeWord(rest_);
        }
        ahead = rest_;
        if (lowerCase(takeWord(ahead)) == "lookup_table") {
            takeWord(ahead);
            rest_ = ahead;
        }
        array(name, components, tuples_, type);
    }

    void section(const std::string& word)
    {
        if (word == "points") {
            points();
        } else if (word == "vertices" || word == "lines" || word == "polygons" || word == "triangle_strips" ||
                   word == "cells") {
            cells();
        } else if (word == "cell_types") {
            const std::size_t count = countIn(takeWord(rest_), "cells", 2 * kMaxParticles);
            numbers(count, NumberType::Int32, false);
        } else if (word == "point_data" || word == "cell_data") {
            beginData(word == "point_data");
        } else if (word == "field") {
            field();
        } else if (word == "metadata") {
            metadata();
        } else if (word == "scalars") {
            scalars();
        } else if (word == "vectors" || word == "normals" || word == "tensors" || word == "global_ids" ||
                   word == "pedigree_ids") {
            const std::string_view name = takeWord(rest_);
            const NumberType type = typeNamed(takeWord(rest_));
            const std::size_t components = word == "tensors" ? 9 : word.ends_with("ids") ? 1 : 3;
            array(name, components, tuples_, type);
        } else if (word == "texture_coordinates") {
            takeWord(rest_);
            const std::size_t components = countIn(takeWord(rest_), "components", 3);
            const NumberType type = typeNamed(takeWord(rest_));
            numbers(components * tuples_, type, false);
        } else if (word == "color_scalars" || word == "lookup_table") {
            takeWord(rest_);
            const std::size_t count = countIn(takeWord(rest_), "colours", 2 * kMaxParticles);
            numbers(word == "lookup_table" ? 4 * count : count * tuples_, NumberType::UInt8, false);
        } else {
            throw Damage(quotedShort(word) + " stands where a section begins");
        }
    }

    enum class Section { None, Points, Cells };

    std::string_view rest_;
    bool binary_ = false;
    bool has_points_ = false;
    bool on_points_ = false;
    Section section_ = Section::None;
    std::size_t points_ = 0;
    std::size_t tuples_ = 0;
    RawParticles particles_;
};

}  // namespace

RawParticles readVtkLegacy(std::string_view bytes)
{
    return VtkLegacy(bytes).read();
}

}  // namespace droplet
