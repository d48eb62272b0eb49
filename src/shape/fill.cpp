// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/fill.h"

#include <cmath>
#include <numbers>
#include <string>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {

void Fill::validate() const
{
    const auto fail = [this](const char* field, const char* unit, const char* constraint) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("{} {}{} must be {}", field, numberText(amount), unit, constraint));
    };
    const bool positive = amount > 0.0 && std::isfinite(amount);
    switch (by) {
        case FillBy::Volume:
            if (!positive) {
                fail("volume", " m³", "positive");
            }
            break;
        case FillBy::Height:
            if (!positive) {
                fail("height", " m", "positive");
            }
            break;
        case FillBy::ContactAngle:
            if (!positive || amount >= std::numbers::pi) {
                fail("contact_angle", " rad", "between 0 and 180 degrees");
            }
            break;
    }
}

}  // namespace droplet
