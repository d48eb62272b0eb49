// SPDX-License-Identifier: GPL-3.0-or-later
//
// Glyphs are loaded without hinting at one pixel per font unit, in 64ths of a pixel. So FreeType scales nothing, and
// variable fonts keep fractions of units, which they lose if they are loaded unscaled.

#include "type/font_face.h"

#include <ft2build.h>
#include FT_COLOR_H
#include FT_FREETYPE_H
#include FT_MULTIPLE_MASTERS_H
#include FT_OUTLINE_H
#include FT_SFNT_NAMES_H
#include FT_TRUETYPE_IDS_H
#include FT_TRUETYPE_TABLES_H
#include <hb-ft.h>
#include <hb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <initializer_list>
#include <utility>

#include "droplet/error.h"
#include "file_bytes.h"
#include "number_text.h"
#include "type/bitmap_glyph.h"

namespace droplet {
namespace {

constexpr FT_Int32 kLoadFlags = FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;
constexpr FT_Int32 kLoadBitmapFlags = FT_LOAD_NO_HINTING | FT_LOAD_COLOR;

/// Largest distance of a point from its origin [em]; only damaged data exceed it.
constexpr double kFarthest = 256.0;

std::string tagText(FT_ULong tag)
{
    std::string text;
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
        const auto c = static_cast<unsigned char>((tag >> shift) & 0xffU);
        text += c >= 0x20 && c < 0x7f ? static_cast<char>(c) : '?';
    }
    return text;
}

double fixed(FT_Fixed value)
{
    return static_cast<double>(value) / 65536.0;
}

std::string rangesOf(const std::vector<FontAxis>& axes)
{
    std::string text;
    for (const FontAxis& axis : axes) {
        text += fmt::format("{}{} from {} to {}", text.empty() ? "" : ", ", axis.tag, numberText(axis.min),
                            numberText(axis.max));
    }
    return text;
}

/// Collects an outline that FreeType decomposes.
struct Drawing {
    std::vector<Contour> contours;
    Flatness flatness;
    double unit = 0.0;
    std::size_t points = 0;     ///< number of points in all contours but the last
    std::exception_ptr thrown;  ///< exception, which must not pass through FreeType

    [[nodiscard]] Vec2 at(const FT_Vector* p) const
    {
        return {unit * static_cast<double>(p->x), unit * static_cast<double>(p->y)};
    }
};

bool isNear(std::initializer_list<Vec2> points)
{
    return std::all_of(points.begin(), points.end(),
                       [](Vec2 p) { return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest; });
}

/// Calls add(drawing) if all places are near and returns 0. Any other value stops FreeType.
template <typename Add>
int follow(void* user, std::initializer_list<const FT_Vector*> places, const Add& add)
{
    constexpr std::size_t kMaxPoints = std::size_t{1} << 20;  // limit for a glyph; only damaged data exceed it
    auto& drawing = *static_cast<Drawing*>(user);
    const bool near =
        std::all_of(places.begin(), places.end(), [&drawing](const FT_Vector* p) { return isNear({drawing.at(p)}); });
    const std::size_t last = drawing.contours.empty() ? 0 : drawing.contours.back().size();
    if (!near || drawing.points + last > kMaxPoints) {
        return 1;
    }
    try {
        add(drawing);
        return 0;
    } catch (...) {
        drawing.thrown = std::current_exception();
        return 1;
    }
}

int moveTo(const FT_Vector* to, void* user)
{
    return follow(user, {to}, [&](Drawing& drawing) {
        drawing.points += drawing.contours.empty() ? 0 : drawing.contours.back().size();
        drawing.contours.push_back({drawing.at(to)});
    });
}

int lineTo(const FT_Vector* to, void* user)
{
    return follow(user, {to}, [&](Drawing& drawing) { drawing.contours.back().push_back(drawing.at(to)); });
}

int conicTo(const FT_Vector* control, const FT_Vector* to, void* user)
{
    return follow(user, {control, to}, [&](Drawing& drawing) {
        addConic(drawing.contours.back(), drawing.at(control), drawing.at(to), drawing.flatness);
    });
}

int cubicTo(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user)
{
    return follow(user, {first, second, to}, [&](Drawing& drawing) {
        addCubic(drawing.contours.back(), drawing.at(first), drawing.at(second), drawing.at(to), drawing.flatness);
    });
}

/// Name, or empty if it is not plain ASCII.
std::string plainName(const FT_String* name)
{
    std::string text = name == nullptr ? "" : name;
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; }) ? text : "";
}

