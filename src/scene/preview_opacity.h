// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/surface/material.h"

namespace droplet {

/// Opacity of a material in formats without refraction, which show a liquid's transparency by it.
inline double previewOpacity(const Look& look)
{
    return look.transmission > 0.0 ? 0.35 : 1.0;
}

}  // namespace droplet
