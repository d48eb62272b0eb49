// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace droplet {

/// Kind of an error; the command has one exit code for each kind.
enum class ErrorCode {
    InvalidArgument,  ///< an argument is outside its documented range
    InvalidInput,     ///< the footprint cannot be read, or holds no liquid
    OutputFailed,     ///< a file cannot be written completely
    NoSuchDroplet,    ///< the requested droplet does not exist, or the solver failed
};

/// Name of a kind of error: `InvalidArgument`, `InvalidInput`, `OutputFailed` or `NoSuchDroplet`.
constexpr const char* name(ErrorCode code) noexcept
{
    switch (code) {
        case ErrorCode::InvalidArgument:
            return "InvalidArgument";
        case ErrorCode::InvalidInput:
            return "InvalidInput";
        case ErrorCode::OutputFailed:
            return "OutputFailed";
        case ErrorCode::NoSuchDroplet:
            break;
    }
    return "NoSuchDroplet";
}

/// The only exception type that this library throws.
/// Guarantees: the message is one line that names the field, its value and the constraint.
class Error : public std::runtime_error {
public:
    /// Makes an error.
    /// @param code     kind of the error
    /// @param message  one line, without a full stop or line break at its end
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

    /// Kind of the error.
    [[nodiscard]] ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

}  // namespace droplet
