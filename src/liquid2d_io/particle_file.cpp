// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/particle_file.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "file_bytes.h"
#include "liquid2d/near_points.h"
#include "liquid2d_io/raw_particles.h"
#include "require.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 31U;

double along(const Vec3& a, char axis)
{
    return axis == 'x' ? a.x : axis == 'y' ? a.y : a.z;
}

std::string unzipped(std::string_view bytes)
{
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 16) != Z_OK) {
        throw Damage("it does not unpack");
    }
    std::string all;
    std::string chunk(std::size_t{1} << 16U, '\0');
    int state = Z_OK;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    while (state == Z_OK && all.size() < kMaxBytes) {
        stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
        stream.avail_out = static_cast<uInt>(chunk.size());
        state = inflate(&stream, Z_NO_FLUSH);
        all.append(chunk, 0, chunk.size() - stream.avail_out);
    }
    inflateEnd(&stream);
    if (state != Z_STREAM_END) {
        throw Damage("it does not unpack as gzip, or is cut off");
    }
    return all;
}

RawParticles rawParticles(std::string_view bytes, const std::string& name)
{
    if (bytes.empty()) {
        throw Damage("it is empty");
    }
    if (bytes.starts_with("# vtk DataFile")) {
        return readVtkLegacy(bytes);
    }
    if (bytes.starts_with("Bgeo")) {
        return readBgeo(bytes);
    }
    if (bytes.starts_with("\x7fNSJ") || bytes.starts_with("[\n\t\"fileversion\"")) {
        throw Damage("it is a geometry of Houdini 12 or later; save it as classic BGEO (.bhclassic), VTK or CSV");
    }
    if (bytes.substr(0, bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n") + 1).ends_with('<')) {
        return readVtkXml(bytes);
    }
    if (bytes.substr(0, 4096).find('\0') != std::string_view::npos) {
        throw Damage("it is not CSV, VTK, VTP or classic BGEO");
    }
    return readCsvParticles(bytes, name);
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Median distance of nearest neighbours of up to 10 000 particles.
double estimatedSpacing(const std::vector<Vec2>& points)
{
    constexpr std::size_t kAsked = 10000;
    const NearPoints near(points);
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); i += points.size() / kAsked + 1) {
        const auto found = near.nearest(points[i], 2);  // the first is the point itself
        if (found.size() == 2 && found[1].squared > 0.0) {
            distances.push_back(std::sqrt(found[1].squared));
        }
    }
    if (distances.empty()) {
        throw Damage("it needs two particles at different places to tell their spacing; give the spacing");
    }
    return median(std::move(distances));
}

template <class Values>
void requireCount(const char* what, const Values& values, std::size_t count)
{
    if (!values.empty() && values.size() != count) {
        throw Damage(fmt::format("{} has {} values for {} particles", what, values.size(), count));
    }
}

void requireFinite(const char* what, std::size_t particle, double value)
{
    if (!std::isfinite(value)) {
        throw Damage(fmt::format("the {} of particle {} is not finite", what, particle + 1));
    }
}

ParticleFile taken(const RawParticles& raw, const ParticleFileOptions& options)
{
    const std::size_t count = raw.position.size();
    requireCount("velocity", raw.velocity, count);
    requireCount("id", raw.id, count);
    requireCount("density", raw.density, count);
    ParticleFile file;
    file.has_velocity = !raw.velocity.empty();
    file.has_id = !raw.id.empty();
    if (raw.time && std::isfinite(*raw.time)) {
        file.time = raw.time;
    }
    ParticleFrame& frame = file.frame;
    frame.time = file.time.value_or(0.0);
    const auto flat = [&](const char* what, std::size_t i, const Vec3& a) {
        const Vec2 result{options.scale * along(a, options.plane[0]), options.scale * along(a, options.plane[1])};
        requireFinite(what, i, result.x);
        requireFinite(what, i, result.y);
        return result;
    };
    for (std::size_t i = 0; i < count; ++i) {
        frame.position.push_back(flat("position", i, raw.position[i]));
        frame.velocity.push_back(file.has_velocity ? flat("velocity", i, raw.velocity[i]) : Vec2{});
        const double id = file.has_id ? raw.id[i] : static_cast<double>(i);
        if (!(id >= 0.0 && id <= 4294967295.0) || id != std::floor(id)) {
            throw Damage(fmt::format("the id of particle {} is {}, must be a whole number from 0 to 4294967295", i + 1,
                                     numberText(id)));
        }
        frame.id.push_back(static_cast<std::uint32_t>(id));
        if (!raw.density.empty()) {
            requireFinite("density", i, raw.density[i]);
        }
    }
    if (!raw.density.empty()) {
        const double rest = options.rest_density ? *options.rest_density : median(raw.density);
        for (std::size_t i = 0; i < count && rest > 0.0; ++i) {
            frame.density.push_back(raw.density[i] / rest);
        }
    }
    file.spacing_estimated = !options.spacing;
    frame.spacing = options.spacing ? *options.spacing : estimatedSpacing(frame.position);
    try {
        frame.validate();
    } catch (const Error& error) {
        throw Damage(error.what());
    }
    return file;
}

}  // namespace

void ParticleFileOptions::validate() const
{
    const auto positive = [](const char* field, double value, const char* constraint) {
        require(std::isfinite(value) && value > 0.0, field, value, constraint);
    };
    positive("spacing", spacing.value_or(1.0), "finite and more than 0 m");
    positive("scale", scale, "finite and more than 0 m");
    positive("rest_density", rest_density.value_or(1.0), "finite and more than 0");
    require(plane.size() == 2 && plane[0] != plane[1] && plane.find_first_not_of("xyz") == std::string::npos, "plane",
            plane, "two different letters of x, y and z");
}

ParticleFile parseParticles(std::string_view bytes, const std::string& name, const ParticleFileOptions& options)
{
    options.validate();
    ParticleFile file;
    readFile(name, [&] {
        const bool zipped = bytes.starts_with("\x1f\x8b");
        const std::string plain = zipped ? unzipped(bytes) : std::string{};
        file = taken(rawParticles(zipped ? plain : bytes, name), options);
    });
    return file;
}

ParticleFile readParticles(const std::filesystem::path& path, const ParticleFileOptions& options)
{
    Bytes bytes;
    readFile(path, [&] {
        bytes = readBytes(path, kMaxBytes, [](std::byte) { return true; });
        if (bytes.size() == kMaxBytes) {
            throw Damage("it is longer than 2 GiB");
        }
    });
    return parseParticles({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, shown(path), options);
}

ParticleFrame fillVelocities(const ParticleFrame& previous, ParticleFrame frame)
{
    const double step = frame.time - previous.time;
    require(step > 0.0, "frame.time", frame.time, "later than that of the previous frame");
    std::vector<std::size_t> order(previous.id.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return previous.id[a] < previous.id[b]; });
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
        const auto found = std::lower_bound(order.begin(), order.end(), frame.id[i],
                                            [&](std::size_t a, std::uint32_t id) { return previous.id[a] < id; });
        if (found != order.end() && previous.id[*found] == frame.id[i]) {
            frame.velocity[i] = 1.0 / step * (frame.position[i] - previous.position[*found]);
        }
    }
    return frame;
}

}  // namespace droplet