bool hasTable(FT_Face face, FT_ULong tag)
{
    FT_ULong size = 0;
    return FT_Load_Sfnt_Table(face, tag, 0, nullptr, &size) == 0 && size > 0;
}

/// Tag of the first table with colours that are not layers; empty if there is none.
std::string otherColoursOf(FT_Face face)
{
    for (const FT_ULong tag :
         {FT_MAKE_TAG('S', 'V', 'G', ' '), FT_MAKE_TAG('s', 'b', 'i', 'x'), FT_MAKE_TAG('C', 'B', 'D', 'T')}) {
        if (hasTable(face, tag)) {
            const std::string text = tagText(tag);
            return text.substr(0, text.find(' '));
        }
    }
    return {};
}

/// Limit of a font file. The largest fonts have 30 MB; an endless device must not be read for ever.
constexpr std::size_t kLargestFile = std::size_t{1} << 28;

std::vector<std::byte> readFontFile(const std::filesystem::path& path)
{
    try {
        Bytes bytes = readBytes(path, kLargestFile + 1, [](std::byte) { return true; });
        if (bytes.size() > kLargestFile) {
            throw Error(ErrorCode::InvalidInput, shown(path) + ": is larger than 256 MiB, the limit for fonts");
        }
        return bytes;
    } catch (const Damage& damage) {
        throw Error(ErrorCode::InvalidInput, "cannot read " + shown(path) + ": " + damage.what());
    }
}

}  // namespace

void FontFace::Close::operator()(FT_LibraryRec_* library) const
{
    FT_Done_FreeType(library);
}

void FontFace::Close::operator()(FT_FaceRec_* face) const
{
    FT_Done_Face(face);
}

void FontFace::Close::operator()(hb_font_t* font) const
{
    hb_font_destroy(font);
}

FontFace::FontFace(std::vector<std::byte> encoded, const FontOptions& options) : encoded_(std::move(encoded))
{
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) {
        throw Error(ErrorCode::InvalidInput, "FreeType cannot be started");
    }
    library_.reset(library);
    const auto open = [&](FT_Long index) {
        FT_Face face = nullptr;
        const FT_Error error = FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(encoded_.data()),
                                                  static_cast<FT_Long>(encoded_.size()), index, &face);
        face_.reset(error == 0 ? face : nullptr);
        return error == 0;
    };
    // A negative index only counts the faces. The upper half of an index is an instance.
    const std::size_t faces = open(-1) ? static_cast<std::size_t>(std::max<FT_Long>(face_->num_faces, 1)) : 0;
    if (faces == 0) {
        throw Error(ErrorCode::InvalidInput, "is not a font, or is damaged: FreeType cannot read it");
    }
    if (options.face_index >= faces) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("face index {} is too large: the file holds {}", options.face_index,
                                faces == 1 ? "one font, 0" : "fonts 0 to " + std::to_string(faces - 1)));
    }
    if (!open(static_cast<FT_Long>(options.face_index))) {
        throw Error(ErrorCode::InvalidInput, "its font " + std::to_string(options.face_index) + " is damaged");
    }
    setAxes(options.axes);
    setPalette(options.palette);
    setSize();
    constexpr double kMinLine = 0.1;
    if (!(lines_.ascender - lines_.descender > kMinLine && isNear({{lines_.ascender, lines_.descender}}))) {
        lines_ = {0.8, -0.2, 1.2};
    }
    lines_.pitch =
        lines_.pitch > kMinLine && lines_.pitch < kFarthest ? lines_.pitch : lines_.ascender - lines_.descender;

    FT_UInt glyph = 0;
    // Damaged tables may continue for ever beyond the last character.
    for (FT_ULong c = FT_Get_First_Char(face_.get(), &glyph); glyph != 0 && c <= 0x10ffff;
         c = FT_Get_Next_Char(face_.get(), c, &glyph)) {
        if (static_cast<FT_Long>(glyph) < face_->num_glyphs) {
            glyph_of_.emplace(static_cast<char32_t>(c), glyph);
            character_of_.emplace(glyph, static_cast<char32_t>(c));
        }
    }
    shaper_.reset(hb_ft_font_create_referenced(face_.get()));
    hb_ft_font_set_load_flags(shaper_.get(), has_bitmaps_ ? kLoadBitmapFlags : kLoadFlags);
}

