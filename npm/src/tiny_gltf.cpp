// SPDX-License-Identifier: GPL-3.0-or-later
// Debian has tinygltf as a header and a library; here it is made from the header.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
// The second header needs the first one.
// clang-format off
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>
// clang-format on

namespace tinygltf {

// The module neither reads nor writes pictures.
bool LoadImageData(Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*)
{
    return false;
}

bool WriteImageData(const std::string*, const std::string*, const Image*, bool, std::string*, void*)
{
    return false;
}

}  // namespace tinygltf
