// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace droplet::testing {

inline std::string littleEndian(std::uint32_t value, std::size_t bytes = 4)
{
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i) {
        text += static_cast<char>(value >> (8 * i));
    }
    return text;
}

inline std::string floats(const std::vector<float>& values)
{
    std::string text;
    for (const float value : values) {
        text += littleEndian(std::bit_cast<std::uint32_t>(value));
    }
    return text;
}

inline std::string glb(std::string json, std::string buffer)
{
    json.append((4 - json.size() % 4) % 4, ' ');
    buffer.append((4 - buffer.size() % 4) % 4, '\0');
    std::string chunks = littleEndian(static_cast<std::uint32_t>(json.size())) + "JSON" + json;
    if (!buffer.empty()) {
        chunks += littleEndian(static_cast<std::uint32_t>(buffer.size())) + std::string("BIN\0", 4) + buffer;
    }
    return "glTF" + littleEndian(2) + littleEndian(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

/// Builder of a file with one buffer, accessor by accessor.
class Draft {
public:
    /// Returns the accessor's index.
    std::size_t add(const std::string& bytes, int component, const std::string& type, std::size_t count,
                    const std::string& more = "")
    {
        buffer_.append((4 - buffer_.size() % 4) % 4, '\0');
        const std::string number = std::to_string(count_);
        views_ += (count_ > 0 ? "," : "") + std::string(R"({"buffer":0,"byteOffset":)") +
                  std::to_string(buffer_.size()) + R"(,"byteLength":)" + std::to_string(bytes.size()) + "}";
        accessors_ += (count_ > 0 ? "," : "") + std::string(R"({"bufferView":)") + number + R"(,"componentType":)" +
                      std::to_string(component) + R"(,"type":")" + type + R"(","count":)" + std::to_string(count) +
                      more + "}";
        buffer_ += bytes;
        return count_++;
    }
    std::size_t addFloats(const std::vector<float>& values, const std::string& type)
    {
        const std::size_t width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
        return add(floats(values), 5126, type, values.size() / width);
    }

    [[nodiscard]] const std::string& buffer() const { return buffer_; }
    /// @param rest  meshes, nodes, scenes
    [[nodiscard]] std::string json(const std::string& rest, const std::string& uri = "") const
    {
        return R"({"asset":{"version":"2.0"},)" + rest + R"(,"accessors":[)" + accessors_ + R"(],"bufferViews":[)" +
               views_ + R"(],"buffers":[{"byteLength":)" + std::to_string(buffer_.size()) +
               (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") + "}]}";
    }
    [[nodiscard]] std::string file(const std::string& rest) const { return glb(json(rest), buffer_); }

private:
    std::string views_;
    std::string accessors_;
    std::string buffer_;
    std::size_t count_ = 0;
};

}  // namespace droplet::testing
