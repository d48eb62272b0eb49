// SPDX-License-Identifier: GPL-3.0-or-later
// Windows' FindFirstChangeNotificationW. It tells that something in the folder has changed; the file's time tells
// whether it was the file.
#include "picture_watch.h"

#include <windows.h>

#include <string>
#include <system_error>

#include "droplet/error.h"

namespace cli {
namespace {

constexpr DWORD kSettled = 100;  // [ms] editors save in steps; Windows tells of changes late

[[noreturn]] void refuse(const std::filesystem::path& folder, DWORD error)
{
    throw droplet::Error(droplet::ErrorCode::InvalidInput, "cannot watch " + folder.string() + ": " +
                                                               std::system_category().message(static_cast<int>(error)));
}

}  // namespace

struct PictureWatch::Watched {
    std::filesystem::path path;
    HANDLE changes = INVALID_HANDLE_VALUE;
    std::filesystem::file_time_type time = {};

    [[nodiscard]] std::filesystem::file_time_type timeNow() const
    {
        std::error_code missing;
        return std::filesystem::last_write_time(path, missing);  // of a missing file, the least
    }
};

PictureWatch::PictureWatch(const std::filesystem::path& path) : watched_(new Watched{std::filesystem::absolute(path)})
{
    const std::filesystem::path folder = watched_->path.parent_path();
    watched_->changes = ::FindFirstChangeNotificationW(
        folder.c_str(), FALSE, FILE_NOTIFY_CHANGE_FILE_NAME | FILE_NOTIFY_CHANGE_LAST_WRITE | FILE_NOTIFY_CHANGE_SIZE);
    if (watched_->changes == INVALID_HANDLE_VALUE) {
        refuse(folder, ::GetLastError());
    }
    watched_->time = watched_->timeNow();
}

PictureWatch::~PictureWatch()
{
    ::FindCloseChangeNotification(watched_->changes);
}

void PictureWatch::wait()
{
    for (bool is_saved = false;;) {
        const DWORD result = ::WaitForSingleObject(watched_->changes, is_saved ? kSettled : INFINITE);
        if (result == WAIT_TIMEOUT) {
            return;
        }
        if (result != WAIT_OBJECT_0 || ::FindNextChangeNotification(watched_->changes) == FALSE) {
            refuse(watched_->path.parent_path(), ::GetLastError());
        }
        const auto time = watched_->timeNow();
        if (time != watched_->time && time != std::filesystem::file_time_type::min()) {
            watched_->time = time;
            is_saved = true;
        }
    }
}

}  // namespace cli
