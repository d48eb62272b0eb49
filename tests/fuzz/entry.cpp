// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of libFuzzer; DROPLET_FUZZ_TARGET names a function of targets.h.
#include <cstdint>

#include "fuzz/targets.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    droplet::DROPLET_FUZZ_TARGET(std::as_bytes(std::span(data, size)));
    return 0;
}
