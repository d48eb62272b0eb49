// SPDX-License-Identifier: GPL-3.0-or-later
// "VTK XML formats", docs.vtk.org: PolyData and UnstructuredGrid. An XML library would refuse appended raw data, which
// is not XML; of the tags only names and attributes are needed.
#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <array>

#include "file_bytes.h"
#include "liquid2d_io/raw_particles.h"

namespace droplet {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

struct Tag {
    std::string_view name;  ///< with '/' before it at the end of an element
    std::string_view attributes;
    std::string_view rest;  ///< of the file behind the tag

    [[nodiscard]] std::string_view attribute(std::string_view wanted) const
    {
        std::string_view left = attributes;
        while (!left.empty()) {
            const std::size_t equals = left.find('=');
            if (equals == std::string_view::npos) {
                break;
            }
            std::string_view key = left.substr(0, equals);
            key = takeWord(key);
            left.remove_prefix(equals + 1);
            left.remove_prefix(std::min(left.find_first_not_of(kBlank), left.size()));
            if (left.empty() || (left[0] != '"' && left[0] != '\'')) {
                break;
            }
            const std::size_t end = left.find(left[0], 1);
            if (end == std::string_view::npos) {
                break;
            }
            if (key == wanted) {
                return left.substr(1, end - 1);
            }
            left.remove_prefix(end + 1);
        }
        return {};
    }
};

/// Takes the next tag off; its name is empty at the end of the file.
Tag takeTag(std::string_view& text)
{
    for (;;) {
        const std::size_t begin = text.find('<');
        if (begin == std::string_view::npos) {
            return {};
        }
        text.remove_prefix(begin + 1);
        const bool is_comment = text.starts_with("!--");
        const std::size_t end = text.find(is_comment ? "-->" : ">");
        if (end == std::string_view::npos) {
            throw Damage("it is cut off");
        }
        std::string_view inside = text.substr(0, end);
        text.remove_prefix(end + (is_comment ? 3 : 1));
        if (is_comment || inside.starts_with('?') || inside.starts_with('!')) {
            continue;
        }
        const std::string_view name = inside.substr(0, inside.find_first_of(" \t\r\n/", 1));
        return {name, inside.substr(name.size()), text};
    }
}

NumberType typeNamed(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, NumberType>, 10> kTypes{{{"Float32", NumberType::Float32},
                                                                              {"Float64", NumberType::Float64},
                                                                              {"Int8", NumberType::Int8},
                                                                              {"UInt8", NumberType::UInt8},
                                                                              {"Int16", NumberType::Int16},
                                                                              {"UInt16", NumberType::UInt16},
                                                                              {"Int32", NumberType::Int32},
                                                                              {"UInt32", NumberType::UInt32},
                                                                              {"Int64", NumberType::Int64},
                                                                              {"UInt64", NumberType::UInt64}}};
    const auto* const found =
        std::find_if(kTypes.begin(), kTypes.end(), [name](const auto& t) { return t.first == name; });
    if (found == kTypes.end()) {
        throw Damage("the type of an array is " + quotedShort(name));
    }
    return found->second;
}

/// Stored bytes, raw or in base64.
class Stored {
public:
    Stored(std::string_view text, bool base64) : text_(text), base64_(base64) {}

    /// Longest possible take().
    [[nodiscard]] std::size_t left() const { return base64_ ? text_.size() / 4 * 3 : text_.size(); }

    /// Bytes of one run, which in base64 ends with its padding.
    std::string take(std::size_t count)
    {
        std::string bytes = peek(count);
        text_.remove_prefix(base64_ ? (count + 2) / 3 * 4 : count);
        return bytes;
    }

    [[nodiscard]] std::string peek(std::size_t count) const
    {
        if (count > left()) {
            throw Damage("it is cut off");
        }
        if (!base64_) {
            return std::string(text_.substr(0, count));
        }
        std::string bytes;
        bytes.reserve(count + 2);
        for (std::size_t at = 0; bytes.size() < count; at += 4) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                bits = bits << 6U | sextet(text_[at + k]);
            }
            for (const unsigned shift : {16U, 8U, 0U}) {
                bytes += static_cast<char>(bits >> shift & 0xFFU);
            }
        }
        bytes.resize(count);
        return bytes;
    }

