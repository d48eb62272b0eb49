// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <libxml/tree.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace droplet {

/// Tree of a drawing.
using DrawingTree = std::unique_ptr<xmlDoc, void (*)(xmlDoc*)>;

/// Parses a drawing. Nothing that it refers to is read.
/// @return  null if it is no XML
DrawingTree parseDrawing(std::span<const std::byte> text);

/// Text of a tree in UTF-8.
std::string textOf(xmlDoc* document);

void setAttribute(xmlNode& element, const char* name, const std::string& value);

/// Whether an element refers to something that is not in the drawing.
bool refersOutside(const xmlNode& element);

/// Families of the value of `font-family`, without quotes.
std::vector<std::string> familiesIn(std::string_view value);

}  // namespace droplet
