// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <vector>

namespace cli {

/// Pictures one behind the other in a stream, as `ffmpeg -f image2pipe` and `droplet-shape liquid2d --masks -` write
/// them: PNG, or binary PGM and PPM. One picture is in memory at a time.
class PictureStream {
public:
    explicit PictureStream(std::istream& in) : in_(in) {}

    /// File of the next picture; nothing at the end of the stream.
    /// @throws droplet::Error InvalidInput: another format, cut off, or a picture of more than a gigabyte
    std::optional<std::vector<std::byte>> next();

private:
    /// Appends bytes of the stream to a picture.
    /// @throws droplet::Error InvalidInput if there are fewer
    void take(std::vector<std::byte>& picture, std::size_t count);
    void takePng(std::vector<std::byte>& picture);
    void takePnm(std::vector<std::byte>& picture);

    std::istream& in_;
};

}  // namespace cli