FontFace::~FontFace() = default;

void FontFace::setSize()
{
    FT_FaceRec_& face = *face_;
    if (FT_IS_SCALABLE(&face) && face.units_per_EM > 0 && face.num_glyphs > 0) {
        if (FT_Set_Pixel_Sizes(&face, 0, face.units_per_EM) != 0) {
            throw Error(ErrorCode::InvalidInput, "the font cannot be scaled");
        }
        const double em = face.units_per_EM;
        unit_ = 1.0 / (64.0 * em);
        lines_ = {face.ascender / em, face.descender / em, face.height / em};
        return;
    }
    const std::string table = otherColoursOf(&face);
    int largest = -1;
    for (int k = 0; k < face.num_fixed_sizes; ++k) {
        const bool is_larger = largest < 0 || face.available_sizes[k].y_ppem > face.available_sizes[largest].y_ppem;
        largest = is_larger ? k : largest;
    }
    if (table != "CBDT" || largest < 0 || FT_Select_Size(&face, largest) != 0 || face.size->metrics.y_ppem == 0) {
        throw Error(ErrorCode::InvalidInput, "the font has bitmaps of its glyphs" +
                                                 (table.empty() ? table : " (" + table + ")") +
                                                 ", not outlines; a picture of the text can be read instead");
    }
    has_bitmaps_ = true;
    const FT_Size_Metrics& size = face.size->metrics;
    unit_ = 1.0 / (64.0 * size.y_ppem);
    lines_ = {unit_ * static_cast<double>(size.ascender), unit_ * static_cast<double>(size.descender),
              unit_ * static_cast<double>(size.height)};
}

void FontFace::setAxes(const std::vector<AxisSetting>& settings)
{
    FT_MM_Var* found = nullptr;
    if (!FT_HAS_MULTIPLE_MASTERS(face_.get()) || FT_Get_MM_Var(face_.get(), &found) != 0) {
        if (!settings.empty()) {
            throw Error(ErrorCode::InvalidArgument, "axis '" + settings.front().tag + "': the font has no axes");
        }
        return;
    }
    std::vector<FT_Fixed> place;
    for (FT_UInt i = 0; i < found->num_axis; ++i) {
        const FT_Var_Axis& axis = found->axis[i];
        axes_.push_back(
            {tagText(axis.tag), plainName(axis.name), fixed(axis.minimum), fixed(axis.def), fixed(axis.maximum)});
        place.push_back(axis.def);
    }
    FT_Done_MM_Var(library_.get(), found);
    for (const AxisSetting& setting : settings) {
        const auto axis = std::find_if(axes_.begin(), axes_.end(),
                                       [&](const FontAxis& candidate) { return candidate.tag == setting.tag; });
        if (axis == axes_.end()) {
            throw Error(ErrorCode::InvalidArgument,
                        "axis '" + setting.tag + "': the font has no such axis, it has " + rangesOf(axes_));
        }
        if (!(setting.value >= axis->min && setting.value <= axis->max)) {
            throw Error(ErrorCode::InvalidArgument,
                        fmt::format("axis '{}': {} is out of range, the font has {}", setting.tag,
                                    numberText(setting.value), rangesOf(axes_)));
        }
        place[static_cast<std::size_t>(axis - axes_.begin())] = std::lround(setting.value * 65536.0);
    }
    if (!settings.empty() &&
        FT_Set_Var_Design_Coordinates(face_.get(), static_cast<FT_UInt>(place.size()), place.data()) != 0) {
        throw Error(ErrorCode::InvalidInput, "the font's axes are damaged");
    }
}

