// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1; G. Turk, "The PLY Polygon File Format"
// (1994); 3D Systems, "StereoLithography Interface Specification" (1989).
//
// CGAL reads STL. OBJ and PLY are read here, because other readers lose data or accept damaged files. CGAL (5.5) drops
// the normals of both, hence crisp rims, and the contact angles of PLY; it accepts an OBJ index that is one too large,
// and allocates 4 GB for a PLY of 200 bytes that claims a face of 10⁹ corners. OpenMesh (9.0) accepts truncated files
// of all three formats, skips broken vertices and so renumbers later ones, drops triangles that its half-edges cannot
// represent, opens material files that an OBJ names, and prints.
#include "io/file_mesh.h"

#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "axes.h"
#include "droplet/io/read_surface.h"
#include "droplet/units.h"
#include "file_bytes.h"
#include "io/file_material.h"
#include "io/gltf_scene.h"
#include "io/length_unit.h"
#include "io/vertex_normals.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxTriangles = std::size_t{1} << 26;  // same limit as glTF
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 34;

// ------------------------------------------------------------------------------------------------------- text

constexpr std::string_view kBlank = " \t\r";
constexpr std::string_view kWithoutUv = " without texture coordinates (uv), which place the droplets; unwrap it first";

std::string_view nextWord(std::string_view& line)
{
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlank)));
    const std::string_view word = line.substr(0, line.find_first_of(kBlank));
    line.remove_prefix(word.size());
    return word;
}

double number(std::string_view word, const std::string& where)
{
    double value = 0.0;
    if (word.starts_with('+')) {
        word.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
        throw Damage(where + " has \"" + std::string(word.substr(0, 40)) + "\" where a number should be");
    }
    return value;
}

std::optional<long long> wholeNumber(std::string_view word)
{
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

/// Lines of a text, with their numbers.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    bool next(std::string_view& line)
    {
        if (rest_.empty()) {
            return false;
        }
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++count_;
        return true;
    }
    [[nodiscard]] std::string where() const { return "line " + std::to_string(count_); }
    [[nodiscard]] std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::size_t count_ = 0;
};

// -------------------------------------------------------------------------------------------------------- all

// Below, a FileMesh is in its file's axes and unit; normals, uvs and contact angles are empty or one per position.

void addTriangle(FileMesh& mesh, std::uint64_t a, std::uint64_t b, std::uint64_t c)
{
    for (const std::uint64_t v : {a, b, c}) {
        if (v >= mesh.vertices.size()) {
            throw Damage("triangle " + std::to_string(mesh.triangles.size()) + " names vertex " + std::to_string(v) +
                         " of " + std::to_string(mesh.vertices.size()));
        }
    }
    if (mesh.triangles.size() == kMaxTriangles) {
        throw Damage("it has more than " + std::to_string(kMaxTriangles) + " triangles");
    }
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
}

/// Adds a fan of triangles about the first corner about which all of them face as the polygon does. Convex and
/// four-sided polygons have such a corner; for others it is the first one.
/// @param fans  FileMeshOptions::fans
void addPolygon(FileMesh& mesh, const std::vector<std::uint64_t>& corners, const std::vector<std::uint32_t>& fans)
{
    constexpr std::size_t kMaxSearched = 64;  // the search takes the square of the corners
    const std::size_t n = corners.size();
    std::size_t apex = 0;
    const std::size_t number = mesh.fans.size();
    if (n > 3 && number < fans.size() && fans[number] < n) {
        apex = fans[number];
    } else if (n > 3 && n <= kMaxSearched &&
               std::all_of(corners.begin(), corners.end(), [&](std::uint64_t v) { return v < mesh.vertices.size(); })) {
        const auto facet = [&](std::size_t from, std::size_t i) {
            const Vec3 at = mesh.vertices[corners[from]];
            return cross(mesh.vertices[corners[(from + i) % n]] - at, mesh.vertices[corners[(from + i + 1) % n]] - at);
        };
        Vec3 normal;
        for (std::size_t i = 1; i + 1 < n; ++i) {
            normal = normal + facet(0, i);
        }
        const auto is_fan = [&](std::size_t from) {
            bool all = true;
            for (std::size_t i = 1; i + 1 < n; ++i) {
                all = all && dot(facet(from, i), normal) > 0.0;
            }
            return all;
        };
        while (apex < n && !is_fan(apex)) {
            ++apex;
        }
    }
    if (n > 3) {
        mesh.fans.push_back(static_cast<std::uint32_t>(apex % n));
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        addTriangle(mesh, corners[apex % n], corners[(apex + i) % n], corners[(apex + i + 1) % n]);
    }
}

