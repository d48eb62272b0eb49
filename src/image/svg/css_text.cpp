// SPDX-License-Identifier: GPL-3.0-or-later
// After: CSS Values and Units 4 (W3C), 5 to 10; CSS Transforms 1 and 2; SVG 2, 8.5.
#include "image/svg/css_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace droplet {
namespace {

constexpr double kDotsPerInch = 96.0;

bool isSpace(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool isNameCharacter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

/// A quantity with its unit as in Quantity; none if the unit is not known.
std::optional<Quantity> known(double value, const std::string& unit)
{
    struct Unit {
        std::string_view name;
        double factor;
        const char* as;
    };
    static constexpr std::array<Unit, 13> kUnits{{{"", 1.0, ""},
                                                  {"%", 1.0, "%"},
                                                  {"px", 1.0, "px"},
                                                  {"in", kDotsPerInch, "px"},
                                                  {"cm", kDotsPerInch / 2.54, "px"},
                                                  {"mm", kDotsPerInch / 25.4, "px"},
                                                  {"q", kDotsPerInch / 101.6, "px"},
                                                  {"pt", kDotsPerInch / 72.0, "px"},
                                                  {"pc", kDotsPerInch / 6.0, "px"},
                                                  {"deg", 1.0, "deg"},
                                                  {"grad", 0.9, "deg"},
                                                  {"turn", 360.0, "deg"},
                                                  {"rad", 180.0 / std::numbers::pi, "deg"}}};
    const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& each) { return each.name == unit; });
    return found == kUnits.end() || !std::isfinite(value) ? std::nullopt
                                                          : std::optional(Quantity{value * found->factor, found->as});
}

/// Reads sums, products and functions of quantities.
class Calculation {
public:
    explicit Calculation(std::string_view text) : text_(text) {}

    std::optional<Quantity> whole()
    {
        auto result = operand();
        skipSpace();
        return at_ == text_.size() ? result : std::nullopt;
    }

private:
    static constexpr int kMaxDepth = 32;

    void skipSpace()
    {
        while (at_ < text_.size() && isSpace(text_[at_])) {
            ++at_;
        }
    }

    [[nodiscard]] bool take(char c)
    {
        const std::size_t begin = at_;
        skipSpace();
        if (at_ < text_.size() && text_[at_] == c) {
            ++at_;
            return true;
        }
        at_ = begin;  // the white space may belong to a sign
        return false;
    }

    /// A plus or minus with white space around it, as sums need it.
    std::optional<char> takeSign()
    {
        const std::size_t begin = at_;
        skipSpace();
        if (at_ > begin && at_ + 1 < text_.size() && (text_[at_] == '+' || text_[at_] == '-') &&
            isSpace(text_[at_ + 1])) {
            return text_[at_++];
        }
        at_ = begin;
        return std::nullopt;
    }

    std::optional<Quantity> sum()
    {
        auto total = product();
        while (total) {
            const auto sign = takeSign();
            if (!sign) {
                break;
            }
            const auto next = product();
            if (!next || next->unit != total->unit) {
                return std::nullopt;
            }
            total->value += *sign == '+' ? next->value : -next->value;
        }
        return total;
    }

    std::optional<Quantity> product()
    {
        auto total = operand();
        while (total) {
            const bool times = take('*');
            if (!times && !take('/')) {
                break;
            }
            const auto next = operand();
            if (!next || (!next->unit.empty() && (!times || !total->unit.empty()))) {
                return std::nullopt;
            }
            total->value = times ? total->value * next->value : total->value / next->value;
            total->unit = total->unit.empty() ? next->unit : total->unit;
        }
        return total && std::isfinite(total->value) ? total : std::nullopt;
    }

    std::optional<Quantity> operand()
    {
        skipSpace();
        if (depth_ >= kMaxDepth || at_ >= text_.size()) {
            return std::nullopt;
        }
        ++depth_;
        auto result = text_[at_] == '(' || (text_[at_] >= 'a' && text_[at_] <= 'z') ? bracket() : number();
        --depth_;
        return result;
    }

    std::optional<Quantity> bracket()
    {
        const std::size_t open = text_.find('(', at_);
        if (open == std::string_view::npos) {
            return std::nullopt;
        }
        const std::string_view name = text_.substr(at_, open - at_);
        at_ = open + 1;
        std::vector<Quantity> values;
        do {
            const auto value = sum();
            if (!value || (!values.empty() && value->unit != values.front().unit)) {
                return std::nullopt;
            }
            values.push_back(*value);
        } while (take(','));
        if (!take(')')) {
            return std::nullopt;
        }
        const auto by_value = [](const Quantity& a, const Quantity& b) { return a.value < b.value; };
        if (name == "min") {
            return *std::min_element(values.begin(), values.end(), by_value);
        }
        if (name == "max") {
            return *std::max_element(values.begin(), values.end(), by_value);
        }
        if (name == "clamp" && values.size() == 3) {
            return std::max(values[0], std::min(values[1], values[2], by_value), by_value);
        }
        return (name.empty() || name == "calc") && values.size() == 1 ? std::optional(values[0]) : std::nullopt;
    }

