// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/lettering.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drawing/canvas.h"
#include "droplet/error.h"
#include "utf8.h"

namespace droplet {
namespace {

/// Strokes of a letter. A point is two digits, x and y, on a grid with the baseline at y = 2 and capitals up to y = 8.
/// Strokes with a tilde are quadratic B-splines between their ends; the inner points are control points.
struct Letter {
    char32_t code;
    const char* strokes;
};

constexpr Letter kLetters[] = {
    {U' ', ""},
    {U'!', "08 05,02 02"},
    {U'"', "09 07,29 27"},
    {U'#', "12 18,32 38,04 44,06 46"},
    {U'$', "~47 48 08 05 45 42 02 03,29 21"},
    {U'%', "02 48,~08 06 26 28 08,~24 22 42 44 24"},
    {U'&', "~42 16 08 38 35 04 02 32 44"},
    {U'\'', "09 07"},
    {U'(', "~29 07 03 21"},
    {U')', "~09 27 23 01"},
    {U'*', "28 24,07 45,47 05"},
    {U'+', "05 45,27 23"},
    {U',', "12 00"},
    {U'-', "05 35"},
    {U'.', "02 02"},
    {U'/', "01 49"},
    {U'0', "~28 08 02 42 48 28"},
    {U'1', "06 28 22"},
    {U'2', "~06 08 48 45 02,02 42"},
    {U'3', "~07 08 48 45 15,~15 45 42 02 03"},
    {U'4', "32 38 04 44"},
    {U'5', "48 08 05,~05 46 42 12 03"},
    {U'6', "~48 08 02 42 46 06 04"},
    {U'7', "08 48 12"},
    {U'8', "~25 05 08 48 45 25,~25 05 02 42 45 25"},
    {U'9', "~02 42 48 08 04 44 46"},
    {U':', "02 02,05 05"},
    {U';', "15 15,12 00"},
    {U'<', "37 05 33"},
    {U'=', "04 44,06 46"},
    {U'>', "07 35 03"},
    {U'?', "~06 08 48 45 25 24,22 22"},
    {U'@', "~45 25 22 42 45,~45 42 62 68 08 01 51"},
    {U'A', "02 28 42,14 34"},
    {U'B', "02 08,~08 28 48 45 25 05,~05 25 45 42 22 02"},
    {U'C', "~46 48 08 02 42 44"},
    {U'D', "02 08,~08 18 48 42 12 02"},
    {U'E', "48 08 02 42,05 35"},
    {U'F', "48 08 02,05 35"},
    {U'G', "~46 48 08 02 42 45,45 25"},
    {U'H', "02 08,42 48,05 45"},
    {U'I', "02 08"},
    {U'J', "38 34,~34 32 02 04"},
    {U'K', "02 08,48 04,15 42"},
    {U'L', "08 02 42"},
    {U'M', "02 08 34 68 62"},
    {U'N', "02 08 42 48"},
    {U'O', "~38 08 02 62 68 38"},
    {U'P', "02 08,~08 28 48 44 24 04"},
    {U'Q', "~38 08 02 62 68 38,44 61"},
    {U'R', "02 08,~08 28 48 44 24 04,24 42"},
    {U'S', "~47 48 08 05 45 42 02 03"},
    {U'T', "08 48,22 28"},
    {U'U', "08 04,~04 02 42 44,44 48"},
    {U'V', "08 22 48"},
    {U'W', "08 12 37 52 68"},
    {U'X', "02 48,08 42"},
    {U'Y', "08 25 48,25 22"},
    {U'Z', "08 48 02 42"},
    {U'[', "29 09 01 21"},
    {U'\\', "09 41"},
    {U']', "09 29 21 01"},
    {U'^', "06 28 46"},
    {U'_', "01 41"},
    {U'`', "09 17"},
    {U'a', "~26 06 02 42 46 26,46 42"},
    {U'b', "08 02,~26 06 02 42 46 26"},
    {U'c', "~45 46 06 02 42 43"},
    {U'd', "~26 06 02 42 46 26,48 42"},
    {U'e', "04 44,~44 46 06 02 42 43"},
    {U'f', "~38 18 16,16 12,06 36"},
    {U'g', "~26 06 02 42 46 26,46 42,~42 40 00 01"},
    {U'h', "08 02,~04 06 46 44,44 42"},
    {U'i', "06 02,08 08"},
    {U'j', "16 12,~12 10 00,18 18"},
    {U'k', "08 02,36 04,14 32"},
    {U'l', "08 03,~03 02 22"},
    {U'm', "06 02,~04 06 36 34,34 32,~34 36 66 64,64 62"},
    {U'n', "06 02,~04 06 46 44,44 42"},
    {U'o', "~26 06 02 42 46 26"},
    {U'p', "06 00,~26 06 02 42 46 26"},
    {U'q', "~26 06 02 42 46 26,46 40"},
    {U'r', "06 02,~04 06 36"},
    {U's', "~35 36 06 04 34 32 02 03"},
    {U't', "18 13,~13 12 32,06 36"},
    {U'u', "06 04,~04 02 42 44,46 42"},
    {U'v', "06 22 46"},
    {U'w', "06 12 35 52 66"},
    {U'x', "02 46,06 42"},
    {U'y', "06 22,46 10"},
    {U'z', "06 46 02 42"},
    {U'{', "29 19 16 05 14 11 21"},
    {U'|', "09 01"},
    {U'}', "09 19 16 25 14 11 01"},
    {U'~', "~04 07 27 24 44 47"},
    {U'°', "~19 09 07 27 29 19"},
    {U'µ', "06 00,~04 02 42 44,46 42"},
    {U'²', "~08 09 29 28 06,06 26"},
    {U'·', "15 15"},
    {U'−', "05 45"},
    {U'–', "05 45"},
    {U'Δ', "02 28 42 02"},
};

constexpr double kCapital = 6.0;  // rows of the grid
constexpr double kBaseline = 2.0;
constexpr double kGap = 1.9;  // between letters [columns]
constexpr double kSpace = 2.0;

struct Stroke {
    std::vector<Vec2> points;
    bool smooth = false;
};

struct Shape {
    std::vector<Stroke> strokes;
    double width = kSpace;
};

Shape shapeOf(char32_t code)
{
    const auto* letter = std::find_if(std::begin(kLetters), std::end(kLetters),
                                      [code](const Letter& known) { return known.code == code; });
    if (letter == std::end(kLetters)) {
        return shapeOf(U'?');
    }
    Shape shape;
    double right = 0.0;
    std::string_view rest = letter->strokes;
    while (!rest.empty()) {
        std::string_view text = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), text.size() + 1));
        Stroke stroke{{}, text.front() == '~'};
        for (std::size_t i = stroke.smooth ? 1 : 0; i + 1 < text.size(); i += 3) {
            stroke.points.push_back(
                {static_cast<double>(text[i] - '0'), static_cast<double>(text[i + 1] - '0') - kBaseline});
            right = std::max(right, stroke.points.back().x);
        }
        shape.strokes.push_back(std::move(stroke));
    }
    if (!shape.strokes.empty()) {
        shape.width = right;
    }
    return shape;
}