private:
    static std::uint32_t sextet(char c)
    {
        constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos && c != '=') {
            throw Damage("its base64 holds other characters");
        }
        return c == '=' ? 0U : static_cast<std::uint32_t>(digit);
    }

    std::string_view text_;
    bool base64_;
};

class VtkXml {
public:
    explicit VtkXml(std::string_view bytes) : rest_(bytes) {}

    RawParticles read()
    {
        head();
        appended();
        std::string section;
        bool has_piece = false;
        for (Tag tag = takeTag(rest_); !tag.name.empty() && tag.name != "AppendedData"; tag = takeTag(rest_)) {
            if (tag.name == "Piece") {
                endPiece();
                has_piece = true;
                begin_ = particles_.position.size();
                points_ = countIn(tag.attribute("NumberOfPoints"), "particles");
            } else if (tag.name == "Points" || tag.name == "PointData" || tag.name == "FieldData") {
                section = tag.name;
            } else if (tag.name == "/Points" || tag.name == "/PointData" || tag.name == "/FieldData") {
                section.clear();
            } else if (tag.name == "DataArray" && !section.empty()) {
                array(tag, section);
            }
        }
        if (!has_piece) {
            throw Damage("it has no Piece");
        }
        endPiece();
        return std::move(particles_);
    }

private:
    void head()
    {
        const Tag file = takeTag(rest_);
        if (file.name != "VTKFile") {
            throw Damage("it does not begin with VTKFile");
        }
        const std::string_view type = file.attribute("type");
        if (type != "PolyData" && type != "UnstructuredGrid") {
            throw Damage("its type is " + quotedShort(type) + ", must be PolyData or UnstructuredGrid");
        }
        order_ = file.attribute("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
        header_ = file.attribute("header_type") == "UInt64" ? 8 : 4;
        const std::string_view compressor = file.attribute("compressor");
        compressed_ = !compressor.empty();
        if (compressed_ && compressor != "vtkZLibDataCompressor") {
            throw Damage("it is compressed by " + quotedShort(compressor) + ", must be vtkZLibDataCompressor or none");
        }
    }

    /// Finds the appended data, if there are any.
    void appended()
    {
        const std::size_t begin = rest_.find("<AppendedData");
        if (begin == std::string_view::npos) {
            return;
        }
        std::string_view text = rest_.substr(begin);
        const Tag tag = takeTag(text);
        appended_base64_ = tag.attribute("encoding") == "base64";
        const std::size_t mark = text.find('_');
        appended_ = mark == std::string_view::npos ? std::string_view{} : text.substr(mark + 1);
    }

    void endPiece() const
    {
        if (particles_.position.size() != begin_ + points_) {
            throw Damage("a Piece has no Points");
        }
    }

    void array(const Tag& tag, std::string_view section)
    {
        const std::string_view width = tag.attribute("NumberOfComponents");
        const std::size_t components = width.empty() ? 1 : countIn(width, "components", 100);
        const std::string name = lowerCase(tag.attribute("Name"));
        if (section == "FieldData") {
            const std::string_view tuples = tag.attribute("NumberOfTuples");
            if ((name == "timevalue" || name == "time") && components == 1 && tuples == "1") {
                particles_.time = numbers(tag, 1).front();
            }
            return;
        }
        const ParticleRole role = section == "Points" ? ParticleRole::Position : roleOf(name, components);
        if (role == ParticleRole::Position && components != 3) {
            throw Damage("its Points do not have three components");
        }
        if (lacks(particles_, role, begin_)) {
            append(particles_, role, components, numbers(tag, components * points_));
        }
    }

    [[nodiscard]] std::vector<double> numbers(const Tag& tag, std::size_t count) const
    {
        const NumberType type = typeNamed(tag.attribute("type"));
        const std::string_view format = tag.attribute("format");
        const std::string_view inside = tag.rest.substr(0, tag.rest.find('<'));
        if (format == "ascii" || format.empty()) {
            std::string_view text = inside;
            std::vector<double> values = takeNumbers(text, count);
            if (!takeWord(text).empty()) {
                throw Damage("array " + quotedShort(tag.attribute("Name")) + " has more numbers than particles");
            }
            return values;
        }
        const std::size_t bytes = count * sizeOf(type);
        if (format == "binary") {
            const std::size_t begin = std::min(inside.find_first_not_of(kBlank), inside.size());
            const std::size_t end = std::max(begin, inside.find_last_not_of(kBlank) + 1);
            return numbersIn(stored({inside.substr(begin, end - begin), true}, bytes), type, count, order_);
        }
        if (format != "appended") {
            throw Damage("the format of an array is " + quotedShort(format));
        }
        const std::size_t offset = countIn(tag.attribute("offset"), "bytes before an array", appended_.size());
        return numbersIn(stored({appended_.substr(offset), appended_base64_}, bytes), type, count, order_);
    }

    [[nodiscard]] std::uint64_t word(std::string_view bytes, std::size_t k) const
    {
        return unsignedIn(bytes.substr(k * header_, header_), order_);
    }

    static void requireLength(std::uint64_t found, std::size_t bytes)
    {
        if (found != bytes) {
            throw Damage(fmt::format("an array has {} bytes, its particles need {}", found, bytes));
        }
    }

    /// Bytes of an array behind its header.
    [[nodiscard]] std::string stored(Stored source, std::size_t bytes) const
    {
        if (!compressed_) {
            requireLength(word(source.peek(header_), 0), bytes);
            std::string all = source.take(header_ + bytes);
            return all.substr(header_);
        }
        const std::uint64_t blocks = word(source.peek(header_), 0);
        if (blocks > source.left() / header_) {
            throw Damage("it is cut off");
        }
        const std::string header = source.take((3 + static_cast<std::size_t>(blocks)) * header_);
        if (blocks == 0) {
            requireLength(0, bytes);
            return {};
        }
        const std::uint64_t whole = word(header, 1);
        const std::uint64_t last = word(header, 2) == 0 ? whole : word(header, 2);
        constexpr std::uint64_t kMost = std::uint64_t{1} << 32U;
        if (whole > kMost || last > kMost) {
            throw Damage("a block is longer than its array");
        }
        requireLength((blocks - 1) * whole + last, bytes);
        std::size_t packed = 0;
        for (std::size_t k = 0; k < blocks; ++k) {
            const std::uint64_t length = word(header, 3 + k);
            if (length > source.left() - packed) {
                throw Damage("it is cut off");
            }
            packed += static_cast<std::size_t>(length);
        }
        if (bytes / 1100 > packed) {  // zlib packs no more than 1032 bytes into one
            throw Damage("a block does not unpack");
        }
        const std::string data = source.take(packed);
        std::string unpacked(bytes, '\0');
        std::size_t from = 0;
        std::size_t to = 0;
        for (std::size_t k = 0; k < blocks; ++k) {
            const auto length = static_cast<std::size_t>(word(header, 3 + k));
            const auto expected = static_cast<std::size_t>(k + 1 < blocks ? whole : last);
            uLongf size = expected;
            if (uncompress(reinterpret_cast<Bytef*>(unpacked.data() + to), &size,
                           reinterpret_cast<const Bytef*>(data.data() + from), length) != Z_OK ||
                size != expected) {
                throw Damage("a block does not unpack");
            }
            from += length;
            to += expected;
        }
        return unpacked;
    }

    std::string_view rest_;
    std::string_view appended_;
    bool appended_base64_ = false;
    bool compressed_ = false;
    std::endian order_ = std::endian::little;
    std::size_t header_ = 4;  ///< bytes of a number in headers
    std::size_t begin_ = 0;   ///< first particle of the piece
    std::size_t points_ = 0;  ///< of the piece
    RawParticles particles_;
};

}  // namespace

RawParticles readVtkXml(std::string_view bytes)
{
    return VtkXml(bytes).read();
}

}  // namespace droplet