    std::optional<Quantity> number()
    {
        const std::string rest(text_.substr(at_, 64));
        char* end = nullptr;
        // Neither infinity nor hexadecimal numbers, which strtod() reads, too.
        const std::size_t first = rest[0] == '-' || rest[0] == '+' ? 1 : 0;
        const std::size_t x = rest.find('x');
        const bool is_plain = first < rest.size() &&
                              (rest[first] == '.' || (rest[first] >= '0' && rest[first] <= '9')) &&
                              !(x == first + 1 && rest[first] == '0');
        const double value = is_plain ? std::strtod(rest.c_str(), &end) : 0.0;
        if (!is_plain || end == rest.c_str()) {
            return std::nullopt;
        }
        at_ += static_cast<std::size_t>(end - rest.c_str());
        const std::size_t begin = at_;
        while (at_ < text_.size() && (text_[at_] == '%' || (text_[at_] >= 'a' && text_[at_] <= 'z'))) {
            ++at_;
        }
        return known(value, std::string(text_.substr(begin, at_ - begin)));
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

/// Numbers of a function's arguments: lengths in px, angles in degrees. In attributes nothing need separate them.
std::optional<std::vector<double>> argumentsOf(std::string_view text)
{
    constexpr std::string_view kSeparators = " \t\r\n\f,";
    std::vector<double> numbers;
    for (std::size_t at = text.find_first_not_of(kSeparators); at < text.size();
         at = text.find_first_not_of(kSeparators, at)) {
        const std::size_t begin = at;
        at += text[at] == '-' || text[at] == '+' ? 1 : 0;
        bool has_point = false;
        while (at < text.size() && ((text[at] >= '0' && text[at] <= '9') || (text[at] == '.' && !has_point))) {
            has_point = has_point || text[at] == '.';
            ++at;
        }
        if (at + 1 < text.size() && (text[at] == 'e' || text[at] == 'E') &&
            (text[at + 1] == '-' || text[at + 1] == '+' || (text[at + 1] >= '0' && text[at + 1] <= '9'))) {
            at = std::min(text.find_first_not_of("0123456789", at + 2), text.size());
        }
        while (at < text.size() && (isNameCharacter(text[at]) || text[at] == '%') && text[at] != '-' &&
               (text[at] < '0' || text[at] > '9')) {
            ++at;
        }
        if (at < text.size() && text[at] == '(') {
            at = closingOf(text, at).value_or(text.size());
        }
        const auto quantity = parseQuantity(text.substr(begin, at - begin));
        if (at == begin || !quantity || quantity->unit == "%") {
            return std::nullopt;
        }
        numbers.push_back(quantity->value);
    }
    return numbers;
}

std::optional<Matrix> functionOf(const std::string& name, const std::vector<double>& at)
{
    const std::size_t n = at.size();
    const auto radians = [&](std::size_t k) { return at[k] * std::numbers::pi / 180.0; };
    const auto rotation = [&](std::size_t k) -> Matrix {
        return {std::cos(radians(k)), std::sin(radians(k)), -std::sin(radians(k)), std::cos(radians(k)), 0.0, 0.0};
    };
    if (name == "matrix" && n == 6) {
        return Matrix{at[0], at[1], at[2], at[3], at[4], at[5]};
    }
    if ((name == "translate" && (n == 1 || n == 2)) || (name == "translate3d" && n == 3)) {
        return Matrix{1.0, 0.0, 0.0, 1.0, at[0], n > 1 ? at[1] : 0.0};
    }
    if (n == 1 && (name == "translatex" || name == "translatey" || name == "translatez")) {
        return Matrix{1.0, 0.0, 0.0, 1.0, name == "translatex" ? at[0] : 0.0, name == "translatey" ? at[0] : 0.0};
    }
    if ((name == "scale" && (n == 1 || n == 2)) || (name == "scale3d" && n == 3)) {
        return Matrix{at[0], 0.0, 0.0, n > 1 ? at[1] : at[0], 0.0, 0.0};
    }
    if (n == 1 && (name == "scalex" || name == "scaley" || name == "scalez")) {
        return Matrix{name == "scalex" ? at[0] : 1.0, 0.0, 0.0, name == "scaley" ? at[0] : 1.0, 0.0, 0.0};
    }
    if ((name == "rotate" || name == "rotatez") && n == 1) {
        return rotation(0);
    }
    if (name == "rotate" && n == 3) {
        return Matrix{1, 0, 0, 1, at[1], at[2]} * rotation(0) * Matrix{1, 0, 0, 1, -at[1], -at[2]};
    }
    if ((name == "skewx" && n == 1) || (name == "skew" && (n == 1 || n == 2))) {
        return Matrix{1.0, n > 1 ? std::tan(radians(1)) : 0.0, std::tan(radians(0)), 1.0, 0.0, 0.0};
    }
    if (name == "skewy" && n == 1) {
        return Matrix{1.0, std::tan(radians(0)), 0.0, 1.0, 0.0, 0.0};
    }
    return std::nullopt;
}

}  // namespace

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && isSpace(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && isSpace(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

std::string lowered(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

std::optional<std::size_t> closingOf(std::string_view text, std::size_t open)
{
    int depth = 0;
    char quote = '\0';
    for (std::size_t k = open; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '\\') {
            ++k;
        } else if (quote != '\0') {
            quote = c == quote ? '\0' : quote;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '(' || c == '{' || c == '[') {
            ++depth;
        } else if (c == ')' || c == '}' || c == ']') {
            if (--depth == 0) {
                return k + 1;
            }
        }
    }
    return std::nullopt;
}

std::vector<std::string_view> partsOf(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    const bool by_space = separator == ',';
    std::size_t begin = 0;
    const auto end_at = [&](std::size_t end) {
        const std::string_view part = trimmed(text.substr(begin, end - begin));
        if (!part.empty()) {
            parts.push_back(part);
        }
        begin = end + 1;
    };
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == separator || (by_space && isSpace(c))) {
            end_at(k);
        } else if (c == '(' || c == '[' || c == '{') {
            const auto after = closingOf(text, k);
            k = after ? *after - 1 : text.size();
        } else if (c == '"' || c == '\'') {
            k = std::min(text.find(c, k + 1), text.size());
        }
    }
    if (begin < text.size()) {
        end_at(text.size());
    }
    return parts;
}

std::optional<Quantity> parseQuantity(std::string_view text)
{
    const std::string lower = lowered(trimmed(text));
    return Calculation(lower).whole();
}

std::optional<double> parsePixels(std::string_view text)
{
    const auto quantity = parseQuantity(text);
    return quantity && (quantity->unit.empty() || quantity->unit == "px") ? std::optional(quantity->value)
                                                                          : std::nullopt;
}

std::string text(const Quantity& quantity)
{
    return fmt::format("{:.10g}{}", quantity.value, quantity.unit);
}

std::optional<FoundFunction> findFunction(std::string_view text, const std::vector<std::string_view>& names)
{
    for (std::size_t open = text.find('('); open != std::string_view::npos; open = text.find('(', open + 1)) {
        std::size_t begin = open;
        while (begin > 0 && isNameCharacter(text[begin - 1])) {
            --begin;
        }
        const std::string name = lowered(text.substr(begin, open - begin));
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            continue;
        }
        const auto end = closingOf(text, open);
        return end ? std::optional(FoundFunction{begin, *end, text.substr(open + 1, *end - open - 2)}) : std::nullopt;
    }
    return std::nullopt;
}

