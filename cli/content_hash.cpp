// SPDX-License-Identifier: GPL-3.0-or-later
//
// SHA-256 (FIPS 180-4) from libmd.
#include "content_hash.h"

#include <sha256.h>

#include <array>
#include <cstdint>

#include "files.h"

namespace cli {
namespace {

class Hash {
public:
    Hash() { SHA256Init(&state_); }

    void add(std::span<const std::byte> bytes)
    {
        SHA256Update(&state_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }

    std::string hexadecimal()
    {
        std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
        SHA256End(&state_, text.data());
        return text.data();
    }

private:
    SHA2_CTX state_{};
};

}  // namespace

std::string hashOf(std::span<const std::byte> bytes)
{
    Hash hash;
    hash.add(bytes);
    return hash.hexadecimal();
}

std::string hashOfFile(const std::optional<std::string>& path)
{
    if (!path) {
        return {};
    }
    Hash hash;
    readFile(*path, [&](std::span<const std::byte> part) { hash.add(part); });
    return hash.hexadecimal();
}

std::string fingerprintOf(const std::vector<std::string>& parts)
{
    Hash hash;
    for (const std::string& part : parts) {
        const std::string length = std::to_string(part.size()) + ":";
        hash.add(std::as_bytes(std::span(length)));
        hash.add(std::as_bytes(std::span(part)));
    }
    return hash.hexadecimal();
}

}  // namespace cli