void FontFace::setPalette(std::size_t palette)
{
    FT_Palette_Data data{};
    const std::size_t count = FT_Palette_Data_Get(face_.get(), &data) == 0 ? data.num_palettes : 0;
    if (palette >= std::max<std::size_t>(count, 1)) {
        throw Error(ErrorCode::InvalidArgument, fmt::format("palette {} does not exist: the font has {}", palette,
                                                            count == 0   ? "no palettes"
                                                            : count == 1 ? "one palette, 0"
                                                                         : fmt::format("palettes 0 to {}", count - 1)));
    }
    FT_Color* colours = nullptr;
    if (count == 0 || FT_Palette_Select(face_.get(), static_cast<FT_UShort>(palette), &colours) != 0) {
        return;
    }
    for (FT_UShort i = 0; i < data.num_palette_entries; ++i) {
        palette_.push_back({{colours[i].red, colours[i].green, colours[i].blue}, colours[i].alpha / 255.0});
    }
}

std::string FontFace::family() const
{
    return plainName(face_->family_name);
}

std::string FontFace::style() const
{
    return plainName(face_->style_name);
}

std::size_t FontFace::glyphCount() const
{
    return static_cast<std::size_t>(face_->num_glyphs);
}

std::optional<GlyphId> FontFace::glyphOf(char32_t character) const
{
    const auto found = glyph_of_.find(character);
    return found == glyph_of_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<char32_t> FontFace::characterOf(GlyphId glyph) const
{
    const auto found = character_of_.find(glyph);
    return found == character_of_.end() ? std::nullopt : std::optional(found->second);
}

std::string FontFace::nameOf(GlyphId glyph) const
{
    std::array<char, 256> name{};
    const std::lock_guard lock(mutex_);
    const bool named = FT_HAS_GLYPH_NAMES(face_.get()) &&
                       FT_Get_Glyph_Name(face_.get(), glyph, name.data(), static_cast<FT_UInt>(name.size())) == 0 &&
                       name[0] != '\0';
    return named ? name.data() : "glyph" + std::to_string(glyph);
}

DrawnGlyph FontFace::drawBitmap(GlyphId glyph) const
{
    DrawnGlyph drawn;
    GlyphBitmap bitmap;
    bool good = false;
    {
        const std::lock_guard lock(mutex_);
        if (FT_Load_Glyph(face_.get(), glyph, kLoadBitmapFlags) == 0 &&
            face_->glyph->format == FT_GLYPH_FORMAT_BITMAP) {
            drawn.advance = unit_ * static_cast<double>(face_->glyph->advance.x);
            bitmap = bitmapOf(*face_->glyph);
            good = isNear({{drawn.advance, 0.0}, 64.0 * unit_ * bitmap.middle});
        }
    }
    if (!good) {
        throw glyphError(glyph, "has no bitmap in the font's largest size, or a damaged one");
    }
    drawn.contours = tracedContours(bitmap, 64.0 * unit_);
    return drawn;
}

DrawnGlyph FontFace::draw(GlyphId glyph, const Flatness& flatness) const
{
    if (has_bitmaps_) {
        return drawBitmap(glyph);
    }
    Drawing drawing;
    drawing.flatness = flatness;
    drawing.unit = unit_;
    DrawnGlyph drawn;
    bool good = false;
    {
        const std::lock_guard lock(mutex_);
        if (FT_Load_Glyph(face_.get(), glyph, kLoadFlags) == 0 && face_->glyph->format == FT_GLYPH_FORMAT_OUTLINE) {
            const FT_Outline_Funcs pen{moveTo, lineTo, conicTo, cubicTo, 0, 0};
            drawn.advance = unit_ * static_cast<double>(face_->glyph->advance.x);
            good = FT_Outline_Decompose(&face_->glyph->outline, &pen, &drawing) == 0 && isNear({{drawn.advance, 0.0}});
        }
    }
    if (drawing.thrown) {
        std::rethrow_exception(drawing.thrown);
    }
    if (!good) {
        throw glyphError(glyph, "is damaged in the font");
    }
    drawn.contours = std::move(drawing.contours);
    return drawn;
}

Error FontFace::glyphError(GlyphId glyph, const std::string& what) const
{
    return {ErrorCode::InvalidInput,
            "glyph " + std::to_string(glyph) + " ('" + plainName(nameOf(glyph).c_str()) + "') " + what};
}

bool FontFace::hasColourLayers() const
{
    const std::lock_guard lock(mutex_);
    return hasTable(face_.get(), FT_MAKE_TAG('C', 'O', 'L', 'R'));
}

std::string FontFace::otherColours() const
{
    const std::lock_guard lock(mutex_);
    return otherColoursOf(face_.get());
}

std::vector<ColourLayer> FontFace::layersOf(GlyphId glyph, const CssColour& text_colour) const
{
    try {
        const std::lock_guard lock(mutex_);
        return readLayers(face_.get(), glyph, palette_, text_colour);
    } catch (const Unreadable& problem) {
        throw glyphError(glyph, problem.what());
    }
}

std::vector<ShapedGlyph> FontFace::shape(const std::u32string& text, const TextRun& run) const
{
    const std::unique_ptr<hb_buffer_t, void (*)(hb_buffer_t*)> buffer(hb_buffer_create(), hb_buffer_destroy);
    const std::vector<std::uint32_t> characters(text.begin(), text.end());
    // The whole line is given, so that letters at the ends of a run join with their neighbours.
    hb_buffer_add_codepoints(buffer.get(), characters.data(), static_cast<int>(characters.size()),
                             static_cast<unsigned>(run.begin), static_cast<int>(run.end - run.begin));
    // A mark that the font lacks must not be reported as the letter below it.
    hb_buffer_set_cluster_level(buffer.get(), HB_BUFFER_CLUSTER_LEVEL_MONOTONE_CHARACTERS);
    hb_buffer_set_direction(buffer.get(), run.leftward ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_script(buffer.get(), static_cast<hb_script_t>(run.script));
    // Otherwise HarfBuzz uses the language of the locale.
    hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));
    {
        const std::lock_guard lock(mutex_);
        constexpr std::array<hb_feature_t, 2> kApart{
            {{HB_TAG('l', 'i', 'g', 'a'), 0, HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END},
             {HB_TAG('c', 'l', 'i', 'g'), 0, HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END}}};
        hb_shape(shaper_.get(), buffer.get(), kApart.data(), run.ligatures ? 0U : static_cast<unsigned>(kApart.size()));
    }
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
    const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer.get(), &count);
    std::vector<ShapedGlyph> shaped;
    for (unsigned i = 0; i < count; ++i) {
        shaped.push_back({infos[i].codepoint,
                          infos[i].cluster,
                          {unit_ * positions[i].x_offset, unit_ * positions[i].y_offset},
                          unit_ * positions[i].x_advance});
    }
    return shaped;
}

