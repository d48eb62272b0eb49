// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "droplet/windshield/drive_cycle.h"

namespace droplet {

/// Reads a drive cycle from CSV: a header, `time_s,speed_m_per_s` (or `speed_km_per_h`, `speed_mph`; `time[s]`,
/// `speed (km/h)` and the like mean the same), then a row for every time. Other columns are passed over, empty lines at
/// the end too; lines end in LF or CRLF, fields may be quoted.
///
/// Nothing is guessed: fields that are empty or no number, NaN, times that do not rise, negative speeds, rows with more
/// cells than the header and gaps are refused. A gap is an empty line between rows, or, where at least ten rows come at
/// even intervals, an interval of 1.5 of those or more.
/// @param text   UTF-8, with or without a byte order mark
/// @param name   of the file, for messages
/// @throws Error InvalidInput, naming the file, the row (its line in the file) and what is wrong, in one line
DriveCycle parseDriveCycle(std::string_view text, const std::string& name);

/// The same from a file.
/// @throws Error InvalidInput, also where the file cannot be read
DriveCycle readDriveCycle(const std::filesystem::path& path);

}  // namespace droplet