constexpr Vec3 kWhite{1.0, 1.0, 1.0};

Vec3 shares(Vec3 levels)
{
    return {std::clamp(levels.x, 0.0, 1.0), std::clamp(levels.y, 0.0, 1.0), std::clamp(levels.z, 0.0, 1.0)};
}

// -------------------------------------------------------------------------------------------------------- OBJ

/// Reader of OBJ. Every distinct combination of position, normal and uv in a face becomes a vertex.
class ObjReader {
public:
    explicit ObjReader(const FileMeshOptions& options) : options_(options) {}

    FileMesh read(std::string_view text)
    {
        Lines lines(withoutMark(text));
        for (std::string_view line; lines.next(line);) {
            const std::string_view key = nextWord(line);
            if (key == "v" || key == "vn") {
                Vec3 a;
                for (double* const to : {&a.x, &a.y, &a.z}) {
                    *to = number(nextWord(line), lines.where());
                }
                (key == "v" ? places_ : directions_).push_back(a);
                if (key == "v" && options_.looks) {
                    readColour(line, lines.where());
                }
            } else if (key == "vt" && options_.uvs) {
                const double u = number(nextWord(line), lines.where());
                const std::string_view v = nextWord(line);
                uvs_.push_back({u, 1.0 - (v.empty() || v.starts_with('#') ? 0.0 : number(v, lines.where()))});
            } else if (key == "usemtl") {
                useMaterial(line);
            } else if (key == "f") {
                readFace(line, lines.where());
            }
        }
        if (uvs_.empty()) {
            mesh_.uvs.clear();
        }
        if (colours_.empty()) {
            mesh_.colours.clear();
        }
        mesh_.lacks_uv = lacks_uv_ && !uvs_.empty();
        if (mesh_.material_names.size() == 1 && mesh_.material_names.front().empty()) {
            mesh_.materials.clear();
            mesh_.material_names.clear();
        }
        return std::move(mesh_);
    }

private:
    /// Distinct combination of position, normal and uv.
    struct Corner {
        std::uint32_t place = 0;
        std::uint32_t direction = kNone;
        std::uint32_t uv = kNone;

        bool operator==(const Corner&) const = default;
    };
    struct CornerHash {
        std::size_t operator()(const Corner& c) const
        {
            return ((std::uint64_t{c.place} << 32U | c.direction) ^ (std::uint64_t{c.uv} << 13U)) *
                   0x9E3779B97F4A7C15U;  // 2⁶⁴ over the golden ratio
        }
    };
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// Reads the colour after a vertex's place: three numbers, as ZBrush and MeshLab write them; one alone is a weight.
    void readColour(std::string_view line, const std::string& where)
    {
        std::array<std::string_view, 3> words;
        std::generate(words.begin(), words.end(), [&] { return nextWord(line); });
        const bool is_colour = std::none_of(words.begin(), words.end(),
                                            [](std::string_view word) { return word.empty() || word[0] == '#'; });
        if (is_colour) {
            colours_.resize(places_.size(), kWhite);
            colours_.back() = shares({number(words[0], where), number(words[1], where), number(words[2], where)});
        }
    }

