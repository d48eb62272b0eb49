// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/version.h"
#include "guarded.h"

namespace binding {

std::string& lastMessage()
{
    thread_local std::string message;
    return message;
}

}  // namespace binding

const char* droplet_message()
{
    return binding::lastMessage().c_str();
}

const char* droplet_version()
{
    return droplet::kVersion;
}
