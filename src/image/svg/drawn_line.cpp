// SPDX-License-Identifier: GPL-3.0-or-later
// After: SVG 2 (W3C), 9.3 (path data), 9.5 and B.2 (elliptical arcs), 10 (basic shapes), 11.8 (text on a path).
#include "image/svg/drawn_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "image/svg/css_text.h"
#include "image/svg/drawing_tree.h"
#include "image/svg/style_sheet.h"

namespace droplet {
namespace {

Vec2 mapped(const Matrix& matrix, Vec2 p)
{
    return {matrix.a * p.x + matrix.c * p.y + matrix.e, matrix.b * p.x + matrix.d * p.y + matrix.f};
}

/// Curves from one move to the next, as in SvgLine.
struct Part {
    std::vector<Vec2> points;
    double length = 0.0;  ///< about
};

/// Draws parts of lines.
class Pen {
public:
    explicit Pen(std::vector<Part>& parts) : parts_(parts) {}

    /// Begins a shape in coordinates of its own.
    void place(const Matrix& matrix)
    {
        lift();
        matrix_ = matrix;
        at_ = begin_ = {};
    }

    [[nodiscard]] Vec2 at() const { return at_; }

    void move(Vec2 to)
    {
        lift();
        at_ = begin_ = to;
    }

    void line(Vec2 to)
    {
        if (!(to == at_)) {
            curve(at_, to, to);
        }
    }

    void curve(Vec2 first, Vec2 second, Vec2 to)
    {
        if (part_.points.empty()) {
            part_.points.push_back(mapped(matrix_, at_));
        }
        const Vec2 from = part_.points.back();
        const Vec2 a = mapped(matrix_, first);
        const Vec2 b = mapped(matrix_, second);
        const Vec2 end = mapped(matrix_, to);
        // A curve is longer than its chord and shorter than its control polygon.
        part_.length += 0.5 * (length(end - from) + length(a - from) + length(b - a) + length(end - b));
        part_.points.insert(part_.points.end(), {a, b, end});
        at_ = to;
    }

    void quadratic(Vec2 control, Vec2 to)
    {
        curve(at_ + (2.0 / 3.0) * (control - at_), to + (2.0 / 3.0) * (control - to), to);
    }

    /// Elliptical arc; the rotation is in degrees.
    void arc(Vec2 radii, double rotation, bool is_large, bool is_clockwise, Vec2 to)
    {
        double rx = std::abs(radii.x);
        double ry = std::abs(radii.y);
        if (rx == 0.0 || ry == 0.0 || at_ == to) {
            line(to);
            return;
        }
        const double angle = rotation * std::numbers::pi / 180.0;
        const Vec2 across{std::cos(angle), std::sin(angle)};
        const Vec2 half = 0.5 * (at_ - to);
        const Vec2 p{dot(across, half), cross(across, half)};
        const double excess = p.x * p.x / (rx * rx) + p.y * p.y / (ry * ry);
        if (excess > 1.0) {
            rx *= std::sqrt(excess);
            ry *= std::sqrt(excess);
        }
        const double off = std::sqrt(std::max(0.0, 1.0 / excess - 1.0)) * (is_large == is_clockwise ? -1.0 : 1.0);
        const Vec2 c{off * rx * p.y / ry, -off * ry * p.x / rx};
        const auto round = [&](Vec2 unit) {
            const Vec2 q{c.x + rx * unit.x, c.y + ry * unit.y};
            return 0.5 * (at_ + to) + Vec2{across.x * q.x - across.y * q.y, across.y * q.x + across.x * q.y};
        };
        const double begin = std::atan2((p.y - c.y) / ry, (p.x - c.x) / rx);
        double turn = std::atan2((-p.y - c.y) / ry, (-p.x - c.x) / rx) - begin;
        if (is_clockwise != (turn > 0.0)) {
            turn += is_clockwise ? 2.0 * std::numbers::pi : -2.0 * std::numbers::pi;
        }
        // Curves of up to an eighth of a circle leave it by at most 5e-6 of its radius.
        const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / (std::numbers::pi / 4.0) - 1e-9)));
        const double step = turn / count;
        const double handle = 4.0 / 3.0 * std::tan(0.25 * step);
        std::vector<std::array<Vec2, 3>> curves;
        curves.reserve(static_cast<std::size_t>(count));
        for (int k = 0; k < count; ++k) {
            const double now = begin + k * step;
            const Vec2 u{std::cos(now), std::sin(now)};
            const Vec2 v{std::cos(now + step), std::sin(now + step)};
            curves.push_back({round(u + handle * Vec2{-u.y, u.x}), round(v - handle * Vec2{-v.y, v.x}),
                              k + 1 == count ? to : round(v)});
        }
        for (const auto& [first, second, end] : curves) {
            curve(first, second, end);
        }
    }

    void close()
    {
        line(begin_);
        move(begin_);
    }

    /// Ends the part that was begun.
    void lift()
    {
        if (part_.length > 0.0) {
            parts_.push_back(std::move(part_));
        }
        part_ = {};
    }

