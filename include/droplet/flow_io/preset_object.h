// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/flow_io/flow_object.h"

namespace droplet {

/// Objects of the presets, made by formula, z up; they look towards −y.
enum class PresetObject {
    Slope,   ///< square of 30 cm on a slope of 30°; its lower edge is towards −y
    Slopes,  ///< three strips of such a slope side by side, with the materials `left`, `middle` and `right`
    Plate,   ///< a level plate of 4 cm
    Sphere,  ///< of 20 cm diameter
    Mask,    ///< face of 22 cm with openings for eyes and mouth, open behind
    Bottle,  ///< closed bottle of 24 cm with foot, shoulder, neck and lip
    Leaf,    ///< leaf of 12 cm that droops towards −y, with a valley along its middle and veins
    Car,     ///< closed body of a model car of 44 cm; its front is towards −y
    Window,  ///< upright pane of 30 cm by 40 cm, whose outside is towards −y
};

/// Makes an object, with normals, uvs and material names. The meshes are in the public domain (CC0).
/// @param object  which one
/// @param detail  factor on the number of triangles along each direction, from 0.25 to 20; at 1 the mask has about 2000
/// @throws Error  InvalidArgument if `detail` is out of its range
FlowObject presetObject(PresetObject object, double detail = 1.0);

}  // namespace droplet
