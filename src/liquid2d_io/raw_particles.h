// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

inline constexpr std::size_t kMaxParticles = 20'000'000;

/// Particles as they stand in a file. Arrays other than `position` may be empty.
struct RawParticles {
    std::vector<Vec3> position;
    std::vector<Vec3> velocity;
    std::vector<double> id;
    std::vector<double> density;
    std::optional<double> time;
};

/// Readers of a file's bytes.
/// @throws Damage  for files that are cut off or do not follow the format
RawParticles readVtkLegacy(std::string_view bytes);
RawParticles readVtkXml(std::string_view bytes);
RawParticles readBgeo(std::string_view bytes);
/// @throws Error InvalidInput, with the name
RawParticles readCsvParticles(std::string_view bytes, const std::string& name);

/// What an array of numbers tells of the particles.
enum class ParticleRole { None, Position, Velocity, Id, Density };

/// Role of an array by its name, in any case of letters.
ParticleRole roleOf(std::string_view name, std::size_t components);

/// Whether particles lack the array of a role from particle `begin` on.
bool lacks(const RawParticles& particles, ParticleRole role, std::size_t begin);

/// Appends an array to that of a role. Vectors of two components get z = 0.
void append(RawParticles& particles, ParticleRole role, std::size_t components, const std::vector<double>& numbers);

/// Type of numbers in a file.
enum class NumberType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

/// Bytes of a number.
std::size_t sizeOf(NumberType type);

/// Numbers from the begin of some bytes, which must be long enough.
std::vector<double> numbersIn(std::string_view bytes, NumberType type, std::size_t count, std::endian order);

/// Unsigned number of `bytes.size()` bytes.
std::uint64_t unsignedIn(std::string_view bytes, std::endian order);

/// Takes the next word off a text, or an empty one at its end.
std::string_view takeWord(std::string_view& text);

/// Takes numbers in decimal off a text. @throws Damage if there are fewer
std::vector<double> takeNumbers(std::string_view& text, std::size_t count);

/// Count of something from its word, up to `max`. @throws Damage
std::size_t countIn(std::string_view word, std::string_view what, std::size_t max = kMaxParticles);

/// Text in small letters.
std::string lowerCase(std::string_view text);

/// Text in quotes for a message, cut to some length.
std::string quotedShort(std::string_view text);

}  // namespace droplet