    void useMaterial(std::string_view line)
    {
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlank)));
        const std::string name = materialName(line);
        const auto [found, is_new] =
            materials_.try_emplace(name, static_cast<std::uint32_t>(mesh_.material_names.size()));
        if (is_new) {
            mesh_.material_names.push_back(name);
        }
        material_ = found->second;
    }

    void readFace(std::string_view line, const std::string& where)
    {
        std::vector<std::uint64_t> corners;
        for (std::string_view word = nextWord(line); !word.empty() && !word.starts_with('#'); word = nextWord(line)) {
            corners.push_back(cornerOf(word, where));
        }
        if (corners.size() < 3) {
            throw Damage(where + " has a face with fewer than three corners");
        }
        if (!material_) {
            useMaterial({});
        }
        addPolygon(mesh_, corners, options_.fans);
        mesh_.materials.resize(mesh_.triangles.size(), *material_);
    }

    /// Parses `place`, `place/uv`, `place//normal` or `place/uv/normal`.
    std::uint32_t cornerOf(std::string_view word, const std::string& where)
    {
        const std::size_t first = std::min(word.find('/'), word.size());
        const std::size_t second = first < word.size() ? word.find('/', first + 1) : std::string_view::npos;
        Corner corner;
        corner.place = indexOf(word.substr(0, first), places_.size(), where);
        if (second != std::string_view::npos && second + 1 < word.size()) {
            corner.direction = indexOf(word.substr(second + 1), directions_.size(), where);
        }
        const std::string_view uv = first < word.size() ? word.substr(first + 1, second - first - 1) : "";
        if (options_.uvs && !uv.empty()) {
            corner.uv = indexOf(uv, uvs_.size(), where);
        }
        const auto [found, is_new] = vertices_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) {
            mesh_.vertices.push_back(places_[corner.place]);
            mesh_.normals.push_back(corner.direction != kNone ? directions_[corner.direction] : Vec3{});
            mesh_.colours.push_back(corner.place < colours_.size() ? colours_[corner.place] : kWhite);
            if (options_.needs_uv && corner.uv == kNone) {
                throw Damage(where + " has a face" + std::string(kWithoutUv));
            }
            if (options_.uvs) {
                mesh_.uvs.push_back(corner.uv != kNone ? uvs_[corner.uv] : Vec2{});
                lacks_uv_ = lacks_uv_ || corner.uv == kNone;
            }
        }
        return found->second;
    }

    /// Resolves an index: 1 is the first, −1 the last.
    static std::uint32_t indexOf(std::string_view word, std::size_t count, const std::string& where)
    {
        const std::optional<long long> value = wholeNumber(word);
        const auto max = static_cast<long long>(std::min<std::size_t>(count, 0xfffffffeU));
        const long long index = !value ? -1 : *value < 0 ? max + *value : *value - 1;
        if (index < 0 || index >= max) {
            throw Damage(where + " names \"" + std::string(word.substr(0, 40)) + "\" of " + std::to_string(count));
        }
        return static_cast<std::uint32_t>(index);
    }

    const FileMeshOptions& options_;
    FileMesh mesh_;
    std::vector<Vec3> places_;
    std::vector<Vec3> directions_;
    std::vector<Vec2> uvs_;
    std::vector<Vec3> colours_;  ///< of the first places; the others are white
    bool lacks_uv_ = false;
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertices_;
    std::unordered_map<std::string, std::uint32_t> materials_;
    std::optional<std::uint32_t> material_;  ///< of the faces that follow; empty before the first one
};

// -------------------------------------------------------------------------------------------------------- PLY

enum class Scalar { I8, U8, I16, U16, I32, U32, F32, F64 };

Scalar scalarNamed(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, Scalar>, 16> kNames = {{{"char", Scalar::I8},
                                                                             {"int8", Scalar::I8},
                                                                             {"uchar", Scalar::U8},
                                                                             {"uint8", Scalar::U8},
                                                                             {"short", Scalar::I16},
                                                                             {"int16", Scalar::I16},
                                                                             {"ushort", Scalar::U16},
                                                                             {"uint16", Scalar::U16},
                                                                             {"int", Scalar::I32},
                                                                             {"int32", Scalar::I32},
                                                                             {"uint", Scalar::U32},
                                                                             {"uint32", Scalar::U32},
                                                                             {"float", Scalar::F32},
                                                                             {"float32", Scalar::F32},
                                                                             {"double", Scalar::F64},
                                                                             {"float64", Scalar::F64}}};
    for (const auto& [known, scalar] : kNames) {
        if (known == name) {
            return scalar;
        }
    }
    throw Damage("its header has an unknown type: " + std::string(name.substr(0, 40)));
}

template <typename T>
double littleEndian(std::string_view bytes)
{
    static_assert(std::endian::native == std::endian::little);
    T value{};
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
}

/// Reader of single numbers from text or binary data.
class PlyNumbers {
public:
    PlyNumbers(std::string_view rest, bool text) : rest_(rest), text_(text) {}