private:
    std::vector<Part>& parts_;
    Part part_;
    Matrix matrix_;
    Vec2 at_;
    Vec2 begin_;
};

/// Path data: letters and numbers.
class PathText {
public:
    explicit PathText(std::string_view text) : text_(text) {}

    /// Next character after separators; none at the end.
    char next()
    {
        text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n\f,"), text_.size()));
        return text_.empty() ? '\0' : text_.front();
    }

    void skip() { text_.remove_prefix(1); }

    /// A number; for flags a single digit.
    std::optional<double> number(bool is_flag)
    {
        const char first = next();
        if (is_flag) {
            if (first != '0' && first != '1') {
                return std::nullopt;
            }
            skip();
            return first == '1' ? 1.0 : 0.0;
        }
        if (first == '+') {
            skip();
        }
        // Not infinity, which from_chars() reads, too.
        const std::size_t digit = !text_.empty() && text_.front() == '-' && first != '+' ? 1 : 0;
        double value = 0.0;
        if (digit >= text_.size() || std::string_view("0123456789.").find(text_[digit]) == std::string_view::npos) {
            return std::nullopt;
        }
        const auto [rest, failure] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
        if (failure != std::errc{}) {
            return std::nullopt;
        }
        text_.remove_prefix(static_cast<std::size_t>(rest - text_.data()));
        return value;
    }

private:
    std::string_view text_;
};

/// Draws path data, up to an error in it.
void drawPath(Pen& pen, std::string_view data)
{
    constexpr std::string_view kCommands = "MLHVCSQTAZ";
    constexpr std::array<std::size_t, 10> kNumbers{2, 2, 1, 1, 6, 4, 4, 2, 7, 0};
    PathText text(data);
    char command = '\0';
    char before = '\0';  // command of the last curve, in upper case
    Vec2 control;        // its last control point
    for (char c = text.next(); c != '\0'; c = text.next()) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (is_letter) {
            command = c;
            text.skip();
        }
        const bool is_relative = command >= 'a';
        const char upper = is_relative ? static_cast<char>(command - 'a' + 'A') : command;
        const std::size_t kind = kCommands.find(upper);
        if (kind == std::string_view::npos || (upper == 'Z' && !is_letter) || (before == '\0' && upper != 'M')) {
            break;
        }
        std::array<double, 7> n{};
        bool is_whole = true;
        for (std::size_t k = 0; is_whole && k < kNumbers[kind]; ++k) {
            const auto number = text.number(upper == 'A' && (k == 3 || k == 4));
            is_whole = number.has_value();
            n[k] = number.value_or(0.0);
        }
        if (!is_whole) {
            break;
        }
        const Vec2 from = is_relative ? pen.at() : Vec2{};
        const auto point = [&](std::size_t k) { return from + Vec2{n[k], n[k + 1]}; };
        const auto reflected = [&](char smooth) {
            return before == smooth || before == (smooth == 'C' ? 'S' : 'T') ? 2.0 * pen.at() - control : pen.at();
        };
        switch (upper) {
            case 'M':
                pen.move(point(0));
                command = is_relative ? 'l' : 'L';  // of further points
                break;
            case 'L':
                pen.line(point(0));
                break;
            case 'H':
                pen.line({from.x + n[0], pen.at().y});
                break;
            case 'V':
                pen.line({pen.at().x, from.y + n[0]});
                break;
            case 'C':
                control = point(2);
                pen.curve(point(0), control, point(4));
                break;
            case 'S': {
                const Vec2 first = reflected('C');
                control = point(0);
                pen.curve(first, control, point(2));
                break;
            }
            case 'Q':
                control = point(0);
                pen.quadratic(control, point(2));
                break;
            case 'T':
                control = reflected('Q');
                pen.quadratic(control, point(0));
                break;
            case 'A':
                pen.arc({n[0], n[1]}, n[2], n[3] != 0.0, n[4] != 0.0, point(5));
                break;
            default:
                pen.close();
                break;
        }
        before = upper;
    }
}

