// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are a contract, schema droplet-shape.liquid2d/1: add keys, do not rename or remove any.
#include "droplet/liquid2d_io/liquid_report.h"

#include <ostream>

#include "droplet/version.h"
#include "io/report_sections.h"

namespace droplet {

void writeLiquidReport(std::ostream& out, const LiquidReport& report)
{
    const ExpressionOptions& o = report.options;
    ReportJson json;
    json["schema"] = "droplet-shape.liquid2d/1";
    json["version"] = kVersion;
    json["input"] = {{"scene", orNull(report.scene)}, {"particles", orNull(report.particles)}};
    json["output"] = {{"drawings", orNull(report.output)}, {"masks", orNull(report.masks)}};
    json["window_m"] = {report.size.x, report.size.y};
    json["spacing_m"] = report.spacing;
    json["frames_per_second"] = report.frames_per_second;
    json["style"] = {{"name", report.style},       {"tail_s", o.tail_length},  {"tail_slope", o.tail_slope},
                     {"max_tail", o.max_tail},     {"claws", o.claws},         {"air", o.air},
                     {"release", o.release},       {"max_air", o.max_air},     {"eraser_share", o.eraser_share},
                     {"crest_gate", o.crest_gate}, {"smoothing", o.smoothing}, {"fairing", o.fairing},
                     {"resolution", o.resolution}, {"min_area", o.min_area},   {"droplet_size", o.droplet_size}};
    json["frames"] = ReportJson::array();
    for (const LiquidFrameRow& row : report.frames) {
        json["frames"].push_back({{"time_s", row.time},
                                  {"particles", row.particles},
                                  {"steps", row.steps},
                                  {"particle_area_m2", row.particle_area},
                                  {"area_m2", row.area},
                                  {"outlines", row.outlines},
                                  {"foam", row.foam},
                                  {"droplets", row.droplets}});
    }
    json["removed"] = report.removed;
    addRunSection(json, {report.warnings, report.time_total, report.peak_memory});
    writeReportJson(out, json);
}

}  // namespace droplet
