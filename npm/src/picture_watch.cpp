// SPDX-License-Identifier: GPL-3.0-or-later
// A picture is watched by asking for its time again and again, as every system can.
#include "picture_watch.h"

#include <system_error>

#include "host.h"

namespace cli {

struct PictureWatch::Watched {
    std::filesystem::path path;
};

PictureWatch::PictureWatch(const std::filesystem::path& path) : watched_(new Watched{std::filesystem::absolute(path)})
{
}

PictureWatch::~PictureWatch() = default;

void PictureWatch::wait()
{
    constexpr double kBetween = 100.0;  // [ms]
    const auto time = [&] {
        std::error_code missing;
        return std::filesystem::last_write_time(watched_->path, missing);
    };
    const auto before = time();
    while (time() == before || time() == decltype(before)::min()) {
        droplet_host_sleep(kBetween);
    }
    // Until it has settled.
    for (auto last = time();; last = time()) {
        droplet_host_sleep(kBetween);
        if (time() == last) {
            return;
        }
    }
}

}  // namespace cli
