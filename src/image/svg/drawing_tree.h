// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <libxml/tree.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/svg/css_text.h"

namespace droplet {

/// Tree of a drawing.
using DrawingTree = std::unique_ptr<xmlDoc, void (*)(xmlDoc*)>;

/// Parses a drawing. Nothing that it refers to is read.
/// @return  null if it is no XML
DrawingTree parseDrawing(std::span<const std::byte> text);

/// Text of a tree in UTF-8.
std::string textOf(xmlDoc* document);

void setAttribute(xmlNode& element, const char* name, const std::string& value);

/// Whether an element belongs to a drawing, and is not data of an editor.
bool isDrawn(const xmlNode& element);

/// First element of a tree that is wanted, in the order of the text; null if there is none.
xmlNode* firstElement(xmlNode& root, const std::function<bool(const xmlNode&)>& is_wanted);

/// First element of a tree with an id; null if there is none.
xmlNode* elementOf(xmlNode& root, std::string_view id);

/// Rectangle in the coordinates of an element.
struct SvgBox {
    double x = 0.0;
    double y = 0.0;
    double width = 0.0;
    double height = 0.0;
};

/// Four numbers of a viewBox.
std::optional<SvgBox> viewBoxOf(const xmlNode& element);

/// Attribute that is a number or a length [px].
std::optional<double> pixelsOf(const xmlNode& element, const char* name);

/// Map from the content of an svg element to what is around it, without its place; none if it depends on the latter.
std::optional<Matrix> viewportScale(const xmlNode& element);

/// Whether an element refers to something that is not in the drawing.
bool refersOutside(const xmlNode& element);

/// Families of the value of `font-family`, without quotes.
std::vector<std::string> familiesIn(std::string_view value);

}  // namespace droplet
