// SPDX-License-Identifier: GPL-3.0-or-later
//
// The module turns arrays and arguments into values of the library, and back. The package droplet_shape around it has
// the functions that users call.
#include <pybind11/pybind11.h>

#include "animation.h"
#include "comparison.h"
#include "droplet/version.h"
#include "errors.h"
#include "glyphs.h"
#include "mask.h"
#include "shape.h"
#include "surface.h"
#include "wind.h"
#include "windshield.h"

PYBIND11_MODULE(_core, module)
{
    module.attr("version") = droplet::kVersion;
    binding::registerErrors();
    binding::bindSurface(module);
    binding::bindMask(module);
    binding::bindShape(module);
    binding::bindGlyphs(module);
    binding::bindAnimation(module);
    binding::bindComparison(module);
    binding::bindWind(module);
    binding::bindWindshield(module);
    for (const char* name :
         {"Animation", "Droplet", "Mask", "Surface", "Windshield", "WindshieldFigures", "WindshieldWater"}) {
        module.attr(name).attr("__module__") = "droplet_shape";
    }
}