    double next(Scalar scalar)
    {
        if (text_) {
            rest_.remove_prefix(std::min(rest_.size(), rest_.find_first_not_of(" \t\r\n")));
            const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
            rest_.remove_prefix(word.size());
            if (word.empty()) {
                throw Damage("it is cut short");
            }
            return number(word, "its text");
        }
        constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
        const std::size_t size = kBytes[static_cast<std::size_t>(scalar)];
        if (rest_.size() < size) {
            throw Damage("it is cut short");
        }
        const std::string_view bytes = rest_.substr(0, size);
        rest_.remove_prefix(size);
        switch (scalar) {
            case Scalar::I8:
                return littleEndian<std::int8_t>(bytes);
            case Scalar::U8:
                return littleEndian<std::uint8_t>(bytes);
            case Scalar::I16:
                return littleEndian<std::int16_t>(bytes);
            case Scalar::U16:
                return littleEndian<std::uint16_t>(bytes);
            case Scalar::I32:
                return littleEndian<std::int32_t>(bytes);
            case Scalar::U32:
                return littleEndian<std::uint32_t>(bytes);
            case Scalar::F32:
                return littleEndian<float>(bytes);
            case Scalar::F64:
                break;
        }
        return littleEndian<double>(bytes);
    }

    std::uint64_t nextWhole(Scalar scalar)
    {
        const double value = next(scalar);
        if (!(value >= 0.0 && value < 4294967296.0 && std::floor(value) == value)) {
            throw Damage("it has a count or index that is not valid");
        }
        return static_cast<std::uint64_t>(value);
    }

private:
    std::string_view rest_;
    bool text_;
};

struct PlyProperty {
    std::string name;
    Scalar scalar = Scalar::F32;
    std::optional<Scalar> count = {};  ///< type of a list's count; empty: not a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

void readPlyVertices(const PlyElement& element, PlyNumbers& numbers, const FileMeshOptions& options, FileMesh& mesh)
{
    if (!mesh.vertices.empty()) {
        throw Damage("it has two vertex elements");
    }
    const auto has = [&](const char* name) {
        return std::any_of(element.properties.begin(), element.properties.end(),
                           [&](const PlyProperty& p) { return p.name == name && !p.count; });
    };
    if (!has("x") || !has("y") || !has("z")) {
        throw Damage("its vertices have no x, y and z");
    }
    const bool normals = has("nx") && has("ny") && has("nz");
    const bool angles = has("contact_angle");
    constexpr std::array<std::pair<const char*, const char*>, 3> kUvs = {
        {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}};
    const auto uv_names = std::find_if(kUvs.begin(), kUvs.end(),
                                       [&](const auto& names) { return has(names.first) && has(names.second); });
    const bool uvs = options.uvs && uv_names != kUvs.end();
    const char* const weight_name = has("weight") ? "weight" : "red";
    const bool weights = options.weights && has(weight_name);
    const bool colours = options.looks && has("red") && has("green") && has("blue") && (!weights || has("weight"));
    for (std::uint64_t i = 0; i < element.count; ++i) {
        Vec3 p;
        Vec3 n;
        Vec2 uv;
        double angle = 0.0;
        double weight = 0.0;
        Vec3 colour;
        double other = 0.0;
        for (const PlyProperty& property : element.properties) {
            for (std::uint64_t left = property.count ? numbers.nextWhole(*property.count) : 0; left > 0; --left) {
                numbers.next(property.scalar);
            }
            if (property.count) {
                continue;
            }
            const std::string_view name = property.name;
            double& to = name == "x"                       ? p.x
                         : name == "y"                     ? p.y
                         : name == "z"                     ? p.z
                         : name == "nx"                    ? n.x
                         : name == "ny"                    ? n.y
                         : name == "nz"                    ? n.z
                         : name == "contact_angle"         ? angle
                         : weights && name == weight_name  ? weight
                         : colours && name == "red"        ? colour.x
                         : colours && name == "green"      ? colour.y
                         : colours && name == "blue"       ? colour.z
                         : uvs && name == uv_names->first  ? uv.x
                         : uvs && name == uv_names->second ? uv.y
                                                           : other;
            to = numbers.next(property.scalar);
            constexpr double kMaxLevel = 255.0;
            const std::array<const double*, 4> shares{&weight, &colour.x, &colour.y, &colour.z};
            if (property.scalar == Scalar::U8 && std::find(shares.begin(), shares.end(), &to) != shares.end()) {
                to /= kMaxLevel;
            }
        }
        mesh.vertices.push_back(p);
        if (normals) {
            mesh.normals.push_back(n);
        }
        if (uvs) {
            mesh.uvs.push_back({uv.x, 1.0 - uv.y});
        }
        if (angles) {
            mesh.contact_angles.push_back(static_cast<float>(kDegree * angle));
        }
        if (weights) {
            mesh.weights.push_back(std::clamp(weight, 0.0, 1.0));
        }
        if (colours) {
            mesh.colours.push_back(shares(colour));
        }
    }
}

void readPlyFaces(const PlyElement& element, PlyNumbers& numbers, const FileMeshOptions& options, FileMesh& mesh)
{
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            if (!property.count) {
                numbers.next(property.scalar);
                continue;
            }
            const std::uint64_t corners = numbers.nextWhole(*property.count);
            if (property.name == "vertex_indices" || property.name == "vertex_index") {
                if (corners < 3) {
                    throw Damage("face " + std::to_string(i) + " has " + std::to_string(corners) +
                                 " corners; it must have at least three");
                }
                std::vector<std::uint64_t> polygon;
                for (std::uint64_t k = 0; k < corners; ++k) {
                    polygon.push_back(numbers.nextWhole(property.scalar));
                }
                addPolygon(mesh, polygon, options.fans);
                continue;
            }
            for (std::uint64_t k = 0; k < corners; ++k) {
                numbers.next(property.scalar);
            }
        }
    }
}

