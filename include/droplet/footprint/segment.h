// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// How the pixels of a picture are told into liquid and dry.
enum class Segmentation {
    Auto,       ///< Threshold, or Adaptive where that makes the better mask; a picture that is no mask is refused
    Threshold,  ///< one level for the whole picture, or alpha: right for drawings, logos, type and scans
    Adaptive,   ///< levels of dry and liquid that follow the light from place to place: right for photographs
    GrabCut,    ///< colours of dry and liquid, learned from what Adaptive finds, with a short rim between them
    Colour,     ///< what has the colour asked for
};

/// `auto`, `threshold`, `adaptive`, `grabcut` or `colour`.
const char* name(Segmentation segment);

}  // namespace droplet
