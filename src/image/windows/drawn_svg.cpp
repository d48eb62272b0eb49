// SPDX-License-Identifier: GPL-3.0-or-later
//
// librsvg cannot be had for Windows from Debian's sources, resvg can, as the WebAssembly of its npm package. It draws
// in this process, which it cannot harm; see resvg.h.
#include "image/drawn_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <system_error>

#include "image/image_bytes.h"
#include "image/svg/css_text.h"
#include "image/svg_raster.h"
#include "image/windows/resvg.h"
#include "image/windows/svg_document.h"
#include "image/windows/system_fonts.h"
#include "number_text.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;

/// Families that stand for the generic ones, the first that the system has.
struct Generic {
    const char* name;
    std::array<const char*, 3> families;
};
constexpr std::array<Generic, 3> kGeneric{
    {{"serifFamily", {"Times New Roman", "Liberation Serif", "DejaVu Serif"}},
     {"sansSerifFamily", {"Arial", "Liberation Sans", "DejaVu Sans"}},
     {"monospaceFamily", {"Courier New", "Liberation Mono", "DejaVu Sans Mono"}}}};

bool isGeneric(const std::string& family)
{
    constexpr std::array<std::string_view, 7> kNames{"serif",   "sans-serif", "monospace", "cursive",
                                                     "fantasy", "system-ui",  "inherit"};
    return std::find(kNames.begin(), kNames.end(), lowered(family)) != kNames.end();
}

/// Fonts of the system that a drawing asks for.
class Fonts {
public:
    explicit Fonts(const std::set<std::vector<std::string>>& wanted)
    {
        if (wanted.empty()) {
            return;
        }
        for (const std::vector<std::string>& families : wanted) {
            choose(families);
        }
        std::string names;
        for (const Generic& generic : kGeneric) {
            const auto found = std::find_if(generic.families.begin(), generic.families.end(),
                                            [this](const char* family) { return take(family); });
            if (found != generic.families.end()) {
                names += fmt::format(R"("{}":"{}",)", generic.name, *found);
                default_ = default_.empty() || generic.name == std::string_view("sansSerifFamily") ? *found : default_;
            }
        }
        fonts_.names = "{" + names + fmt::format(R"("defaultFontFamily":"{}")", default_) + "}";
        if (fonts_.files.empty()) {
            lacking_ = {"text, as no font was found"};
        }
    }

    [[nodiscard]] const ResvgFonts& fonts() const { return fonts_; }
    [[nodiscard]] const std::vector<std::string>& lacking() const { return lacking_; }

private:
    /// Takes the first family that there is, or notes that there is none.
    void choose(const std::vector<std::string>& families)
    {
        std::string first;
        for (const std::string& family : families) {
            // Generic families after others are what is used instead, as the drawing asks.
            if (isGeneric(family) ? first.empty() : take(family)) {
                return;
            }
            first = first.empty() && !isGeneric(family) ? family : first;
        }
        const std::string what =
            "the font '" + first + "', for which another is used (install it, or convert text to paths)";
        if (!first.empty() && std::find(lacking_.begin(), lacking_.end(), what) == lacking_.end()) {
            lacking_.push_back(what);
        }
    }

    /// Reads a family's files.
    /// @return  whether there is one
    bool take(const std::string& family)
    {
        constexpr std::uintmax_t kMost = std::uintmax_t{64} << 20U;
        const std::vector<fs::path> files = systemFonts(family);
        for (const fs::path& file : files) {
            std::error_code missing;
            const std::uintmax_t size = fs::file_size(file, missing);
            if (missing || size + taken_ > kMost || !paths_.insert(file).second) {
                continue;
            }
            std::ifstream in(file, std::ios::binary);
            fonts_.files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
            taken_ += size;
        }
        return !files.empty();
    }

    ResvgFonts fonts_;
    std::string default_;
    std::vector<std::string> lacking_;
    std::set<fs::path> paths_;
    std::uintmax_t taken_ = 0;
};

[[noreturn]] void throwProblem(const ResvgError& error, const DrawingLimits& limits)
{
    switch (error.cause) {
        case ResvgError::Cause::Damaged:
            throwDamaged(ImageFormat::Svg, error.what());
        case ResvgError::Cause::Time:
            throwSvgRefused("takes more than " + numberText(limits.seconds) + " s to draw");
        case ResvgError::Cause::Memory:
            throwSvgRefused("takes more than " + numberText(static_cast<double>(limits.memory) / (1 << 20)) +
                            " MiB of memory to draw");
        case ResvgError::Cause::Depth:
            throwSvgRefused("is nested too deeply, or too long, to draw");
        default:
            throwSvgRefused(std::string("cannot be drawn: ") + error.what());
    }
}

}  // namespace

SvgLine lineOfSvg(const SvgText& drawing, const DrawingLimits& /*limits*/)
{
    const SvgDocument document(drawing.text);  // refuses what is no drawing
    return lineIn(drawing.text);
}

DrawnSvg drawSvg(std::span<const std::byte> text, std::size_t /*tags*/, const DecodeOptions& options)
{
    SvgDocument document(text);
    const Fonts fonts(document.families());
    try {
        Resvg resvg({options.drawing.seconds, options.drawing.memory});
        const auto page = document.page([&] { return resvg.ink(document.text(), fonts.fonts()); });
        if (!page) {
            throwSvgRefused("states no size and draws nothing");
        }
        if (!(page->width > 0.0 && page->height > 0.0)) {
            throwSvgRefused("has a page without area");
        }
        const auto raster = svgRaster(page->width, page->height, options.vector_long_side, options.max_pixels);
        if (!raster) {
            throwSvgRefused(tooNarrow(page->width, page->height, options.max_pixels));
        }
        DrawnSvg drawn;
        drawn.drawing.outcome = SvgOutcome::Drawn;
        drawn.drawing.width = raster->width;
        drawn.drawing.height = raster->height;
        drawn.drawing.scale = raster->scale;
        drawn.drawing.physical_width = page->physical_width.value_or(0.0);
        std::vector<std::string> lacking = document.lacking();
        lacking.insert(lacking.end(), fonts.lacking().begin(), fonts.lacking().end());
        std::string words;
        for (const std::string& what : lacking) {
            words += (words.empty() ? "" : ", ") + what;
        }
        words.copy(drawn.drawing.lacking.data(), drawn.drawing.lacking.size() - 1);
        const std::vector<std::uint8_t> bytes = resvg.pixels(document.text(), fonts.fonts(), raster->width);
        // The last row may be missing, or one too many.
        const std::size_t count = static_cast<std::size_t>(raster->width) * static_cast<std::size_t>(raster->height);
        const std::shared_ptr<std::uint32_t[]> pixels(new std::uint32_t[count]());
        for (std::size_t i = 0; i < std::min(count, bytes.size() / 4); ++i) {
            const std::uint8_t* const rgba = &bytes[4 * i];
            pixels[i] =
                std::uint32_t{rgba[3]} << 24U | std::uint32_t{rgba[0]} << 16U | std::uint32_t{rgba[1]} << 8U | rgba[2];
        }
        drawn.pixels = {pixels, pixels.get()};
        return drawn;
    } catch (const ResvgError& error) {
        throwProblem(error, options.drawing);
    }
}

}  // namespace droplet