/// Reads strips of triangles, as scanners and range data have them: lists of vertices in which −1 begins another strip.
/// Every second triangle of a strip winds the other way.
void readPlyStrips(const PlyElement& element, PlyNumbers& numbers, FileMesh& mesh)
{
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            std::uint64_t left = property.count ? numbers.nextWhole(*property.count) : 1;
            const bool is_strip =
                property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
            std::vector<std::uint64_t> last;  // up to three vertices
            for (bool is_odd = false; left > 0; --left) {
                const double value = numbers.next(property.scalar);
                if (!is_strip) {
                    continue;
                }
                if (value == -1.0) {
                    last.clear();
                    is_odd = false;
                    continue;
                }
                if (!(value >= 0.0 && value < 4294967296.0 && std::floor(value) == value)) {
                    throw Damage("it has a strip with an index that is not valid");
                }
                last.push_back(static_cast<std::uint64_t>(value));
                if (last.size() < 3) {
                    continue;
                }
                // Strips repeat vertices where they turn.
                if (last[0] != last[1] && last[1] != last[2] && last[2] != last[0]) {
                    addTriangle(mesh, last[is_odd ? 1 : 0], last[is_odd ? 0 : 1], last[2]);
                }
                last.erase(last.begin());
                is_odd = !is_odd;
            }
        }
    }
}

FileMesh readPly(std::string_view text, const FileMeshOptions& options)
{
    Lines lines(text);
    std::string_view line;
    const auto first_word = [&] { return nextWord(line); };
    if (!lines.next(line) || first_word() != "ply") {
        throw Damage("it does not begin with \"ply\"");
    }
    std::vector<PlyElement> elements;
    std::string format;
    bool ended = false;
    while (!ended && lines.next(line)) {
        const std::string_view key = nextWord(line);
        if (key == "format") {
            format = nextWord(line);
        } else if (key == "element") {
            PlyElement element;
            element.name = nextWord(line);
            const std::optional<long long> count = wholeNumber(nextWord(line));
            if (!count || *count < 0) {
                throw Damage(lines.where() + " has no count");
            }
            element.count = static_cast<std::uint64_t>(*count);
            elements.push_back(element);
        } else if (key == "property") {
            if (elements.empty()) {
                throw Damage(lines.where() + " has a property before any element");
            }
            PlyProperty property;
            std::string_view type = nextWord(line);
            if (type == "list") {
                property.count = scalarNamed(nextWord(line));
                type = nextWord(line);
            }
            property.scalar = scalarNamed(type);
            property.name = nextWord(line);
            elements.back().properties.push_back(property);
        }
        ended = key == "end_header";
    }
    if (!ended) {
        throw Damage("its header is cut short");
    }
    if (format != "ascii" && format != "binary_little_endian") {
        throw Damage("its format is \"" + format.substr(0, 40) + "\"; supported are ascii and binary_little_endian");
    }
    PlyNumbers numbers(lines.rest(), format == "ascii");
    FileMesh mesh;
    for (const PlyElement& element : elements) {
        if (element.properties.empty()) {
            continue;
        }
        if (element.name == "vertex") {
            readPlyVertices(element, numbers, options, mesh);
        } else if (element.name == "face") {
            readPlyFaces(element, numbers, options, mesh);
        } else if (element.name == "tristrips") {
            readPlyStrips(element, numbers, mesh);
        } else {
            for (std::uint64_t i = 0; i < element.count; ++i) {
                for (const PlyProperty& property : element.properties) {
                    for (std::uint64_t left = property.count ? numbers.nextWhole(*property.count) : 1; left > 0;
                         --left) {
                        numbers.next(property.scalar);
                    }
                }
            }
        }
    }
    return mesh;
}

