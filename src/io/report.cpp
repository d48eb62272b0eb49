// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys are the contract of the schema droplet-shape.report/1: keys may be added, but not renamed or removed.
#include "droplet/io/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "io/report_sections.h"
#include "utf8.h"

namespace droplet {
namespace {

using Json = ReportJson;

const char* nameOf(Channel channel)
{
    switch (channel) {
        case Channel::Alpha:
            return "alpha";
        case Channel::Luma:
            return "luma";
        case Channel::Auto:
            break;
    }
    throw Error(ErrorCode::InvalidArgument, "report: input.channel is not decided, must be alpha or luma");
}

const char* nameOf(FillBy by)
{
    switch (by) {
        case FillBy::Volume:
            return "volume_m3";
        case FillBy::Height:
            return "height_m";
        case FillBy::ContactAngle:
            return "contact_angle_deg";
    }
    throw Error(ErrorCode::InvalidArgument, "report: fill.by has an unknown value");
}

const char* nameOf(TextureMap map)
{
    switch (map) {
        case TextureMap::Projection:
            return "projection";
        case TextureMap::Flat:
            return "flat";
        case TextureMap::Folded:
            return "folded";
    }
    throw Error(ErrorCode::InvalidArgument, "report: output.uv has an unknown value");
}

const char* nameOf(GroundKind kind)
{
    switch (kind) {
        case GroundKind::Flat:
            return "flat";
        case GroundKind::Sphere:
            return "sphere";
        case GroundKind::Cylinder:
            return "cylinder";
        case GroundKind::HeightMap:
            return "height map";
    }
    throw Error(ErrorCode::InvalidArgument, "report: ground.kind has an unknown value");
}

Json nameOrNull(FillLimit limit)
{
    switch (limit) {
        case FillLimit::None:
            return nullptr;
        case FillLimit::Puddle:
            return "puddle";
        case FillLimit::Existence:
            return "existence";
    }
    throw Error(ErrorCode::InvalidArgument, "report: limit has an unknown value");
}

double degrees(double radians)
{
    return radians / kDegree;
}

std::optional<double> degrees(const std::optional<double>& radians)
{
    return radians ? std::optional(degrees(*radians)) : std::nullopt;
}

Json place(Vec2 at)
{
    return Json::array({at.x, at.y});
}

Json angles(const ContactAngle& angle)
{
    return {{"min", degrees(angle.min)},
            {"mean", degrees(angle.mean)},
            {"max", degrees(angle.max)},
            {"min_at_m", place(angle.min_at)},
            {"max_at_m", place(angle.max_at)}};
}

Json typeSection(const TypeReport& type)
{
    Json axes = Json::object();
    for (const auto& [tag, value] : type.axes) {
        axes[tag] = value;
    }
    Json missing = Json::array();
    for (const char32_t character : type.missing) {
        missing.push_back(codePointOf(character));
    }
    return {{"family", type.family},
            {"style", type.style},
            {"face_index", type.face_index},
            {"axes", axes},
            {"text", type.text ? Json(*type.text) : Json()},
            {"glyph", type.glyph ? Json(*type.glyph) : Json()},
            {"glyph_name", type.glyph ? Json(type.glyph_name) : Json()},
            {"character", type.character ? Json(codePointOf(*type.character)) : Json()},
            {"missing", missing},
            {"em_m", type.em}};
}

Json paletteSection(const std::vector<PaletteColour>& palette)
{
    if (palette.empty()) {
        return nullptr;
    }
    Json list = Json::array();
    for (const PaletteColour& entry : palette) {
        list.push_back({{"colour", text(entry.colour)}, {"pixels", entry.pixels}});
    }
    return list;
}

Json colourOrNull(const std::optional<CssColour>& colour)
{
    return colour ? Json(text(*colour)) : Json();
}

template <typename Number>
Json unlessZero(Number number)
{
    return number == Number{} ? Json() : Json(number);
}

/// Keys that describe a picture are null for a font, but for those of the pixels with which its colours are drawn.
Json inputSection(const InputReport& input)
{
    if (input.type) {
        return {{"path", input.path},
                {"width_px", unlessZero(input.width_px)},
                {"height_px", unlessZero(input.height_px)},
                {"drawn", nullptr},
                {"own_size", nullptr},
                {"pixel_size_m", unlessZero(input.pixel_size)},
                {"channel", nullptr},
                {"inverted", nullptr},
                {"segment", nullptr},
                {"segment_confidence", nullptr},
                {"threshold", nullptr},
                {"level_dry", nullptr},
                {"level_liquid", nullptr},
                {"anti_aliased", nullptr},
                {"specks_dropped", input.specks_dropped},
                {"largest_speck_px2", nullptr},
                {"palette", paletteSection(input.palette)},
                {"background", nullptr},
                {"type", typeSection(*input.type)}};
    }
    return {{"path", input.path},
            {"width_px", input.width_px},
            {"height_px", input.height_px},
            {"drawn", input.drawn},
            {"own_size", input.own_size},
            {"pixel_size_m", input.pixel_size},
            {"channel", nameOf(input.channel)},
            {"inverted", input.inverted},
            {"segment", name(input.segment)},
            {"segment_confidence", input.segment_confidence},
            {"threshold", input.threshold},
            {"level_dry", input.level_dry},
            {"level_liquid", input.level_liquid},
            {"anti_aliased", input.anti_aliased},
            {"specks_dropped", input.specks_dropped},
            {"largest_speck_px2", input.largest_speck_px},
            {"palette", paletteSection(input.palette)},
            {"background", colourOrNull(input.background)},
            {"type", nullptr}};
}

Json levelsSection(const std::vector<LevelReport>& levels)
{
    Json section = Json::array();
    for (const LevelReport& level : levels) {
        section.push_back({{"path", orNull(level.path)},
                           {"triangles", level.triangles},
                           {"vertices", level.vertices},
                           {"error_rms_m", level.error}});
    }
    return section;
}

Json outputSection(const OutputReport& output)
{
    return {{"path", output.path},
            {"format", name(output.format)},
            {"bytes", output.bytes},
            {"vertices", output.vertices},
            {"triangles", output.triangles},
            {"quads", output.quads},
            {"base_m", orNull(output.base)},
            {"maps", output.maps},
            {"map_thickness_m", orNull(output.map_thickness)},
            {"levels", levelsSection(output.levels)},
            {"closed", output.topology.closed},
            {"manifold", output.topology.manifold},
            {"euler", output.topology.euler},
            {"components", output.topology.components},
            {"boundary_loops", output.topology.boundary_loops},
            {"uv", nameOf(output.texture_map)},
            {"compression", name(output.compression)},
            {"position_error_m", output.compression_error ? Json(output.compression_error->position) : Json()},
            {"normal_error_deg", output.compression_error ? Json(output.compression_error->normal / kDegree) : Json()}};
}

Json ontoSection(const ObjectReport& onto)
{
    return {{"path", onto.path},
            {"droplets_laid", onto.droplets_laid},
            {"droplets_left_out", onto.droplets_left_out},
            {"flipped_charts", onto.flipped_charts},
            {"overlapping_charts", onto.overlapping_charts},
            {"least_scale", onto.min_scale},
            {"most_scale", onto.max_scale}};
}

}  // namespace

const char* nameOf(Model model)
{
    switch (model) {
        case Model::Linear:
            return "linear";
        case Model::Exact:
            return "exact";
        case Model::Auto:
            return "auto";
    }
    throw Error(ErrorCode::InvalidArgument, "report: model has an unknown value");
}

Json fillSection(const Fill& fill, const std::optional<FillRange>& range)
{
    return {{"by", nameOf(fill.by)},
            {"amount", fill.by == FillBy::ContactAngle ? degrees(fill.amount) : fill.amount},
            {"sharing", fill.sharing == FillSharing::Each ? "each" : "total"},
            {"range", range ? Json::array({range->min, range->max}) : Json()}};
}

Json liquidSection(const SolveOptions& physics, const std::optional<Hysteresis>& hysteresis)
{
    std::optional<double> advancing;
    std::optional<double> receding;
    if (hysteresis) {
        advancing = degrees(hysteresis->advancing);
        receding = degrees(hysteresis->receding);
    }
    return {{"name", physics.liquid.name},
            {"surface_tension_n_per_m", physics.liquid.surface_tension},
            {"density_kg_per_m3", physics.liquid.density},
            {"gravity_m_per_s2", physics.gravity},
            {"tilt_deg", degrees(physics.tilt)},
            {"tilt_direction_deg", degrees(physics.tilt_direction)},
            {"capillary_length_m", orNull(capillaryLength(physics.liquid, physics.gravity))},
            {"advancing_deg", orNull(advancing)},
            {"receding_deg", orNull(receding)}};
}

Json groundSection(const GroundReport& ground)
{
    return {{"kind", nameOf(ground.kind)},
            {"path", orNull(ground.path)},
            {"depth_m", orNull(ground.depth)},
            {"radius_m", orNull(ground.radius)},
            {"axis_deg", orNull(degrees(ground.axis))}};
}

Json shapeSection(const ShapeFigures& figures, const Json& pressure, const std::optional<Retention>& retention,
                  bool would_slide)
{
    return {{"volume_m3", figures.volume},
            {"volume_ul", figures.volume / kMicrolitre},
            {"pressure_pa", pressure},
            {"height_max_m", figures.height_max},
            {"height_bound_m", orNull(figures.height_bound)},
            {"depth_max_m", figures.depth_max},
            {"overhang_m", figures.overhang},
            {"dry_area_m2", figures.dry_area},
            {"liquid_area_m2", figures.liquid_area},
            {"linear_area_m2", figures.linear_area},
            {"steep_area_m2", figures.steep_area},
            {"surface_energy_j", figures.surface_energy},
            {"gravity_energy_j", figures.gravity_energy},
            {"energy_j", figures.surface_energy + figures.gravity_energy},
            {"bond_number", figures.bond_number},
            {"contact_angle_deg", angles(figures.contact_angle)},
            {"slope_max_deg", degrees(figures.slope_max)},
            {"projected_width_m", figures.projected_width},
            {"would_slide", retention ? Json(would_slide) : Json()},
            {"driving_force_n", retention ? Json(retention->driving_force) : Json()},
            {"retention_force_n", retention ? Json(retention->retention_force) : Json()}};
}

Json dropletRow(const DropletReport& droplet)
{
    Json row{{"footprint_area_m2", droplet.figures.footprint_area},
             {"rim_length_m", droplet.figures.rim_length},
             {"holes", droplet.holes}};
    row.update(shapeSection(droplet.figures, droplet.pressure, droplet.retention,
                            droplet.retention && droplet.retention->wouldSlide()));
    return row;
}

namespace {

void refuseNonFinite(const Json& value, const std::string& key)
{
    if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        throw Error(ErrorCode::NoSuchDroplet, "report: " + key + " is not finite");
    }
    if (value.is_structured()) {
        for (const auto& [name, member] : value.items()) {
            refuseNonFinite(member, key.empty() ? name : std::string(key).append(".").append(name));
        }
    }
}

Json sections(const Report& report)
{
    const ShapeFigures& total = report.total;
    Json json;
    json["schema"] = "droplet-shape.report/1";
    json["version"] = kVersion;
    json["model"] = report.sheets > 0 ? "parametric" : nameOf(report.physics.model);
    json["input"] = inputSection(report.input);
    json["output"] = outputSection(report.output);
    json["liquid"] = liquidSection(report.physics, report.hysteresis);
    json["ground"] = groundSection(report.ground);
    json["no_penetration"] = report.physics.no_penetration;
    json["onto"] = report.onto ? ontoSection(*report.onto) : Json();
    json["fill"] = fillSection(report.physics.fill, report.fill_range);
    json["fill"]["limited_by"] = nameOrNull(limitOf(report.droplets));
    json["mesh"] = {{"vertices", report.mesh.vertices},
                    {"triangles", report.mesh.triangles},
                    {"min_angle_deg", degrees(report.mesh.min_angle)},
                    {"footprint_area_m2", total.footprint_area},
                    {"rim_length_m", total.rim_length},
                    {"droplets", report.droplets.size()},
                    {"holes", report.mesh.holes}};
    json["solve"] = {{"method", report.solve.method},         {"unknowns", report.solve.unknowns},
                     {"iterations", report.solve.iterations}, {"newton_steps", report.solve.newton_steps},
                     {"residual", report.solve.residual},     {"converged", report.solve.usable()}};
    const bool would_slide = std::any_of(report.droplets.begin(), report.droplets.end(), [](const DropletReport& d) {
        return d.retention && d.retention->wouldSlide();
    });
    json["shape"] = shapeSection(total, orNull(report.pressure), report.retention, would_slide);
    json["droplets"] = Json::array();
    for (const DropletReport& droplet : report.droplets) {
        json["droplets"].push_back(dropletRow(droplet));
        json["droplets"].back()["colour"] = colourOrNull(droplet.colour);
        json["droplets"].back()["limited_by"] = nameOrNull(droplet.limit);
    }
    json["warnings"] = report.warnings;
    for (std::size_t stage = 0; stage < kStageCount; ++stage) {
        json["time_s"][name(static_cast<Stage>(stage))] = report.time[stage];
    }
    json["time_s"]["total"] = report.time_total;
    json["peak_memory_bytes"] = report.peak_memory;
    return json;
}

}  // namespace

FillLimit limitOf(const std::vector<DropletReport>& droplets)
{
    FillLimit limit = FillLimit::None;
    for (const DropletReport& droplet : droplets) {
        limit = std::max(limit, droplet.limit);  // in the order of their gravity
    }
    return limit;
}

void addRunSection(ReportJson& json, const RunFigures& run)
{
    json["warnings"] = run.warnings;
    json["time_s"] = {{"total", run.time_total}};
    json["peak_memory_bytes"] = run.peak_memory;
}

void writeReportJson(std::ostream& out, const ReportJson& report)
{
    refuseNonFinite(report, "");
    out << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void writeReport(std::ostream& out, const Report& report)
{
    writeReportJson(out, sections(report));
}

}  // namespace droplet
