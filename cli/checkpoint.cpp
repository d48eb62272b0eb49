// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string_view>
#include <type_traits>

#include "droplet/error.h"
#include "droplet/io/output.h"
#include "droplet/windshield/state_bytes.h"
#include "files.h"

namespace cli {
namespace {

constexpr std::string_view kBeginning = "droplet-shape windshield checkpoint 1\n";
static_assert(std::is_trivially_copyable_v<droplet::BalanceRow>,
              "rows are written as bytes and read by the same program");

void put(std::string& bytes, std::uint64_t number)
{
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string& bytes, std::string_view text)
{
    put(bytes, text.size());
    bytes.append(text);
}

/// Reads a checkpoint's bytes from front to back.
class Reader {
public:
    Reader(std::string_view bytes, const std::string& path) : left_(bytes), path_(path) {}

    std::string_view take(std::size_t count)
    {
        if (count > left_.size()) {
            throw droplet::Error(droplet::ErrorCode::InvalidInput,
                                 path_ + ": is not a complete checkpoint; remove it to start from the first frame");
        }
        const std::string_view part = left_.substr(0, count);
        left_.remove_prefix(count);
        return part;
    }

    std::uint64_t number()
    {
        std::uint64_t value = 0;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }

    std::string_view text() { return take(number()); }

private:
    std::string_view left_;
    const std::string& path_;
};

}  // namespace

void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint)
{
    std::string bytes(kBeginning);
    put(bytes, checkpoint.fingerprint);
    put(bytes, checkpoint.frames);
    put(bytes, checkpoint.balance.size());
    bytes.append(reinterpret_cast<const char*>(checkpoint.balance.data()),
                 checkpoint.balance.size() * sizeof(droplet::BalanceRow));
    put(bytes, bytesOf(checkpoint.state));
    droplet::writeAtomically(
        path, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void removeCheckpoint(const std::string& path, const droplet::OutputOptions& options)
{
    std::error_code failure;
    if (!std::filesystem::exists(path, failure)) {
        return;
    }
    droplet::checkWritable(path, options);
    std::ifstream file(path, std::ios::binary);
    std::string beginning(kBeginning.size(), '\0');
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    if (beginning != kBeginning) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed,
                             path + ": is not a checkpoint, and will not be replaced by one; move it away");
    }
    if (!std::filesystem::remove(path, failure)) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed, path + ": " + failure.message());
    }
}

std::optional<Checkpoint> readCheckpoint(const std::string& path)
{
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        return std::nullopt;
    }
    const std::string bytes = textOf(path);
    Reader reader(bytes, path);
    if (reader.take(std::min(bytes.size(), kBeginning.size())) != kBeginning) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput,
                             path + ": is not a checkpoint of droplet-shape; move it away");
    }
    Checkpoint checkpoint;
    checkpoint.fingerprint = reader.text();
    checkpoint.frames = reader.number();
    const std::uint64_t rows = reader.number();
    if (rows > bytes.size() / sizeof(droplet::BalanceRow)) {
        reader.take(bytes.size() + 1);
    }
    const std::string_view balance = reader.take(rows * sizeof(droplet::BalanceRow));
    checkpoint.balance.resize(rows);
    if (rows > 0) {
        std::memcpy(checkpoint.balance.data(), balance.data(), balance.size());
    }
    checkpoint.state = droplet::stateFromBytes(reader.text(), path);
    return checkpoint;
}

}  // namespace cli
