// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Values in style sheets and attributes of SVG.

namespace droplet {

/// Text without white space at its ends.
std::string_view trimmed(std::string_view text);
/// Letters A to Z in lower case.
std::string lowered(std::string_view text);
/// Parts of a text between separators that are outside brackets and quotes, trimmed; white space may separate, too.
std::vector<std::string_view> partsOf(std::string_view text, char separator);
/// Index after the bracket that closes the one at `open`; none if nothing closes it.
std::optional<std::size_t> closingOf(std::string_view text, std::size_t open);

/// Number with a unit.
struct Quantity {
    double value = 0.0;
    std::string unit;  ///< px for all absolute lengths, deg for all angles, % or nothing
};

/// A number with a unit that this program knows, or a calculation of such numbers: calc(), min(), max(), clamp().
std::optional<Quantity> parseQuantity(std::string_view text);
/// A number, or a length in px.
std::optional<double> parsePixels(std::string_view text);
/// Text that parseQuantity() reads.
std::string text(const Quantity& quantity);

/// A function such as calc() in a value: where it begins and what follows it.
struct FoundFunction {
    std::size_t begin = 0;     ///< of its name
    std::size_t end = 0;       ///< after its closing bracket
    std::string_view content;  ///< between its brackets
};

/// First function of one of these names, in lower case; none if there is none, or its bracket is not closed.
std::optional<FoundFunction> findFunction(std::string_view text, const std::vector<std::string_view>& names);

/// Affine map: x' = a x + c y + e, y' = b x + d y + f.
struct Matrix {
    double a = 1.0;
    double b = 0.0;
    double c = 0.0;
    double d = 1.0;
    double e = 0.0;
    double f = 0.0;
};

/// The map that applies `inner` first.
Matrix operator*(const Matrix& outer, const Matrix& inner);
/// Text of a map, for attributes and style sheets.
std::string text(const Matrix& matrix);
/// Transformations of an attribute or of a style sheet in the plane; none if they have percentages or leave it.
std::optional<Matrix> parseTransform(std::string_view text);

}  // namespace droplet