/// Continues the path along a quadratic B-spline.
void curve(const Canvas& canvas, const std::vector<Vec2>& control)
{
    Vec2 from = control.front();
    cairo_move_to(canvas.cairo(), from.x, from.y);
    for (std::size_t i = 1; i + 1 < control.size(); ++i) {
        const Vec2 to = i + 2 == control.size() ? control.back() : 0.5 * (control[i] + control[i + 1]);
        const Vec2 first = (1.0 / 3.0) * (from + 2.0 * control[i]);
        const Vec2 second = (1.0 / 3.0) * (to + 2.0 * control[i]);
        cairo_curve_to(canvas.cairo(), first.x, first.y, second.x, second.y, to.x, to.y);
        from = to;
    }
}

/// Splits UTF-8 into characters; bytes that are not UTF-8 count as one character each.
std::u32string characters(std::string_view text)
{
    try {
        return decodeUtf8(text, "text");
    } catch (const Error&) {
        return {text.begin(), text.end()};
    }
}

}  // namespace

double textWidth(std::string_view text, double size)
{
    double width = 0.0;
    for (const char32_t code : characters(text)) {
        width += shapeOf(code).width + kGap;
    }
    return std::max(0.0, width - kGap) * size / kCapital;
}

std::string fitted(std::string_view text, double size, double width)
{
    constexpr const char* kEllipsis = "...";
    if (textWidth(text, size) <= width) {
        return std::string(text);
    }
    std::string kept;
    while (kept.size() < text.size()) {
        // A character of several bytes is removed whole.
        std::size_t end = kept.size() + 1;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) {
            ++end;
        }
        std::string longer(text.substr(0, end));
        if (textWidth(longer + kEllipsis, size) > width) {
            break;
        }
        kept = std::move(longer);
    }
    return textWidth(kept + kEllipsis, size) <= width ? kept + kEllipsis : std::string();
}

void drawText(const Canvas& canvas, std::string_view text, Vec2 at, const Pen& pen)
{
    const double grid = pen.size / kCapital;
    cairo_set_dash(canvas.cairo(), nullptr, 0, 0.0);
    for (const char32_t code : characters(text)) {
        const Shape shape = shapeOf(code);
        for (Stroke stroke : shape.strokes) {
            for (Vec2& p : stroke.points) {
                p = at + Vec2{grid * p.x, -grid * p.y};
            }
            if (stroke.smooth) {
                curve(canvas, stroke.points);
            } else {
                canvas.trace(stroke.points);
            }
        }
        at.x += grid * (shape.width + kGap);
    }
    canvas.stroke(pen.colour, pen.width);
}

void drawText(Picture& picture, std::string_view text, Vec2 at, const Pen& pen)
{
    const Vec2 reach{pen.width + 1.0, 2.0 * pen.size + pen.width};
    drawText(Canvas(picture, at - reach, at + reach + Vec2{textWidth(text, pen.size), 0.0}), text, at, pen);
}

}  // namespace droplet
