// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string_view>

#include "droplet/error.h"
#include "droplet/io/output.h"
#include "files.h"

namespace cli {
namespace {

std::string beginningOf(const std::string& command)
{
    return "droplet-shape " + command + " checkpoint 2\n";
}

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

std::string checkpointPath(const NumberedPath& frames)
{
    return std::filesystem::path(frames.with("checkpoint")).replace_extension(".state").string();
}

void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint)
{
    std::string bytes = beginningOf(checkpoint.command);
    put(bytes, checkpoint.fingerprint);
    put(bytes, checkpoint.frames);
    put(bytes, checkpoint.rows);
    put(bytes, checkpoint.state);
    put(bytes, checkpoint.planned_frames);
    put(bytes, checkpoint.wet_picture);
    put(bytes, checkpoint.wet_maps);
    droplet::writeAtomically(
        path, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void removeCheckpoint(const std::string& path, const std::string& command, const droplet::OutputOptions& options)
{
    std::error_code failure;
    if (!std::filesystem::exists(path, failure)) {
        return;
    }
    droplet::checkWritable(path, options);
    std::ifstream file(path, std::ios::binary);
    const std::string expected = beginningOf(command);
    std::string beginning(expected.size(), '\0');
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    if (beginning != expected) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed,
                             path + ": is not a checkpoint, and will not be replaced by one; move it away");
    }
    if (!std::filesystem::remove(path, failure)) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed, path + ": " + failure.message());
    }
}

std::optional<Checkpoint> readCheckpoint(const std::string& path, const std::string& command)
{
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        return std::nullopt;
    }
    const std::string bytes = textOf(path);
    const std::string beginning = beginningOf(command);
    Reader reader(bytes, path);
    if (reader.take(std::min(bytes.size(), beginning.size())) != beginning) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput,
                             path + ": is not a checkpoint of droplet-shape " + command + "; move it away");
    }
    Checkpoint checkpoint;
    checkpoint.command = command;
    checkpoint.fingerprint = reader.text();
    checkpoint.frames = reader.number();
    checkpoint.rows = reader.text();
    checkpoint.state = reader.text();
    checkpoint.planned_frames = reader.number();
    checkpoint.wet_picture = reader.text();
    checkpoint.wet_maps = reader.text();
    return checkpoint;
}

}  // namespace cli
