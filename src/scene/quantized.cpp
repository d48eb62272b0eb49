// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "KHR_mesh_quantization" and "EXT_meshopt_compression", appendix A, "Filters".
#include "scene/quantized.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "axes.h"
#include "byte_stream.h"
#include "entry_named.h"

namespace droplet {
namespace {

constexpr std::array<std::pair<Compression, const char*>, 3> kNames = {{
    {Compression::None, "none"},
    {Compression::Quantize, "quantize"},
    {Compression::Meshopt, "meshopt"},
}};

constexpr double kSteps = 65535.0;
constexpr double kOne = 32767.0;

// With more bits, files are larger by a byte for each vertex, and the error is below what pictures show. With fewer,
// reflections show steps.
constexpr int kOctahedralBits = 12;

Vec3 inFloats(Vec3 vector)
{
    const Vec3 up = yUp(vector);
    return {toFloat(up.x), toFloat(up.y), toFloat(up.z)};
}

std::vector<Vec3> inFloats(const std::vector<Vec3>& vectors)
{
    std::vector<Vec3> floats(vectors.size());
    std::transform(vectors.begin(), vectors.end(), floats.begin(), [](Vec3 v) { return inFloats(v); });
    return floats;
}

/// Vector that a reader finds.
Vec3 vectorOf(const QuantizedVector& quantized)
{
    return (1.0 / kOne) * Vec3{static_cast<double>(quantized[0]), static_cast<double>(quantized[1]),
                               static_cast<double>(quantized[2])};
}

double angle(Vec3 a, Vec3 b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

QuantizedPosition QuantizationCube::quantized(Vec3 position) const
{
    const auto step = [this](double from, double value) {
        return static_cast<std::uint16_t>(std::clamp(std::round((value - from) / side * kSteps), 0.0, kSteps));
    };
    return {step(low.x, position.x), step(low.y, position.y), step(low.z, position.z), 0};
}

QuantizedVector QuantizationCube::quantizedChange(Vec3 change) const
{
    return droplet::quantized((1.0 / side) * change);
}

Vec3 QuantizationCube::place(const QuantizedPosition& quantized) const
{
    const double step = side / kSteps;
    return low + step * Vec3{static_cast<double>(quantized[0]), static_cast<double>(quantized[1]),
                             static_cast<double>(quantized[2])};
}

Vec3 QuantizationCube::change(const QuantizedVector& quantized) const
{
    return side * vectorOf(quantized);
}

QuantizationCube cubeAround(std::span<const Vec3> vertices, double longest)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};
    for (const Vec3& p : vertices) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z, longest});
    return {low, side > 0.0 ? side : 1.0};
}

QuantizedVector quantized(Vec3 vector)
{
    const auto lane = [](double value) {
        return static_cast<std::int16_t>(std::round(kOne * std::clamp(value, -1.0, 1.0)));
    };
    return {lane(vector.x), lane(vector.y), lane(vector.z), 0};
}

QuantizedNormals quantizeNormals(std::span<const Vec3> normals, Compression compression)
{
    QuantizedNormals quantized;
    if (compression == Compression::Meshopt) {
        std::vector<float> floats;
        floats.reserve(4 * normals.size());
        for (const Vec3& n : normals) {
            floats.insert(floats.end(), {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z), 0});
        }
        quantized.stored.resize(normals.size());
        meshopt_encodeFilterOct(quantized.stored.data(), normals.size(), sizeof(QuantizedVector), kOctahedralBits,
                                floats.data());
        quantized.read = quantized.stored;
        meshopt_decodeFilterOct(quantized.read.data(), normals.size(), sizeof(QuantizedVector));
        return quantized;
    }
    quantized.stored.resize(normals.size());
    std::transform(normals.begin(), normals.end(), quantized.stored.begin(),
                   [](Vec3 normal) { return droplet::quantized(normal); });
    quantized.read = quantized.stored;
    return quantized;
}

Compression compressionNamed(std::string_view wanted)
{
    return valueNamed(kNames, wanted, "compression");
}

const char* name(Compression compression)
{
    return nameOf(kNames, compression, "compression");
}

CompressionError compressionError(const Surface& surface, Compression compression, std::span<const Vec3> beside)
{
    CompressionError error;
    const std::vector<Vec3> vertices = inFloats(surface.vertices);
    if (compression == Compression::None || vertices.empty()) {
        return error;
    }
    const std::vector<RefillState> none;
    const std::vector<RefillState>& states = surface.refill ? surface.refill->states : none;
    double longest = 0.0;
    for (const RefillState& state : states) {
        for (const Vec3& change : state.vertices) {
            longest = std::max({longest, std::abs(change.x), std::abs(change.y), std::abs(change.z)});
        }
    }
    std::vector<Vec3> all = inFloats({beside.begin(), beside.end()});
    all.insert(all.end(), vertices.begin(), vertices.end());
    const QuantizationCube cube = cubeAround(all, longest);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3 off = cube.place(cube.quantized(vertices[i])) - yUp(surface.vertices[i]);
        error.position = std::max(error.position, length(off));
        for (const RefillState& state : states) {
            const Vec3 change = yUp(state.vertices[i]);
            error.position = std::max(error.position, length(off + cube.change(cube.quantizedChange(change)) - change));
        }
    }
    const QuantizedNormals normals = quantizeNormals(inFloats(surface.normals), compression);
    for (std::size_t i = 0; i < surface.normals.size(); ++i) {
        error.normal = std::max(error.normal, angle(vectorOf(normals.read[i]), yUp(surface.normals[i])));
    }
    return error;
}

}  // namespace droplet
