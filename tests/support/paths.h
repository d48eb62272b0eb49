// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace droplet::testing {

// Paths that tests need. CMake writes them into a separate file, so that other object files do not depend on the
// checkout's path, and a compiler cache serves every checkout.
extern const char* const kCommand;     ///< droplet-shape
extern const char* const kSourceDir;   ///< the checkout
extern const char* const kScratchDir;  ///< folder for files of tests
extern const char* const kValidator;   ///< node script: glTF validator
extern const char* const kChromium;    ///< browser
extern const char* const kPageDriver;  ///< node script: drives a page in the browser
extern const char* const kMeshReader;  ///< node script: loads meshes in three.js
extern const char* const kPlayer;      ///< node script: plays an animation in three.js
extern const char* const kRainPlayer;  ///< plays a windshield's models in a browser
extern const char* const kThree;       ///< folder of three.js

/// Path of a file of the checkout.
inline std::string inSource(const std::string& name)
{
    return std::string(kSourceDir) + "/" + name;
}

}  // namespace droplet::testing
