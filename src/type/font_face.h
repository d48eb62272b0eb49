// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "droplet/type/font.h"
#include "type/contour_union.h"
#include "type/flatten.h"

struct FT_LibraryRec_;
struct FT_FaceRec_;
struct hb_font_t;

namespace droplet {

/// A glyph as its font draws it; lengths in ems, from its origin on the base line.
struct DrawnGlyph {
    std::vector<Contour> contours;
    double advance = 0.0;
};

/// Heights in ems: above the base line, and from one base line to the next.
struct LineMetrics {
    double ascender = 0.0;
    double descender = 0.0;  ///< negative below the base line
    double pitch = 0.0;
};

/// A glyph of a shaped run; lengths in ems.
struct ShapedGlyph {
    GlyphId glyph = 0;
    std::size_t character = 0;  ///< index in the text of the first character it stands for
    Vec2 offset;                ///< of its origin from where the pen is
    double advance = 0.0;       ///< of the pen, after it
};

/// Characters of one script and direction.
struct TextRun {
    std::size_t begin = 0;
    std::size_t end = 0;
    unsigned script = 0;  ///< an OpenType tag, as HarfBuzz has them
    bool leftward = false;
};

/// A font as FreeType and HarfBuzz have it, one caller at a time.
class FontFace {
public:
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

    /// @throws Error InvalidInput: the font is broken there
    [[nodiscard]] DrawnGlyph draw(GlyphId glyph, const Flatness& flatness) const;

    /// The glyphs of a run, from left to right.
    [[nodiscard]] std::vector<ShapedGlyph> shape(const std::u32string& text, const TextRun& run) const;

private:
    struct Close {
        void operator()(FT_LibraryRec_* library) const;
        void operator()(FT_FaceRec_* face) const;
        void operator()(hb_font_t* font) const;
    };

    void setAxes(const std::vector<AxisSetting>& settings);

    std::vector<std::byte> encoded_;  ///< what FreeType reads from as long as the face is open
    std::unique_ptr<FT_LibraryRec_, Close> library_;
    std::unique_ptr<FT_FaceRec_, Close> face_;
    std::unique_ptr<hb_font_t, Close> shaper_;
    std::vector<FontAxis> axes_;
    LineMetrics lines_;
    double unit_ = 0.0;  ///< FreeType's 26.6 fixed-point numbers in ems
    std::map<char32_t, GlyphId> glyph_of_;
    std::map<GlyphId, char32_t> character_of_;
    mutable std::mutex mutex_;
};

}  // namespace droplet
