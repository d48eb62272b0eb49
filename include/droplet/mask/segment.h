// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Methods that sort the pixels of a picture into liquid and dry.
enum class Segmentation {
    Auto,       ///< Threshold, or Adaptive if its mask is better; throws if neither gives a mask
    Threshold,  ///< one level for the whole picture, or alpha; for drawings, logos, type and scans
    Adaptive,   ///< levels of dry and liquid that follow the light across the picture; for photographs
    GrabCut,    ///< colours of dry and liquid, learned from the result of Adaptive, with a short rim between them
    Colour,     ///< everything of a given colour
    Seeds,      ///< what strokes say, out to the strongest edges between them
};

/// Name of a method: `auto`, `threshold`, `adaptive`, `grabcut`, `colour` or `seeds`.
const char* name(Segmentation segment);

}  // namespace droplet
