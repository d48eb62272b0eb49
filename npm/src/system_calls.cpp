// SPDX-License-Identifier: GPL-3.0-or-later
// System calls that emscripten's C library has no imports for if it stands alone.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

#include "host.h"

extern "C" {

long __syscall_open(const char* path, long flags, ...)
{
    int mode = 0;
    va_list more;
    va_start(more, flags);
    if ((flags & O_CREAT) != 0) {
        mode = va_arg(more, int);
    }
    va_end(more);
    return droplet_host_open(path, static_cast<int>(flags), mode);
}

int renameat2(int, const char* from, int, const char* to, unsigned)
{
    const int result = droplet_host_rename_to_free(from, to);
    errno = result < 0 ? -result : errno;
    return result < 0 ? -1 : 0;
}

/// A hint.
int sync_file_range(int, off_t, off_t, unsigned)
{
    return 0;
}
}
