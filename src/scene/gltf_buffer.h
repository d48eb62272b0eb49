// SPDX-License-Identifier: GPL-3.0-or-later
// The buffer of a glTF file. An array is declared together with its data, so that header and buffer agree.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "byte_stream.h"
#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Array of numbers: what its accessor says, and its data.
struct GltfArray {
    int component_type = TINYGLTF_COMPONENT_TYPE_FLOAT;
    int type = TINYGLTF_TYPE_SCALAR;
    bool normalised = false;
    std::size_t count = 0;                        ///< number of elements
    std::size_t stride = 0;                       ///< from one element to the next [bytes]
    std::function<void(ByteStream&)> write = {};  ///< writes count · stride bytes
    std::vector<double> low = {};                 ///< bounds of each component; or empty
    std::vector<double> high = {};

    [[nodiscard]] std::size_t bytes() const { return count * stride; }
};

/// tinygltf's type of a vector.
constexpr int gltfType(std::size_t components)
{
    return components == 1    ? TINYGLTF_TYPE_SCALAR
           : components == 16 ? TINYGLTF_TYPE_MAT4
                              : static_cast<int>(components);
}

/// Array of vectors of floats.
/// @param vectors  must outlive the array
template <std::size_t Size>
GltfArray arrayOf(const std::vector<std::array<float, Size>>& vectors)
{
    return {.type = gltfType(Size),
            .count = vectors.size(),
            .stride = Size * sizeof(float),
            .write = [&vectors](ByteStream& bytes) {
                for (const std::array<float, Size>& vector : vectors) {
                    for (const float number : vector) {
                        bytes.f32(number);
                    }
                }
            }};
}

/// Array of vectors of integers with one or two bytes; lanes beyond the components are padding.
template <class Integer, std::size_t Lanes>
GltfArray arrayOf(std::vector<std::array<Integer, Lanes>> vectors, std::size_t components, int component_type)
{
    const std::size_t count = vectors.size();
    return {.component_type = component_type,
            .type = gltfType(components),
            .normalised = true,
            .count = count,
            .stride = Lanes * sizeof(Integer),
            .write = [own = std::move(vectors)](ByteStream& bytes) {
                for (const std::array<Integer, Lanes>& vector : own) {
                    for (const Integer number : vector) {
                        if constexpr (sizeof(Integer) == 1) {
                            bytes.u8(number);
                        } else {
                            bytes.u16(number);
                        }
                    }
                }
            }};
}

/// Array of floats, some for each element.
/// @param numbers  must outlive the array
GltfArray arrayOf(const std::vector<float>& numbers, std::size_t components = 1);

/// Array of the vertices of triangles, with 16 bits each where these suffice.
/// @param triangles  must outlive the array
GltfArray arrayOf(const std::vector<Triangle>& triangles, std::size_t vertices);

/// What a view of the buffer holds; it decides its codec.
enum class GltfContent { Vertices, OctahedralNormals, Indices, Other };

/// Arrays and pictures in the order of the file.
class GltfBuffer {
public:
    /// @param model       takes the views and accessors; must outlive this
    /// @param is_encoded  by EXT_meshopt_compression
    GltfBuffer(tinygltf::Model& model, bool is_encoded) : model_(model), is_encoded_(is_encoded) {}

    /// Adds an array in a view of its own; returns the index of its accessor.
    int add(const GltfArray& array, GltfContent content);
    /// Adds arrays with one stride in one view; returns the index of the first one's accessor.
    int add(const std::vector<GltfArray>& arrays, GltfContent content);
    /// Adds the bytes of a picture, which must outlive this; returns the index of its view.
    int addPicture(const std::string& bytes);

    /// Length in the file.
    [[nodiscard]] std::size_t bytes() const { return end_; }
    void write(ByteStream& bytes) const;
    /// The model as JSON, with the length of the buffer but without its bytes.
    [[nodiscard]] nlohmann::json json() const;

private:
    struct Piece {
        std::size_t begin = 0;
        std::size_t bytes = 0;
        std::function<void(ByteStream&)> write;
        nlohmann::json codec;  ///< extension of its view; null: none
    };

    /// Adds bytes at the next word.
    void append(std::size_t bytes, std::function<void(ByteStream&)> write);
    void encode(const std::vector<GltfArray>& arrays, GltfContent content, tinygltf::BufferView& view);

    tinygltf::Model& model_;
    bool is_encoded_;
    std::vector<Piece> pieces_;  ///< one for each view
    std::size_t end_ = 0;
    std::size_t decoded_end_ = 0;  ///< of the buffer that there would be without the codec
};

}  // namespace droplet
