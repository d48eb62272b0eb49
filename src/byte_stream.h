// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {

[[noreturn]] inline void refuseFloat(double value)
{
    throw Error(ErrorCode::InvalidArgument,
                "surface holds " + numberText(value) + ", which must fit into a 32-bit float");
}

/// Nearest float. @throws Error InvalidArgument beyond float's range
inline float toFloat(double value)
{
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        refuseFloat(value);
    }
    return static_cast<float>(value);
}

/// Writer of bytes to a stream through one fixed buffer, so that no whole file is in memory. Numbers are little-endian
/// on every machine. After finish() the stream's state says whether it took everything.
class ByteStream {
public:
    explicit ByteStream(std::ostream& out) : out_(out), buffer_(kCapacity) {}
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;

    template <class... Numbers>
    void u8(Numbers... values)
    {
        put<1>(static_cast<std::uint32_t>(values)...);
    }

    template <class... Numbers>
    void u16(Numbers... values)
    {
        put<2>(static_cast<std::uint32_t>(values)...);
    }

    template <class... Numbers>
    void u32(Numbers... values)
    {
        put<4>(static_cast<std::uint32_t>(values)...);
    }

    template <class... Numbers>
    void f32(Numbers... values)
    {
        put<4>(std::bit_cast<std::uint32_t>(toFloat(values))...);
    }

    void text(std::string_view text)
    {
        while (!text.empty()) {
            const std::string_view part = text.substr(0, kCapacity);
            std::memcpy(room(part.size()), part.data(), part.size());
            used_ += part.size();
            text.remove_prefix(part.size());
        }
    }

    /// Writes a number as text in any locale; `format` is as in std::to_chars.
    template <class Number, class... Format>
    void digits(Number value, Format... format)
    {
        char* const begin = room(kLongestNumber);
        used_ += static_cast<std::size_t>(std::to_chars(begin, begin + kLongestNumber, value, format...).ptr - begin);
    }

    /// @return bytes handed over in all
    std::uint64_t finish()
    {
        writeOut();
        out_.flush();
        return count_;
    }

private:
    // A larger buffer is not faster; 64 KiB fit into the processor's second cache.
    static constexpr std::size_t kCapacity = std::size_t{1} << 16;
    static constexpr std::size_t kLongestNumber = 32;  // sign, digits, point, exponent of three digits

    template <std::size_t Bytes, class... Numbers>
    void put(Numbers... values)
    {
        char* at = room(Bytes * sizeof...(values));
        const auto store = [&](std::uint32_t value) {
            for (std::size_t i = 0; i < Bytes; ++i) {  // compilers merge this into one store
                at[i] = static_cast<char>(value >> (8 * i));
            }
            at += Bytes;
        };
        (store(values), ...);
        used_ += Bytes * sizeof...(values);
    }

    /// Place for some bytes, at most kCapacity. The caller increases used_.
    char* room(std::size_t bytes)
    {
        if (bytes > kCapacity - used_) {
            writeOut();
        }
        return buffer_.data() + used_;
    }

    void writeOut()
    {
        out_.write(buffer_.data(), static_cast<std::streamsize>(used_));
        count_ += used_;
        used_ = 0;
    }

    std::ostream& out_;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
    std::uint64_t count_ = 0;
};

}  // namespace droplet
