// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "droplet/error.h"
#include "droplet/printable.h"

namespace droplet {

std::string shown(const std::filesystem::path& path)
{
    return printable(path.string());
}

Bytes readBytes(const std::filesystem::path& path, std::uint64_t max, const std::function<bool(const Bytes&)>& expected)
{
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.string().c_str(), "rb"));
    if (!file) {
        throw Damage(std::generic_category().message(errno));
    }
    Bytes bytes;
    Bytes chunk(std::size_t{1} << 16);
    while (bytes.size() < max) {
        errno = 0;
        const std::size_t count =
            std::fread(chunk.data(), 1, std::min<std::uint64_t>(chunk.size(), max - bytes.size()), file.get());
        const int error = errno;
        bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
        if (std::ferror(file.get()) != 0) {
            throw Damage(std::generic_category().message(error));
        }
        if (count == 0 || !expected(bytes)) {
            break;
        }
        std::error_code no_size;  // a pipe has no size
        if (const auto size = std::filesystem::file_size(path, no_size); !no_size) {
            bytes.reserve(static_cast<std::size_t>(std::min<std::uintmax_t>(size, max)));
        }
    }
    return bytes;
}

Bytes readBytes(const std::filesystem::path& path, std::uint64_t max, const std::function<bool(std::byte)>& expected)
{
    return readBytes(path, max, [&](const Bytes& begun) { return expected(begun.front()); });
}

void readFile(const std::filesystem::path& path, const std::function<void()>& read)
{
    const auto refuse = [&path](const std::string& why) {
        throw Error(ErrorCode::InvalidInput, "cannot use " + shown(path) + ": " + printable(why));
    };
    try {
        read();
    } catch (const Damage& damage) {
        refuse(damage.what());
    } catch (const nlohmann::json::exception&) {
        refuse("its JSON does not follow the specification");
    } catch (const std::bad_alloc&) {
        refuse("it needs more memory than there is");
    } catch (const std::length_error&) {
        refuse("it needs more memory than there is");
    }
}

}  // namespace droplet
