// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>
#include <string>

#include "droplet/c/droplet.h"
#include "droplet/error.h"

namespace binding {

/// What droplet_message() gives: C has no exceptions, so that each thread keeps the text of its last error.
std::string& lastMessage();

inline DropletCode codeOf(droplet::ErrorCode code)
{
    switch (code) {
        case droplet::ErrorCode::InvalidArgument:
            return DROPLET_INVALID_ARGUMENT;
        case droplet::ErrorCode::InvalidInput:
            return DROPLET_INVALID_INPUT;
        case droplet::ErrorCode::OutputFailed:
            return DROPLET_OUTPUT_FAILED;
        case droplet::ErrorCode::NoSuchDroplet:
            break;
    }
    return DROPLET_NO_SUCH_DROPLET;
}

/// Calls a function, and turns what it throws into a code and a message.
template <typename Function>
DropletCode guarded(const Function& function) noexcept
{
    try {
        try {
            function();
            return DROPLET_OK;
        } catch (const droplet::Error& error) {
            lastMessage() = error.what();
            return codeOf(error.code());
        } catch (const std::bad_alloc&) {
            lastMessage() = "out of memory";
            return DROPLET_OUT_OF_MEMORY;
        } catch (const std::exception& error) {
            lastMessage() = error.what();
            return DROPLET_INTERNAL;
        }
    } catch (...) {  // not even the message
        return DROPLET_OUT_OF_MEMORY;
    }
}

/// Refuses a null pointer.
/// @throws droplet::Error  InvalidArgument
template <typename Pointer>
Pointer* required(const char* name, Pointer* pointer)
{
    if (pointer == nullptr) {
        throw droplet::Error(droplet::ErrorCode::InvalidArgument, std::string(name) + " must not be NULL");
    }
    return pointer;
}

}  // namespace binding
