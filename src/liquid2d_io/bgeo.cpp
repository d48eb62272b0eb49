// SPDX-License-Identifier: GPL-3.0-or-later
// Classic Houdini geometry, binary, version 5: Houdini 11 reference, "bgeo file format". Numbers are big-endian.
#include <fmt/core.h>

#include <algorithm>

#include "file_bytes.h"
#include "liquid2d_io/raw_particles.h"

namespace droplet {
namespace {

struct Attribute {
    ParticleRole role = ParticleRole::None;
    NumberType type = NumberType::Float32;
    std::size_t components = 0;
    std::size_t offset = 0;  ///< in a point [B]
};

class Bgeo {
public:
    explicit Bgeo(std::string_view bytes) : rest_(bytes) {}

    RawParticles read()
    {
        take(4);
        if (take(1) != "V") {
            throw Damage("it is no binary geometry of version 5");
        }
        if (const std::uint64_t version = number(4); version != 5) {
            throw Damage(fmt::format("it is a geometry of version {}, must be 5", version));
        }
        const std::uint64_t points = number(4);
        take(std::size_t{3} * 4);  // primitives, groups of points and of primitives
        const std::uint64_t attributes = number(4);
        take(std::size_t{3} * 4);  // attributes of vertices, primitives and the whole
        if (points > kMaxParticles) {
            throw Damage(fmt::format("the number of particles is {}, which is more than {}", points, kMaxParticles));
        }
        std::size_t size = 16;  // x, y, z, w
        std::vector<Attribute> wanted;
        for (std::uint64_t k = 0; k < attributes; ++k) {
            const Attribute attribute = definition(size);
            size += 4 * attribute.components;
            wanted.push_back(attribute);
        }
        return values(static_cast<std::size_t>(points), size, wanted);
    }

private:
    std::string_view take(std::size_t count)
    {
        if (count > rest_.size()) {
            throw Damage("it is cut off");
        }
        const std::string_view bytes = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return bytes;
    }

    std::uint64_t number(std::size_t bytes) { return unsignedIn(take(bytes), std::endian::big); }

    Attribute definition(std::size_t offset)
    {
        const std::string_view name = take(static_cast<std::size_t>(number(2)));
        Attribute attribute;
        attribute.offset = offset;
        attribute.components = static_cast<std::size_t>(number(2));
        const std::uint64_t type = number(4);
        if (type == 4) {  // index of a string; the strings follow
            for (std::uint64_t left = number(4); left > 0; --left) {
                take(static_cast<std::size_t>(number(2)));
            }
            return attribute;
        }
        if (type != 0 && type != 1 && type != 5) {
            throw Damage(fmt::format("attribute {} has the unknown type {}", quotedShort(name), type));
        }
        take(4 * attribute.components);  // default values
        attribute.type = type == 1 ? NumberType::Int32 : NumberType::Float32;
        attribute.role = roleOf(name, attribute.components);
        return attribute;
    }

    RawParticles values(std::size_t points, std::size_t size, const std::vector<Attribute>& attributes)
    {
        if (points > rest_.size() / size) {
            throw Damage(fmt::format("it is cut off: {} particles need {} bytes each", points, size));
        }
        RawParticles particles;
        particles.position.reserve(points);
        std::vector<Attribute> wanted;
        for (const Attribute& attribute : attributes) {
            const auto is_same = [&](const Attribute& other) { return other.role == attribute.role; };
            if (attribute.role != ParticleRole::None && std::none_of(wanted.begin(), wanted.end(), is_same)) {
                wanted.push_back(attribute);
            }
        }
        for (std::size_t i = 0; i < points; ++i) {
            const std::string_view point = take(size);
            append(particles, ParticleRole::Position, 3, numbersIn(point, NumberType::Float32, 3, std::endian::big));
            for (const Attribute& a : wanted) {
                append(particles, a.role, a.components,
                       numbersIn(point.substr(a.offset), a.type, a.components, std::endian::big));
            }
        }
        return particles;
    }

    std::string_view rest_;
};

}  // namespace

RawParticles readBgeo(std::string_view bytes)
{
    return Bgeo(bytes).read();
}

}  // namespace droplet
