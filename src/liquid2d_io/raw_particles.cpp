// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d_io/raw_particles.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "file_bytes.h"

namespace droplet {
namespace {

constexpr std::string_view kBlank = " \t\r\n\v\f";

}  // namespace

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

std::string quotedShort(std::string_view text)
{
    return fmt::format("'{}'", text.substr(0, 40));
}

ParticleRole roleOf(std::string_view name, std::size_t components)
{
    const std::string lower = lowerCase(name);
    const auto is_one_of = [&lower](std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), lower) != names.end();
    };
    if ((components == 2 || components == 3) && is_one_of({"velocity", "velocities", "vel", "v"})) {
        return ParticleRole::Velocity;
    }
    if (components == 1 && is_one_of({"id", "ids", "particle_id", "particleid"})) {
        return ParticleRole::Id;
    }
    if (components == 1 && is_one_of({"density", "rho"})) {
        return ParticleRole::Density;
    }
    return ParticleRole::None;
}

bool lacks(const RawParticles& particles, ParticleRole role, std::size_t begin)
{
    switch (role) {
        case ParticleRole::None:
            return false;
        case ParticleRole::Position:
            return particles.position.size() == begin;
        case ParticleRole::Velocity:
            return particles.velocity.size() == begin;
        case ParticleRole::Id:
            return particles.id.size() == begin;
        case ParticleRole::Density:
            return particles.density.size() == begin;
    }
    return false;
}

void append(RawParticles& particles, ParticleRole role, std::size_t components, const std::vector<double>& numbers)
{
    if (role == ParticleRole::Id || role == ParticleRole::Density) {
        std::vector<double>& to = role == ParticleRole::Id ? particles.id : particles.density;
        to.insert(to.end(), numbers.begin(), numbers.end());
        return;
    }
    std::vector<Vec3>& to = role == ParticleRole::Position ? particles.position : particles.velocity;
    for (std::size_t i = 0; i + components <= numbers.size(); i += components) {
        to.push_back({numbers[i], numbers[i + 1], components > 2 ? numbers[i + 2] : 0.0});
    }
}

std::size_t sizeOf(NumberType type)
{
    switch (type) {
        case NumberType::Int8:
        case NumberType::UInt8:
            return 1;
        case NumberType::Int16:
        case NumberType::UInt16:
            return 2;
        case NumberType::Int32:
        case NumberType::UInt32:
        case NumberType::Float32:
            return 4;
        case NumberType::Int64:
        case NumberType::UInt64:
        case NumberType::Float64:
            return 8;
    }
    return 8;
}

std::uint64_t unsignedIn(std::string_view bytes, std::endian order)
{
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        const std::size_t at = order == std::endian::big ? k : bytes.size() - 1 - k;
        value = value << 8U | static_cast<unsigned char>(bytes[at]);
    }
    return value;
}

std::vector<double> numbersIn(std::string_view bytes, NumberType type, std::size_t count, std::endian order)
{
    const std::size_t size = sizeOf(type);
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t bits = unsignedIn(bytes.substr(i * size, size), order);
        switch (type) {
            case NumberType::Int8:
                numbers[i] = static_cast<std::int8_t>(bits);
                break;
            case NumberType::Int16:
                numbers[i] = static_cast<std::int16_t>(bits);
                break;
            case NumberType::Int32:
                numbers[i] = static_cast<std::int32_t>(bits);
                break;
            case NumberType::Int64:
                numbers[i] = static_cast<double>(static_cast<std::int64_t>(bits));
                break;
            case NumberType::Float32:
                numbers[i] = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
                break;
            case NumberType::Float64:
                numbers[i] = std::bit_cast<double>(bits);
                break;
            case NumberType::UInt8:
            case NumberType::UInt16:
            case NumberType::UInt32:
            case NumberType::UInt64:
                numbers[i] = static_cast<double>(bits);
                break;
        }
    }
    return numbers;
}

std::string_view takeWord(std::string_view& text)
{
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(kBlank));
    text.remove_prefix(word.size());
    return word;
}

std::vector<double> takeNumbers(std::string_view& text, std::size_t count)
{
    if (count > text.size() / 2 + 1) {  // a digit and a blank each
        throw Damage("it is cut off");
    }
    std::vector<double> numbers(count);
    for (double& number : numbers) {
        const std::string_view word = takeWord(text);
        if (word.empty()) {
            throw Damage("it is cut off");
        }
        const char* end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data() + (word[0] == '+' ? 1 : 0), end, number);
        if (error != std::errc() || stop != end) {
            throw Damage(quotedShort(word) + " stands in place of a number");
        }
    }
    return numbers;
}

std::size_t countIn(std::string_view word, std::string_view what, std::size_t max)
{
    std::uint64_t value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc::result_out_of_range || (error == std::errc() && stop == end && value > max)) {
        throw Damage(fmt::format("the number of {} is {}, which is more than {}", what, word.substr(0, 40), max));
    }
    if (word.empty() || error != std::errc() || stop != end) {
        throw Damage(fmt::format("the number of {} is {}", what, quotedShort(word)));
    }
    return static_cast<std::size_t>(value);
}

}  // namespace droplet
