// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a glTF file. Khronos Group, "glTF 2.0 Specification" (2021), sections 3.6 and 3.11.
#pragma once

#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "droplet/vector.h"
#include "file_bytes.h"

namespace droplet {

/// Element of a list of the file.
/// @param name  of the list
/// @throws Damage
template <typename T>
const T& entry(const std::vector<T>& list, int index, const char* name)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
        throw Damage(std::string(name) + "[" + std::to_string(index) + "] does not exist");
    }
    return list[static_cast<std::size_t>(index)];
}

/// Numbers of an accessor. The constructor checks the bounds.
class Column {
public:
    /// @param accessor_index  in the file
    /// @param type            tinygltf's constant of an element
    /// @throws Damage
    Column(const tinygltf::Model& model, int accessor_index, int type)
    {
        const std::string name = "accessors[" + std::to_string(accessor_index) + "]";
        const tinygltf::Accessor& accessor = entry(model.accessors, accessor_index, "accessors");
        if (accessor.type != type) {
            throw Damage(name + " should hold " + nameOf(type));
        }
        if (accessor.bufferView < 0 && !accessor.sparse.isSparse) {
            throw Damage(name + " has no data or compressed data");
        }
        constexpr std::size_t kMaxWithoutData = std::size_t{1} << 24;  // a small file can state any count
        if (accessor.bufferView < 0 && accessor.count > kMaxWithoutData) {
            throw Damage(name + " has no data for so many elements");
        }
        count_ = accessor.count;
        normalised_ = accessor.normalized;
        kind_ = accessor.componentType;
        const auto lanes = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
        if (accessor.bufferView >= 0) {
            data_.emplace(model, Place{accessor.bufferView, accessor.byteOffset, count_}, Element{kind_, lanes}, name);
        }
        if (accessor.sparse.isSparse) {
            const auto& [count, is_sparse, indices, values] = accessor.sparse;
            const auto changed = static_cast<std::size_t>(count);
            const std::string changes = name + ", which is sparse,";
            Sparse& sparse = sparse_.emplace(
                Sparse{Numbers(model, Place{indices.bufferView, static_cast<std::size_t>(indices.byteOffset), changed},
                               Element{indices.componentType, 1}, changes),
                       Numbers(model, Place{values.bufferView, static_cast<std::size_t>(values.byteOffset), changed},
                               Element{kind_, lanes}, changes),
                       changed});
            if (!isCount(indices.componentType)) {
                throw Damage(changes + " has indices that are not unsigned integers");
            }
            for (std::size_t i = 0; i < changed; ++i) {
                if (!(sparse.at(i) < static_cast<double>(count_)) || (i > 0 && !(sparse.at(i) > sparse.at(i - 1)))) {
                    throw Damage(changes + " has indices that do not ascend below its count");
                }
            }
        }
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    /// Whether the numbers are unsigned integers that are not normalised.
    [[nodiscard]] bool counts() const { return !normalised_ && isCount(kind_); }

    /// Value of a component; normalised integers as in section 3.11 of the specification.
    [[nodiscard]] double number(std::size_t i, std::size_t k = 0) const
    {
        if (sparse_) {
            if (const auto changed = sparse_->find(i)) {
                return scaled(sparse_->values.number(*changed, k));
            }
        }
        return data_ ? scaled(data_->number(i, k)) : 0.0;
    }

    [[nodiscard]] Vec2 vec2(std::size_t i) const { return {number(i, 0), number(i, 1)}; }
    [[nodiscard]] Vec3 vec3(std::size_t i) const { return {number(i, 0), number(i, 1), number(i, 2)}; }

private:
    struct Place {
        int view = 0;
        std::size_t offset = 0;
        std::size_t count = 0;
    };
    struct Element {
        int kind = 0;           ///< of its components
        std::size_t lanes = 0;  ///< their number
    };

    /// Numbers in a buffer.
    class Numbers {
    public:
        /// @param name  for messages
        Numbers(const tinygltf::Model& model, const Place& place, const Element& element, const std::string& name)
            : kind_(element.kind)
        {
            if (kind_ == TINYGLTF_COMPONENT_TYPE_INT || kind_ == TINYGLTF_COMPONENT_TYPE_DOUBLE ||
                tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(kind_)) <= 0) {
                throw Damage(name + " has components of unknown type");
            }
            component_bytes_ =
                static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(kind_)));
            const std::size_t bytes = component_bytes_ * element.lanes;
            const tinygltf::BufferView& view = entry(model.bufferViews, place.view, "bufferViews");
            const std::span<const unsigned char> buffer = entry(model.buffers, view.buffer, "buffers").data;
            stride_ = view.byteStride == 0 ? bytes : view.byteStride;
            const std::size_t begin = view.byteOffset;
            const std::size_t length = view.byteLength;
            const bool inside = begin <= buffer.size() && length <= buffer.size() - begin && place.offset <= length;
            if (!inside || stride_ < bytes ||
                (place.count > 0 &&
                 (length - place.offset < bytes || place.count - 1 > (length - place.offset - bytes) / stride_))) {
                throw Damage(name + " reaches beyond its buffer");
            }
            bytes_ = buffer.subspan(begin + place.offset, length - place.offset);
        }

        [[nodiscard]] double number(std::size_t i, std::size_t k) const
        {
            const unsigned char* const at = bytes_.data() + i * stride_ + k * component_bytes_;
            switch (kind_) {
                case TINYGLTF_COMPONENT_TYPE_FLOAT:
                    return static_cast<double>(load<float>(at));
                case TINYGLTF_COMPONENT_TYPE_BYTE:
                    return load<std::int8_t>(at);
                case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                    return load<std::uint8_t>(at);
                case TINYGLTF_COMPONENT_TYPE_SHORT:
                    return load<std::int16_t>(at);
                case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                    return load<std::uint16_t>(at);
                default:
                    return load<std::uint32_t>(at);
            }
        }

    private:
        template <typename T>
        static T load(const unsigned char* from)
        {
            T value{};
            std::memcpy(&value, from, sizeof value);
            return value;
        }

        std::span<const unsigned char> bytes_;
        std::size_t stride_ = 0;
        std::size_t component_bytes_ = 0;
        int kind_ = 0;
    };

    /// Elements in place of others.
    struct Sparse {
        Numbers indices;
        Numbers values;
        std::size_t count = 0;

        [[nodiscard]] double at(std::size_t i) const { return indices.number(i, 0); }
        /// Number of the change of an element, if there is one.
        [[nodiscard]] std::optional<std::size_t> find(std::size_t element) const
        {
            const auto wanted = static_cast<double>(element);
            std::size_t first = 0;
            for (std::size_t size = count; size > 0;) {
                const std::size_t half = size / 2;
                const bool is_before = at(first + half) < wanted;
                first += is_before ? half + 1 : 0;
                size = is_before ? size - half - 1 : half;
            }
            return first < count && at(first) == wanted ? std::optional(first) : std::nullopt;
        }
    };

    static bool isCount(int kind)
    {
        return kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
               kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    }

    static const char* nameOf(int type)
    {
        switch (type) {
            case TINYGLTF_TYPE_SCALAR:
                return "SCALAR";
            case TINYGLTF_TYPE_VEC2:
                return "VEC2";
            case TINYGLTF_TYPE_VEC3:
                return "VEC3";
            case TINYGLTF_TYPE_MAT4:
                return "MAT4";
            default:
                return "VEC4";
        }
    }

    [[nodiscard]] double scaled(double value) const
    {
        if (!normalised_) {
            return value;
        }
        switch (kind_) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return std::max(value / 127.0, -1.0);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return value / 255.0;
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return std::max(value / 32767.0, -1.0);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return value / 65535.0;
            default:
                return value;
        }
    }

    std::optional<Numbers> data_;  ///< empty: all are 0
    std::optional<Sparse> sparse_;
    std::size_t count_ = 0;
    int kind_ = 0;
    bool normalised_ = false;
};

}  // namespace droplet
