// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <streambuf>
#include <string>

namespace droplet::testing {

/// Stream buffer that stores all bytes and the size of the largest single write.
class Pieces : public std::streambuf {
public:
    [[nodiscard]] const std::string& taken() const { return taken_; }
    [[nodiscard]] std::size_t largest() const { return largest_; }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        taken_.append(bytes, static_cast<std::size_t>(count));
        largest_ = std::max(largest_, static_cast<std::size_t>(count));
        return count;
    }

    int_type overflow(int_type c) override
    {
        const char byte = traits_type::to_char_type(c);
        xsputn(&byte, 1);
        return traits_type::not_eof(c);
    }

private:
    std::string taken_;
    std::size_t largest_ = 0;
};

}  // namespace droplet::testing