/// Draws an element that is a path or a basic shape.
void drawShape(Pen& pen, const xmlNode& element)
{
    const auto number = [&](const char* name) { return pixelsOf(element, name); };
    const std::string_view name = nameOf(element);
    if (name == "path") {
        drawPath(pen, attributeOf(element, "d").value_or(""));
    } else if (name == "line") {
        pen.move({number("x1").value_or(0.0), number("y1").value_or(0.0)});
        pen.line({number("x2").value_or(0.0), number("y2").value_or(0.0)});
    } else if (name == "polyline" || name == "polygon") {
        drawPath(pen, "M" + attributeOf(element, "points").value_or("") + (name == "polygon" ? "Z" : ""));
    } else if (name == "circle" || name == "ellipse") {
        const Vec2 centre{number("cx").value_or(0.0), number("cy").value_or(0.0)};
        const auto r = name == "circle" ? number("r") : std::nullopt;
        const auto x = r ? r : number("rx");
        const auto y = r ? r : number("ry");
        const Vec2 radii{x.value_or(y.value_or(0.0)), y.value_or(x.value_or(0.0))};
        const Vec2 right{centre.x + radii.x, centre.y};
        pen.move(right);
        pen.arc(radii, 0.0, false, true, {centre.x - radii.x, centre.y});
        pen.arc(radii, 0.0, false, true, right);
    } else if (name == "rect") {
        const Vec2 low{number("x").value_or(0.0), number("y").value_or(0.0)};
        const Vec2 size{number("width").value_or(0.0), number("height").value_or(0.0)};
        const Vec2 high = low + size;
        const auto x = number("rx");
        const auto y = number("ry");
        const Vec2 r{std::min(x.value_or(y.value_or(0.0)), 0.5 * size.x),
                     std::min(y.value_or(x.value_or(0.0)), 0.5 * size.y)};
        const auto corner = [&](Vec2 to) { pen.arc(r, 0.0, false, true, to); };
        pen.move({low.x + r.x, low.y});
        pen.line({high.x - r.x, low.y});
        corner({high.x, low.y + r.y});
        pen.line({high.x, high.y - r.y});
        corner({high.x - r.x, high.y});
        pen.line({low.x + r.x, high.y});
        corner({low.x, high.y - r.y});
        pen.line({low.x, low.y + r.y});
        corner({low.x + r.x, low.y});
    }
}

Matrix mapOf(const StyleSheets& styles, const xmlNode& element)
{
    const auto value = styles.own(element, "transform");
    const Matrix own = value ? parseTransform(value->value).value_or(Matrix{}) : Matrix{};
    return nameOf(element) == "svg" ? own * viewportScale(element).value_or(Matrix{}) : own;
}

/// Draws all that is displayed.
void drawAll(Pen& pen, const StyleSheets& styles, const xmlNode& root)
{
    static const std::set<std::string_view> unseen{"defs",   "symbol", "clipPath", "mask",         "pattern",
                                                   "marker", "text",   "metadata", "foreignObject"};
    std::vector<std::pair<const xmlNode*, Matrix>> open{{&root, Matrix{}}};
    while (!open.empty()) {
        const auto [element, outer] = open.back();
        open.pop_back();
        const auto display = styles.own(*element, "display");
        if (unseen.contains(nameOf(*element)) || (display && lowered(trimmed(display->value)) == "none")) {
            continue;
        }
        const Matrix whole = outer * mapOf(styles, *element);
        pen.place(whole);
        drawShape(pen, *element);
        for (const xmlNode* child = element->last; child != nullptr; child = child->prev) {
            if (isElement(child) && isDrawn(*child)) {
                open.emplace_back(child, whole);
            }
        }
    }
    pen.lift();
}

/// Draws one element.
void drawOne(Pen& pen, const StyleSheets& styles, const xmlNode& element)
{
    Matrix whole;
    for (const xmlNode* here = &element; isElement(here); here = here->parent) {
        whole = mapOf(styles, *here) * whole;
    }
    pen.place(whole);
    drawShape(pen, element);
    pen.lift();
}

double widthOf(const std::vector<Part>& parts)
{
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Part& part : parts) {
        for (const Vec2 p : part.points) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
    }
    return high - low;
}

}  // namespace

SvgLine lineIn(std::span<const std::byte> text)
{
    const DrawingTree document = parseDrawing(text);
    xmlNode* const root = document ? xmlDocGetRootElement(document.get()) : nullptr;
    if (root == nullptr) {
        return {};
    }
    const StyleSheets styles(*root);
    const xmlNode* const user =
        firstElement(*root, [](const xmlNode& element) { return nameOf(element) == "textPath"; });
    const std::string target(user == nullptr ? "" : trimmed(attributeOf(*user, "href").value_or("")));
    const xmlNode* const used = target.starts_with('#') ? elementOf(*root, target.substr(1)) : nullptr;
    std::vector<Part> parts;
    Pen pen(parts);
    if (used != nullptr) {
        drawOne(pen, styles, *used);
    }
    const bool is_named = !parts.empty();
    if (!is_named) {
        drawAll(pen, styles, *root);
    }
    if (parts.empty()) {
        return {};
    }
    SvgLine line;
    const auto box = viewBoxOf(*root);
    const auto width = pixelsOf(*root, "width");
    const auto height = pixelsOf(*root, "height");
    line.page_width = width           ? *width
                      : box && height ? *height * box->width / box->height
                      : box           ? box->width
                                      : widthOf(parts);
    line.others = is_named ? 0 : parts.size() - 1;
    // The first one of the longest.
    line.points = std::move(std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
                                return a.length < b.length;
                            })->points);
    return line;
}

}  // namespace droplet
