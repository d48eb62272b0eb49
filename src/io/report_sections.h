// SPDX-License-Identifier: GPL-3.0-or-later
// What reports have in common.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "droplet/io/report.h"

namespace droplet {

using ReportJson = nlohmann::ordered_json;

const char* nameOf(Model model);
ReportJson liquidSection(const SolveOptions& physics, const std::optional<Hysteresis>& hysteresis);
ReportJson groundSection(const GroundReport& ground);
ReportJson fillSection(const Fill& fill, const std::optional<FillRange>& range);

/// What all droplets together and every one of them have in common.
ReportJson shapeSection(const ShapeFigures& figures, const ReportJson& pressure,
                        const std::optional<Retention>& retention, bool would_slide);

/// Footprint and shape.
ReportJson dropletRow(const DropletReport& droplet);

/// JSON has no NaN and no infinity; the library would write null, which a script would take for "not there".
/// @throws Error NoSuchDroplet, naming the key
void refuseNonFinite(const ReportJson& value, const std::string& key);

}  // namespace droplet
