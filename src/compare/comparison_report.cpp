// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are the contract of the schema droplet-shape.compare/1: they may be added, but not renamed or removed.
#include "droplet/compare/comparison_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "droplet/units.h"
#include "droplet/version.h"
#include "number_text.h"

namespace droplet {
namespace {

using Json = nlohmann::ordered_json;

Json degrees(double radians)
{
    return radians / kDegree;
}

Json point(Vec3 p)
{
    return {p.x, p.y, p.z};
}

Json orNull(const std::optional<double>& value, double unit = 1.0)
{
    return value ? Json(*value / unit) : Json();
}

Json angles(const std::optional<ContactAngleRange>& range)
{
    return range ? Json{{"min", degrees(range->min)}, {"mean", degrees(range->mean)}, {"max", degrees(range->max)}}
                 : Json();
}

Json measures(const std::string& path, const SurfaceMeasures& surface)
{
    return {{"path", path},
            {"vertices", surface.vertices},
            {"triangles", surface.triangles},
            {"lowest_m", point(surface.lowest)},
            {"highest_m", point(surface.highest)},
            {"area_m2", surface.area},
            {"volume_m3", surface.volume},
            {"manifold", surface.topology.manifold},
            {"closed", surface.topology.closed},
            {"euler", surface.topology.euler},
            {"components", surface.topology.components},
            {"boundary_loops", surface.topology.boundary_loops},
            {"contact_angle_deg", angles(surface.contact_angle)}};
}

Json distance(const SurfaceDistance& found)
{
    return {{"lower_m", found.lower},  {"upper_m", found.upper},
            {"at_m", point(found.at)}, {"nearest_m", point(found.nearest)},
            {"mean_m", found.mean},    {"rms_m", found.rms}};
}

Json deviation(const NormalDeviation& found)
{
    return {{"largest_deg", degrees(found.largest)}, {"rms_deg", degrees(found.rms)}, {"at_m", point(found.at)}};
}

std::optional<double> share(double a, double b)
{
    return a != 0.0 ? std::optional((b - a) / std::abs(a)) : std::nullopt;
}

std::string inWords(const Topology& topology)
{
    if (!topology.manifold) {
        return "not a manifold";
    }
    return std::to_string(topology.components) + (topology.closed ? " closed" : "") +
           (topology.components == 1 ? " component" : " components") + " of Euler number " +
           std::to_string(topology.euler) +
           (topology.closed ? "" : " with " + std::to_string(topology.boundary_loops) + " boundary loops");
}

}  // namespace

std::vector<std::string> exceeded(const Comparison& comparison, const Tolerances& tolerances)
{
    std::vector<std::string> lines;
    if (tolerances.any() && !comparison.same_topology) {
        lines.push_back("topology is not the same: " + inWords(comparison.a.topology) + "; " +
                        inWords(comparison.b.topology));
    }
    if (tolerances.distance && !(comparison.symmetric.upper <= *tolerances.distance)) {
        lines.push_back("the largest distance of " + numberText(comparison.symmetric.upper / kMillimetre) +
                        " mm is over " + numberText(*tolerances.distance / kMillimetre) + " mm");
    }
    const std::optional<double> volume = comparison.relativeVolume();
    const bool volumes_differ =
        volume ? !(std::abs(*volume) <= tolerances.volume.value_or(0.0)) : comparison.b.volume != 0.0;
    if (tolerances.volume && volumes_differ) {
        lines.push_back("the difference in volume of " +
                        (volume ? numberText(100.0 * *volume) + " %" : "a surface from one without volume") +
                        " is over " + numberText(100.0 * *tolerances.volume) + " %");
    }
    if (tolerances.normals && !(comparison.normals.rms <= *tolerances.normals)) {
        lines.push_back("the rms angle between normals of " + numberText(comparison.normals.rms / kDegree) +
                        " deg is over " + numberText(*tolerances.normals / kDegree) + " deg");
    }
    return lines;
}

void writeComparison(std::ostream& out, const ComparisonReport& report)
{
    const Comparison& found = report.comparison;
    const auto& angle_a = found.a.contact_angle;
    const auto& angle_b = found.b.contact_angle;
    Json json = {{"schema", "droplet-shape.compare/1"},
                 {"version", kVersion},
                 {"a", measures(report.path_a, found.a)},
                 {"b", measures(report.path_b, found.b)}};
    json["distance"] = distance(found.symmetric);
    json["distance_from_a"] = distance(found.from_a);
    json["distance_from_b"] = distance(found.from_b);
    json["normals"] = deviation(found.normals);
    json["normals_of_a"] = deviation(found.normals_of_a);
    json["normals_of_b"] = deviation(found.normals_of_b);
    json["difference"] = {
        {"volume_m3", found.b.volume - found.a.volume},
        {"volume_share", orNull(found.relativeVolume())},
        {"area_m2", found.b.area - found.a.area},
        {"area_share", orNull(share(found.a.area, found.b.area))},
        {"contact_angle_mean_deg", angle_a && angle_b ? degrees(angle_b->mean - angle_a->mean) : Json()}};
    json["same_topology"] = found.same_topology;
    json["tolerance"] = {{"distance_m", orNull(report.tolerances.distance)},
                         {"volume_share", orNull(report.tolerances.volume)},
                         {"normals_deg", orNull(report.tolerances.normals, kDegree)}};
    json["exceeded"] = report.exceeded;
    json["warnings"] = report.warnings;
    out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace droplet