Matrix operator*(const Matrix& outer, const Matrix& inner)
{
    return {outer.a * inner.a + outer.c * inner.b,           outer.b * inner.a + outer.d * inner.b,
            outer.a * inner.c + outer.c * inner.d,           outer.b * inner.c + outer.d * inner.d,
            outer.a * inner.e + outer.c * inner.f + outer.e, outer.b * inner.e + outer.d * inner.f + outer.f};
}

std::string text(const Matrix& matrix)
{
    // librsvg reads no exponents.
    return fmt::format("matrix({:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f})", matrix.a, matrix.b, matrix.c,
                       matrix.d, matrix.e, matrix.f);
}

std::optional<Matrix> parseTransform(std::string_view text)
{
    Matrix matrix;
    for (std::string_view rest = trimmed(text); !rest.empty() && lowered(rest) != "none";) {
        const std::size_t open = std::min(rest.find('('), rest.size());
        const std::size_t end = closingOf(rest, open).value_or(0);
        const auto arguments = end > 0 ? argumentsOf(rest.substr(open + 1, end - open - 2)) : std::nullopt;
        const auto next = arguments ? functionOf(lowered(trimmed(rest.substr(0, open))), *arguments) : std::nullopt;
        if (!next) {
            return std::nullopt;
        }
        matrix = matrix * *next;
        rest = trimmed(rest.substr(end));
        while (!rest.empty() && rest.front() == ',') {
            rest = trimmed(rest.substr(1));
        }
    }
    return matrix;
}

}  // namespace droplet
