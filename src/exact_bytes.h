// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "droplet/compensated_sum.h"
#include "droplet/error.h"
#include "droplet/vector.h"

namespace droplet {

/// Writes a state exactly: after its head every value has 8 bytes, lowest byte first; reals are IEEE 754 bits.
class ExactWriter {
public:
    /// @param head  first line, with its end
    explicit ExactWriter(std::string_view head) : bytes_(head) {}

    void put(std::uint64_t value)
    {
        for (int k = 0; k < 8; ++k) {
            bytes_ += static_cast<char>((value >> (8 * k)) & 0xFFU);
        }
    }
    void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void put(Vec2 value)
    {
        put(value.x);
        put(value.y);
    }
    void put(Vec3 value)
    {
        put(value.x);
        put(value.y);
        put(value.z);
    }
    void put(const CompensatedSum& value)
    {
        put(value.sum);
        put(value.carry);
    }
    template <class... Values>
    void all(const Values&... values)
    {
        (put(values), ...);
    }

    [[nodiscard]] std::string&& release() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Reads what ExactWriter wrote.
class ExactReader {
public:
    /// @param name    of the source, for messages; must outlive this
    /// @throws Error  InvalidInput, as all functions do, for bytes that are damaged
    ExactReader(std::string_view bytes, std::string_view head, const std::string& name) : bytes_(bytes), name_(name)
    {
        if (bytes_.substr(0, head.size()) != head) {
            refuse("is not a state of this program's version");
        }
        bytes_.remove_prefix(head.size());
    }

    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Error(ErrorCode::InvalidInput, name_ + " " + what);
    }
    void require(bool holds) const
    {
        if (!holds) {
            refuse("is damaged: a value is out of its range");
        }
    }

    void get(std::uint64_t& value)
    {
        if (bytes_.size() < 8) {
            refuse("is cut off");
        }
        value = 0;
        for (int k = 7; k >= 0; --k) {
            value = value << 8U | static_cast<unsigned char>(bytes_[static_cast<std::size_t>(k)]);
        }
        bytes_.remove_prefix(8);
    }
    void get(double& value)
    {
        std::uint64_t bits = 0;
        get(bits);
        value = std::bit_cast<double>(bits);
        require(std::isfinite(value));
    }
    void get(Vec2& value)
    {
        get(value.x);
        get(value.y);
    }
    void get(Vec3& value)
    {
        get(value.x);
        get(value.y);
        get(value.z);
    }
    void get(CompensatedSum& value)
    {
        get(value.sum);
        get(value.carry);
    }
    template <class... Values>
    void all(Values&... values)
    {
        (get(values), ...);
    }

    /// Length of the list that follows, checked against the remaining bytes.
    std::size_t count(std::size_t bytes_each)
    {
        std::uint64_t value = 0;
        get(value);
        if (value > bytes_.size() / bytes_each) {
            refuse("is cut off");
        }
        return static_cast<std::size_t>(value);
    }
    [[nodiscard]] bool ended() const { return bytes_.empty(); }

private:
    std::string_view bytes_;
    const std::string& name_;
};

}  // namespace droplet