// -------------------------------------------------------------------------------------------------------- STL

/// Reads STL. Normals are computed from the facets; those in the file are ignored. The checks are needed, since CGAL
/// ignores data after the last facet and treats a file that ends within the first as empty.
FileMesh readStl(std::string_view text, const FileMeshOptions& options)
{
    constexpr std::size_t kHeader = 84;
    constexpr std::size_t kFacet = 50;
    const bool has_header = text.size() >= kHeader;
    const double count = has_header ? littleEndian<std::uint32_t>(text.substr(kHeader - 4)) : 0.0;
    const bool whole = has_header && static_cast<double>(text.size()) == kHeader + count * kFacet;
    const bool as_text = text.starts_with("solid");
    if (!whole && (as_text ? text.find("endsolid") == std::string_view::npos : !has_header)) {
        throw Damage("it is cut short");
    }
    if (!whole && !as_text) {
        throw Damage("it has " + std::to_string(text.size()) + " bytes, which do not match its number of triangles");
    }
    std::istringstream in{std::string(text)};
    in.imbue(std::locale::classic());
    std::vector<CGAL::Simple_cartesian<double>::Point_3> places;
    std::vector<std::array<std::size_t, 3>> facets;
    if (!CGAL::IO::read_STL(in, places, facets)) {
        throw Damage("its text is not STL");
    }
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> first(places.size(), kNone);
    FileMesh mesh;
    for (const std::array<std::size_t, 3>& facet : facets) {
        const auto begin = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const std::size_t place : facet) {
            if (first[place] == kNone) {
                first[place] = static_cast<std::uint32_t>(mesh.vertices.size());
            }
            mesh.weld.push_back(first[place]);
            mesh.vertices.push_back({places[place].x(), places[place].y(), places[place].z()});
        }
        addTriangle(mesh, begin, begin + 1, begin + 2);
        const Vec3 a = mesh.vertices[begin];
        const Vec3 normal = cross(mesh.vertices[begin + 1] - a, mesh.vertices[begin + 2] - a);
        mesh.normals.insert(mesh.normals.end(), 3, options.creases ? Vec3{} : normal);
    }
    return mesh;
}

// ----------------------------------------------------------------------------------------------------- the end

/// Fills in normals and welds.
void complete(FileMesh& mesh, const FileMeshOptions& options)
{
    if (mesh.triangles.empty()) {
        throw Damage("it has no triangles");
    }
    if (options.needs_uv && mesh.uvs.empty()) {
        throw Damage("it is" + std::string(kWithoutUv));
    }
    mesh.normals.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec3 p = mesh.vertices[v];
        const Vec3 n = mesh.normals[v];
        const Vec2 uv = mesh.uvs.empty() ? Vec2{} : mesh.uvs[v];
        const float angle = mesh.contact_angles.empty() ? 0.0F : mesh.contact_angles[v];
        if (!std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z + uv.x + uv.y) || !std::isfinite(angle)) {
            throw Damage("it holds numbers that are not finite");
        }
    }
    if (mesh.weld.empty()) {
        mesh.weld = firstAtPlace(mesh.vertices);
    }
    completeNormals(mesh, options.creases);
}

