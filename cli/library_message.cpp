// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_message.h"

#include <array>

namespace cli {

std::span<const NamedOption> namedOptions()
{
    static constexpr std::array<NamedOption, 15> kAll{
        {{"number of triangles", "--triangles"},
         {"shorten the edges", "--edge"},
         {"a smaller contact angle", "--contact-angle"},
         {"less gravity or a smaller width", "--gravity, --width"},
         {"a given volume", "--volume"},
         {"the channel is alpha", "--channel"},
         {"a segmentation method or a threshold", "--segment, --threshold"},
         {"the segmentation method", "--segment"},
         {"reaches the threshold", "--threshold"},
         {"or a colour", "--colour"},
         {"the speck size", "--speck-size"},
         {"use the exact model", "--model exact"},
         {"use the linear model", "--model linear"},
         {"prevent penetration", "--no-penetration"},
         {"the arc", "--arc"}}};
    return kAll;
}

std::string withOptions(std::string message)
{
    for (const auto& [phrase, options] : namedOptions()) {
        const auto at = message.find(phrase);
        if (at != std::string::npos && message.find(options) == std::string::npos) {
            message.insert(at + phrase.size(), " (" + std::string(options) + ")");
        }
    }
    return message;
}

}  // namespace cli
