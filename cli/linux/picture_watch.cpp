// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "droplet/error.h"

namespace cli {
namespace {

/// Editors save in steps: they write a new file and rename it, or empty the old one before they write. A program that
/// pauses for longer between steps is answered twice.
constexpr int kSettled = 30;  // [ms]

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& why)
{
    throw droplet::Error(droplet::ErrorCode::InvalidInput, "cannot watch " + folder.string() + ": " + why);
}

}  // namespace

struct PictureWatch::Watched {
    std::filesystem::path path;
    int events = -1;

    /// Reads what happened in the folder.
    /// @return  whether the file was saved
    [[nodiscard]] bool read() const;
};

PictureWatch::PictureWatch(const std::filesystem::path& path)
    : watched_(new Watched{std::filesystem::weakly_canonical(std::filesystem::absolute(path))})
{
    const std::filesystem::path folder = watched_->path.parent_path();
    int& events = watched_->events;
    events = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
    if (events == -1 ||
        inotify_add_watch(events, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF) == -1) {
        const std::string why = std::strerror(errno);
        if (events != -1) {
            close(events);
        }
        refuse(folder, why);
    }
}

PictureWatch::~PictureWatch()
{
    close(watched_->events);
}

void PictureWatch::wait()
{
    pollfd ready{watched_->events, POLLIN, 0};
    for (bool is_saved = false;;) {
        const int count = poll(&ready, 1, is_saved ? kSettled : -1);
        if (count == 0) {
            return;
        }
        if (count == -1 && errno != EINTR) {
            refuse(watched_->path.parent_path(), std::strerror(errno));
        }
        is_saved = (count > 0 && watched_->read()) || is_saved;
    }
}

bool PictureWatch::Watched::read() const
{
    alignas(inotify_event) std::array<char, 4096> buffer;
    bool is_saved = false;
    for (;;) {
        const ssize_t size = ::read(events, buffer.data(), buffer.size());
        if (size <= 0) {
            return is_saved;
        }
        for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            if ((event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED)) != 0) {
                refuse(path.parent_path(), "the folder is gone");
            }
            // A name is padded with zeros; an overflowing queue has lost names.
            is_saved = is_saved || (event.mask & IN_Q_OVERFLOW) != 0 ||
                       (event.len > 0 && path.filename() == buffer.data() + at + sizeof event);
            at += sizeof event + event.len;
        }
    }
}

}  // namespace cli
