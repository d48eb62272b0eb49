// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "droplet/windshield/drive_cycle.h"

namespace droplet {

/// Reads a drive cycle from CSV text: a header `time_s,speed_m_per_s` (or `speed_km_per_h`, `speed_mph`; `time[s]`,
/// `speed (km/h)` and similar mean the same), then a row for every time. Other columns and empty lines at the end are
/// ignored. Lines end in LF or CRLF; fields may be quoted.
///
/// Nothing is guessed: empty fields, fields that are not numbers, NaN, times that do not ascend, negative speeds, rows
/// with more cells than the header and gaps are errors. A gap is an empty line between rows, or an interval of at least
/// 1.5 times the usual one if at least ten rows have equal intervals.
/// @param text   UTF-8, with or without a byte order mark
/// @param name   name of the file for error messages
/// @throws Error InvalidInput; the message names the file, the line and the problem
DriveCycle parseDriveCycle(std::string_view text, const std::string& name);

/// Reads a drive cycle from a CSV file.
/// @throws Error InvalidInput as parseDriveCycle(), or if the file cannot be read
DriveCycle readDriveCycle(const std::filesystem::path& path);

}  // namespace droplet
