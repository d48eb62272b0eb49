// SPDX-License-Identifier: GPL-3.0-or-later
//
// The names are the contract of the schema droplet-shape.sequence/1: keys may be added, but not renamed or removed.
#include "droplet/sequence/sequence_report.h"

#include <algorithm>
#include <ostream>

#include "droplet/version.h"
#include "io/report_sections.h"

namespace droplet {
namespace {

ReportJson frameRow(const FrameReport& frame)
{
    std::size_t holes = 0;
    for (const DropletReport& droplet : frame.droplets) {
        holes += droplet.holes;
    }
    ReportJson row{{"input", frame.input},
                   {"output", frame.output ? ReportJson(*frame.output) : ReportJson()},
                   {"continues", frame.continues},
                   {"held", frame.held},
                   {"vertices_kept_share", orNull(frame.vertices_kept)},
                   {"volume_gained_m3", frame.volume_gained},
                   {"volume_lost_m3", frame.volume_lost},
                   {"vertices", frame.vertices},
                   {"triangles", frame.triangles},
                   {"closed", frame.closed},
                   {"footprint_area_m2", frame.total.footprint_area},
                   {"rim_length_m", frame.total.rim_length},
                   {"holes", holes}};
    row.update(shapeSection(frame.total, orNull(frame.pressure), {}, false));
    if (frame.droplets.empty()) {
        for (ReportJson& angle : row["contact_angle_deg"]) {
            angle = nullptr;
        }
    }
    row["falling"] = ReportJson::array();
    for (const FallingDrop& drop : frame.falling) {
        const Vec3 place = drop.place();
        row["falling"].push_back({{"from", drop.droplet},
                                  {"volume_m3", drop.volume},
                                  {"middle_m", {place.x, place.y, place.z}},
                                  {"since_s", drop.since}});
    }
    row["droplets"] = ReportJson::array();
    for (std::size_t k = 0; k < frame.droplets.size(); ++k) {
        ReportJson droplet{{"id", frame.ancestry[k].id}, {"from", frame.ancestry[k].from}};
        droplet.update(dropletRow(frame.droplets[k]));
        row["droplets"].push_back(std::move(droplet));
    }
    return row;
}

}  // namespace

FrameReport reportOf(const Frame& frame, const SequenceOptions& options)
{
    const Droplet& droplet = frame.droplet;
    FrameReport report;
    report.continues = frame.continues;
    report.held = !frame.held.empty();
    report.vertices_kept = frame.vertices_kept;
    report.volume_gained = frame.volume_gained;
    report.volume_lost = frame.volume_lost;
    report.total = droplet.total;
    report.falling = frame.falling;
    report.drops_shed = frame.drops_shed;
    if (droplet.meshes.empty()) {
        report.closed = true;
        return report;
    }
    const bool has_one_pressure =
        options.volume_mode != VolumeMode::Track && options.droplet.solve.fill.sharing == FillSharing::Total;
    if (has_one_pressure || droplet.meshes.size() == 1) {
        report.pressure = droplet.solution.droplets.front().pressure;
    }
    report.vertices = droplet.surface.vertices.size();
    report.triangles = droplet.surface.triangles.size();
    report.closed = isClosed(droplet.surface);
    report.ancestry = frame.droplets;
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        report.droplets.push_back({droplet.figures[k], droplet.meshes[k].loopCount() - 1,
                                   droplet.solution.droplets[k].pressure, std::nullopt});
    }
    return report;
}

std::size_t SequenceReport::dry() const
{
    return static_cast<std::size_t>(
        std::count_if(frames.begin(), frames.end(), [](const FrameReport& frame) { return frame.droplets.empty(); }));
}

std::size_t SequenceReport::held() const
{
    return static_cast<std::size_t>(
        std::count_if(frames.begin(), frames.end(), [](const FrameReport& frame) { return frame.held; }));
}

std::optional<double> SequenceReport::meanVerticesKept() const
{
    double sum = 0.0;
    std::size_t count = 0;
    for (const FrameReport& frame : frames) {
        sum += frame.vertices_kept.value_or(0.0);
        count += frame.vertices_kept ? 1 : 0;
    }
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

std::size_t SequenceReport::kept() const
{
    return static_cast<std::size_t>(
        std::count_if(frames.begin(), frames.end(), [](const FrameReport& frame) { return frame.continues; }));
}

void writeSequenceReport(std::ostream& out, const SequenceReport& report)
{
    ReportJson json;
    json["schema"] = "droplet-shape.sequence/1";
    json["version"] = kVersion;
    json["model"] = nameOf(report.physics.model);
    json["input"] = {{"paths", report.inputs},
                     {"width_px", report.width_px},
                     {"height_px", report.height_px},
                     {"pixel_size_m", report.pixel_size}};
    json["output"] = {{"path", report.output},
                      {"format", name(report.format)},
                      {"bytes", report.bytes},
                      {"frames_per_second", report.frames_per_second}};
    json["liquid"] = liquidSection(report.physics, {});
    json["ground"] = groundSection(report.ground);
    json["no_penetration"] = report.physics.no_penetration;
    json["fill"] = fillSection(report.physics.fill, {});
    json["volume_mode"] = report.volume_mode == VolumeMode::Total   ? "total"
                          : report.volume_mode == VolumeMode::Track ? "track"
                                                                    : "fill";
    const std::size_t transitions = report.frames.empty() ? 0 : report.frames.size() - 1;
    json["transitions"] = {{"count", transitions},
                           {"vertices_kept", report.kept()},
                           {"vertices_kept_share", orNull(report.meanVerticesKept())}};
    json["frames"] = ReportJson::array();
    for (const FrameReport& frame : report.frames) {
        json["frames"].push_back(frameRow(frame));
    }
    addRunSection(json, {report.warnings, report.time_total, report.peak_memory});
    writeReportJson(out, json);
}

}  // namespace droplet