/// Unit that this library states in a comment at the beginning of its files; millimetre for other files.
double unitIn(std::string_view text)
{
    constexpr std::size_t kComment = 160;
    const std::string_view comment = text.substr(0, kComment);
    for (const NamedUnit& unit : kLengthUnits) {
        const std::string name(unit.name);
        if (comment.find("# unit: " + name + ",") != std::string_view::npos ||
            (comment.starts_with("droplet-shape ") && comment.find(", " + name + "s,") != std::string_view::npos)) {
            return unit.metres;
        }
    }
    return kMillimetre;
}

FileMesh readAs(Format format, std::string_view text, const FileMeshOptions& options)
{
    FileMesh mesh = format == Format::Obj   ? ObjReader(options).read(text)
                    : format == Format::Stl ? readStl(text, options)
                                            : readPly(text, options);
    const double unit = format == Format::Ply ? 1.0 : unitIn(text);
    const bool turns = options.y_up.value_or(format == Format::Obj);
    for (Vec3& p : mesh.vertices) {
        p = unit * (turns ? zUp(p) : p);
    }
    for (Vec3& n : mesh.normals) {
        n = turns ? zUp(n) : n;
    }
    complete(mesh, options);
    return mesh;
}

/// Looks of an OBJ's materials; those that no library has are plain.
void takeLooks(ObjMaterials known, FileMesh& mesh)
{
    mesh.look_faults = std::move(known.faults);
    if (known.by_name.empty()) {
        return;
    }
    std::string missing;
    for (const std::string& name : mesh.material_names) {
        const auto found = known.by_name.find(name);
        mesh.looks.push_back(found != known.by_name.end() ? std::move(found->second) : plainMaterial());
        if (found == known.by_name.end() && !name.empty()) {
            missing += (missing.empty() ? "" : ", ") + name;
        }
    }
    if (!missing.empty()) {
        mesh.look_faults.push_back("its material library lacks " + missing);
    }
}

}  // namespace

void completeNormals(FileMesh& mesh, bool creases)
{
    if (creases) {
        CreasedTriangles creased = divideAtCreases(mesh.vertices, mesh.triangles, mesh.weld, mesh.normals);
        mesh.triangles = std::move(creased.triangles);
        mesh.normals = std::move(creased.normals);
        for (const std::uint32_t v : creased.copies) {
            mesh.vertices.push_back(mesh.vertices[v]);
            mesh.weld.push_back(mesh.weld[v]);
            for (std::vector<Vec3>& shape : mesh.shapes) {
                shape.push_back(shape[v]);
            }
            if (!mesh.uvs.empty()) {
                mesh.uvs.push_back(mesh.uvs[v]);
            }
            if (!mesh.contact_angles.empty()) {
                mesh.contact_angles.push_back(mesh.contact_angles[v]);
            }
            if (!mesh.weights.empty()) {
                mesh.weights.push_back(mesh.weights[v]);
            }
            if (!mesh.colours.empty()) {
                mesh.colours.push_back(mesh.colours[v]);
            }
        }
    }
    fillNormals(mesh.vertices, mesh.triangles, mesh.weld, mesh.normals);
}

FileMesh readFileMesh(const std::filesystem::path& path, const FileMeshOptions& options)
{
    const Format format = readableFormat(path);
    FileMesh mesh;
    readFile(path, [&] {
        if (format == Format::Glb || format == Format::Gltf) {
            mesh = readScene(path, {.needs_uv = options.needs_uv,
                                    .motion = options.motion,
                                    .weights = options.weights,
                                    .creases = options.creases,
                                    .looks = options.looks,
                                    .sampling = options.sampling});
            return;
        }
        std::error_code none;
        if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none)) {
            throw Damage("it is not a regular file");
        }
        const Bytes bytes = readBytes(path, kMaxBytes, [](std::byte) { return true; });
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        mesh = readAs(format, text, options);
        mesh.colours_are_levels = !mesh.colours.empty();
        if (format == Format::Obj && options.looks && !mesh.material_names.empty()) {
            takeLooks(objMaterials(text, path.parent_path()), mesh);
        }
    });
    return mesh;
}

}  // namespace droplet
