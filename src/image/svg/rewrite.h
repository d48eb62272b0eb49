// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace droplet {

/// A drawing that librsvg draws as it is meant.
struct Rewritten {
    std::string text;                    ///< of the changed drawing; empty if it may stay as it is
    std::vector<std::string> not_drawn;  ///< what librsvg lacks and the drawing has, each once, with advice in brackets
};

/// Writes parts of a drawing that librsvg 2.54 lacks in other words: var(), calc(), transform-origin, transform-box,
/// translate, rotate and scale as properties, basic shapes of clip-path, d as a property, and strokes that do not
/// scale. Lists what cannot be written so. A drawing that is no XML is left as it is.
Rewritten rewritten(std::span<const std::byte> text);

}  // namespace droplet
