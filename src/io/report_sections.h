// SPDX-License-Identifier: GPL-3.0-or-later
// Sections that several reports have.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "droplet/io/report.h"

namespace droplet {

using ReportJson = nlohmann::ordered_json;

const char* nameOf(Model model);
ReportJson liquidSection(const SolveOptions& physics, const std::optional<Hysteresis>& hysteresis);
ReportJson groundSection(const GroundReport& ground);
ReportJson fillSection(const Fill& fill, const std::optional<FillRange>& range);

/// Figures of one droplet or of all droplets together.
ReportJson shapeSection(const ShapeFigures& figures, const ReportJson& pressure,
                        const std::optional<Retention>& retention, bool would_slide);

/// Row of one droplet: footprint and shape.
ReportJson dropletRow(const DropletReport& droplet);

/// The value, or null.
template <typename Value>
ReportJson orNull(const std::optional<Value>& value)
{
    return value ? ReportJson(*value) : ReportJson();
}

/// What a run took.
struct RunFigures {
    const std::vector<std::string>& warnings;
    double time_total = 0.0;        ///< [s]
    std::uint64_t peak_memory = 0;  ///< [byte]
};

/// Adds the keys at the end of a report: warnings, time_s, peak_memory_bytes.
void addRunSection(ReportJson& json, const RunFigures& run);

/// Writes a report, indented.
/// @throws Error NoSuchDroplet, naming the key, if a number is not finite: JSON has no NaN and no infinity; the library
///               would write null, which scripts understand as "missing"
void writeReportJson(std::ostream& out, const ReportJson& report);

}  // namespace droplet