std::string Font::family() const
{
    return face_->family();
}

std::string Font::style() const
{
    return face_->style();
}

std::size_t Font::glyphCount() const
{
    return face_->glyphCount();
}

std::vector<FontAxis> Font::axes() const
{
    return face_->axes();
}

std::optional<GlyphId> Font::glyphOf(char32_t character) const
{
    return face_->glyphOf(character);
}

std::optional<char32_t> Font::characterOf(GlyphId glyph) const
{
    return face_->characterOf(glyph);
}

std::string Font::nameOf(GlyphId glyph) const
{
    return face_->nameOf(glyph);
}

bool Font::hasColourLayers() const
{
    return face_->hasColourLayers();
}

std::string Font::otherColours() const
{
    return face_->otherColours();
}

Font decodeFont(std::span<const std::byte> encoded, const FontOptions& options)
{
    return Font(std::make_shared<const FontFace>(std::vector<std::byte>(encoded.begin(), encoded.end()), options));
}

Font readFont(const std::filesystem::path& path, const FontOptions& options)
{
    std::vector<std::byte> encoded = readFontFile(path);
    try {
        return Font(std::make_shared<const FontFace>(std::move(encoded), options));
    } catch (const Error& error) {
        throw Error(error.code(), shown(path) + ": " + error.what());
    }
}

}  // namespace droplet
