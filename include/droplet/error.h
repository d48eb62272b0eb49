// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace droplet {

/// What kind of thing went wrong; the command maps each kind to one exit code.
enum class ErrorCode {
    InvalidArgument,  ///< a value the caller passed is outside its documented range
    InvalidInput,     ///< the footprint cannot be read, or holds no liquid
    OutputFailed,     ///< a file cannot be written whole
    NoSuchDroplet,    ///< the asked-for droplet does not exist, or the solver failed
};

/// The one exception this library throws.
/// Guarantees: the message is a single line that names the field, its value and the constraint.
class Error : public std::runtime_error {
public:
    /// @param code     kind of failure
    /// @param message  one line, no trailing full stop or line break
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

    [[nodiscard]] ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

}  // namespace droplet
