// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>

namespace droplet::torture {

/// Random numbers that are the same on every platform: the standard fixes engines but not distributions.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [0, 1).
    double real() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

    /// Uniform in [0, count), except for a bias of count/2⁵³.
    int below(int count) { return static_cast<int>(real() * count); }

private:
    std::mt19937_64 engine_;
};

}  // namespace droplet::torture
