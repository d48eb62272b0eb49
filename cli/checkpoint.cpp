// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string_view>
#include <utility>

#include "droplet/error.h"
#include "droplet/io/output.h"
#include "files.h"
#include "option_values.h"

namespace cli {
namespace {

/// Beginning of a checkpoint of any version.
std::string signatureOf(const std::string& command)
{
    return "droplet-shape " + command + " checkpoint ";
}

std::string beginningOf(const std::string& command)
{
    return signatureOf(command) + "3\n";
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

const std::string& Checkpoint::operator[](const std::string& name) const
{
    static const std::string none;
    const auto found = state.find(name);
    return found == state.end() ? none : found->second;
}

bool ResumableRun::hasFrame(std::size_t number) const
{
    std::error_code ignored;
    return std::all_of(files.begin(), files.end(), [&](const NumberedPath& file) {
        return std::filesystem::exists(file.at(first + number - 1), ignored);
    });
}

bool ResumableRun::hasFrames(std::size_t count) const
{
    std::size_t number = 1;
    while (number <= count && hasFrame(number)) {
        ++number;
    }
    return number > count;
}

std::string checkpointPath(const NumberedPath& frames)
{
    return std::filesystem::path(frames.with("checkpoint")).replace_extension(".state").string();
}

CheckpointFile::CheckpointFile(ResumableRun run, const droplet::OutputOptions& treatment)
    : run_(std::move(run)), treatment_(treatment), path_(checkpointPath(run_.files.front()))
{
}

std::optional<Checkpoint> CheckpointFile::begin(bool resume) const
{
    std::error_code ignored;
    if (!resume || !std::filesystem::exists(path_, ignored)) {
        // The checkpoint of another run must not be used for this one.
        removeOther();
        return std::nullopt;
    }
    const std::string bytes = textOf(path_);
    const std::string beginning = beginningOf(run_.command);
    Reader reader(bytes, path_);
    if (reader.take(std::min(bytes.size(), beginning.size())) != beginning) {
        throw droplet::Error(droplet::ErrorCode::InvalidInput,
                             path_ + ": is not a checkpoint of this droplet-shape " + run_.command + "; move it away");
    }
    const std::string_view fingerprint = reader.text();
    Checkpoint checkpoint;
    checkpoint.frames = reader.number();
    for (std::uint64_t left = reader.number(); left > 0; --left) {
        std::string name(reader.text());
        checkpoint.state[std::move(name)] = reader.text();
    }
    if (fingerprint != run_.fingerprint) {
        refuse("--resume: " + path_ + " belongs to a run with other options or files");
    }
    if (checkpoint.frames > run_.frames) {
        refuse("--resume: " + std::to_string(checkpoint.frames) + " frames exist already, but this run has " +
               std::to_string(run_.frames));
    }
    return checkpoint;
}

bool CheckpointFile::isDue(std::size_t frames) const
{
    const auto second = static_cast<std::size_t>(std::max(std::llround(run_.frames_per_second), 1LL));
    return frames % second == 0;
}

void CheckpointFile::write(const Checkpoint& checkpoint) const
{
    std::string bytes = beginningOf(run_.command);
    put(bytes, run_.fingerprint);
    put(bytes, checkpoint.frames);
    put(bytes, checkpoint.state.size());
    for (const auto& [name, part] : checkpoint.state) {
        put(bytes, name);
        put(bytes, part);
    }
    droplet::writeAtomically(
        path_, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void CheckpointFile::end() const
{
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

void CheckpointFile::removeOther() const
{
    std::error_code failure;
    if (!std::filesystem::exists(path_, failure)) {
        return;
    }
    droplet::checkWritable(path_, treatment_);
    std::ifstream file(path_, std::ios::binary);
    const std::string expected = signatureOf(run_.command);
    std::string beginning(expected.size(), '\0');
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    file.close();  // Windows removes no open file
    if (beginning != expected) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed,
                             path_ + ": is not a checkpoint, and will not be replaced by one; move it away");
    }
    if (!std::filesystem::remove(path_, failure)) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed, path_ + ": " + failure.message());
    }
}

}  // namespace cli
