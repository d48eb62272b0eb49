// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are a contract, schema droplet-shape.dew/1: add keys, do not rename or remove any.
#include "droplet/flow_io/dew_report.h"

#include <ostream>

#include "droplet/version.h"
#include "flow_io/object_section.h"
#include "io/report_sections.h"
#include "wind_io/forces_section.h"

namespace droplet {

void writeDewReport(std::ostream& out, const DewReport& report)
{
    const DewOptions& options = report.options;
    const bool is_lognormal = options.sizes == DewSizes::LogNormal;
    ReportJson json;
    json["schema"] = "droplet-shape.dew/1";
    json["version"] = kVersion;
    json["preset"] = report.preset;
    json["input"] = objectSection(report.input, report.surface, report.size);
    json["output"] = {{"path", report.output},
                      {"instancing", report.instancing ? ReportJson(name(*report.instancing)) : ReportJson()}};
    json["sizes"] = {{"distribution", is_lognormal ? "lognormal" : "condensation"},
                     {"coverage", options.coverage},
                     {"smallest_m", options.smallest},
                     {"largest_m", options.largest},
                     {"median_m", nullptr},
                     {"spread", nullptr},
                     {"from", nullptr},
                     {"seed", options.seed}};
    if (is_lognormal) {
        json["sizes"]["median_m"] = options.median;
        json["sizes"]["spread"] = options.spread;
    }
    if (options.from) {
        json["sizes"]["from"] = vectorOf(*options.from);
    }
    json["forces"] = forcesSection(options.forces);
    json["forces"]["gravity_m_per_s2"] = vectorOf(options.gravity);
    json["droplets"] = {
        {"count", report.droplets},     {"volume_m3", report.volume},    {"area_m2", report.area},
        {"covered_m2", report.covered}, {"smallest_m", report.smallest}, {"largest_m", report.largest},
        {"joined", report.joined},      {"run_off", report.run_off},     {"between_edges", report.between_edges},
        {"left_out", report.left_out}};
    addRunSection(json, {report.warnings, report.time_total, report.peak_memory});
    writeReportJson(out, json);
}

}  // namespace droplet
