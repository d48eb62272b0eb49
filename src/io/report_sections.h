// SPDX-License-Identifier: GPL-3.0-or-later
// Sections that several reports have.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

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

/// Writes a report, indented.
/// @throws Error NoSuchDroplet, naming the key, if a number is not finite: JSON has no NaN and no infinity; the library
///               would write null, which scripts understand as "missing"
void writeReportJson(std::ostream& out, const ReportJson& report);

}  // namespace droplet
