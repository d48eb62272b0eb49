// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/image/css_colour.h"
#include "droplet/type/font.h"
#include "type/colour_layers.h"
#include "type/contour_union.h"
#include "type/flatten.h"

struct FT_LibraryRec_;
struct FT_FaceRec_;
struct hb_font_t;

namespace droplet {

/// Glyph as drawn by its font; lengths in ems, from its origin on the base line.
struct DrawnGlyph {
    std::vector<Contour> contours;
    double advance = 0.0;
};

/// Heights of a line in ems, measured from the base line.
struct LineMetrics {
    double ascender = 0.0;   ///< top
    double descender = 0.0;  ///< bottom; negative below the base line
    double pitch = 0.0;      ///< distance to the next base line
};

/// Glyph of a shaped run; lengths in ems.
struct ShapedGlyph {
    GlyphId glyph = 0;
    std::size_t character = 0;  ///< index of its first character in the text
    Vec2 offset;                ///< origin, relative to the pen
    double advance = 0.0;       ///< movement of the pen after the glyph
};

/// Characters of one script and direction.
struct TextRun {
    std::size_t begin = 0;
    std::size_t end = 0;
    unsigned script = 0;  ///< script tag of HarfBuzz
    bool leftward = false;
    bool ligatures = true;
};

/// Font in FreeType and HarfBuzz. Calls from several threads wait for each other.
class FontFace {
public:
    /// Opens a font.
    /// @throws Error as decodeFont()
    FontFace(std::vector<std::byte> encoded, const FontOptions& options);
    ~FontFace();
    FontFace(const FontFace&) = delete;
    FontFace& operator=(const FontFace&) = delete;

    [[nodiscard]] std::string family() const;
    [[nodiscard]] std::string style() const;
    [[nodiscard]] std::size_t glyphCount() const;
    [[nodiscard]] const std::vector<FontAxis>& axes() const { return axes_; }
    [[nodiscard]] const LineMetrics& lines() const { return lines_; }
    [[nodiscard]] std::optional<GlyphId> glyphOf(char32_t character) const;
    [[nodiscard]] std::optional<char32_t> characterOf(GlyphId glyph) const;
    [[nodiscard]] std::string nameOf(GlyphId glyph) const;

    /// Draws a glyph.
    /// @throws Error InvalidInput: the font is damaged there
    [[nodiscard]] DrawnGlyph draw(GlyphId glyph, const Flatness& flatness) const;

    [[nodiscard]] bool hasColourLayers() const;
    [[nodiscard]] std::string otherColours() const;

    /// Layers of a colour glyph, the lowest first; none if the glyph has no layers.
    /// @param text_colour  for layers that have the text's colour
    /// @throws Error       InvalidInput: the font is damaged there, or the glyph is painted by COLR version 1
    [[nodiscard]] std::vector<ColourLayer> layersOf(GlyphId glyph, const CssColour& text_colour) const;

    /// Shapes a run: returns its glyphs from left to right.
    [[nodiscard]] std::vector<ShapedGlyph> shape(const std::u32string& text, const TextRun& run) const;

private:
    struct Close {
        void operator()(FT_LibraryRec_* library) const;
        void operator()(FT_FaceRec_* face) const;
        void operator()(hb_font_t* font) const;
    };

    /// Selects the size at which glyphs are loaded, and the heights of lines.
    void setSize();
    [[nodiscard]] DrawnGlyph drawBitmap(GlyphId glyph) const;
    void setAxes(const std::vector<AxisSetting>& settings);
    void setPalette(std::size_t palette);
    /// Name of a glyph in messages, and what is wrong with it.
    [[nodiscard]] Error glyphError(GlyphId glyph, const std::string& what) const;

    std::vector<std::byte> encoded_;  ///< FreeType reads from it while the face is open
    std::unique_ptr<FT_LibraryRec_, Close> library_;
    std::unique_ptr<FT_FaceRec_, Close> face_;
    std::unique_ptr<hb_font_t, Close> shaper_;
    std::vector<FontAxis> axes_;
    LineMetrics lines_;
    std::vector<PaletteEntry> palette_;
    double unit_ = 0.0;         ///< unit of FreeType's 26.6 fixed-point numbers in ems
    bool has_bitmaps_ = false;  ///< whether glyphs are colour bitmaps, not outlines
    std::map<char32_t, GlyphId> glyph_of_;
    std::map<GlyphId, char32_t> character_of_;
    mutable std::mutex mutex_;
};

}  // namespace droplet
