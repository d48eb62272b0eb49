// SPDX-License-Identifier: GPL-3.0-or-later
// What the paper says of its sequences (Fournier, Habibi and Poulin 1998, section 5), and what drops on a bottle, a
// leaf and a car do.
#include "droplet/flow_io/flow_presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow/flow.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/units.h"

namespace droplet {
namespace {

/// A preset on its way.
class PresetRun {
public:
    explicit PresetRun(const FlowPreset& preset)
        : object_(presetObject(preset.object)),
          scene(flowSurface(object_.vertices, object_.triangles)),
          parameters(preset.parameters)
    {
        if (!preset.materials.empty()) {
            FacePropertyOptions ground;
            ground.materials = preset.materials;
            parameters.ground = faceProperties(object_, scene.surface(), ground);
        }
        state = startFlow(scene, parameters, preset.starts);
    }
    explicit PresetRun(std::string_view name) : PresetRun(flowPresetNamed(name)) {}
    ~PresetRun() { EXPECT_LE(std::abs(balanceOf(state).residual()), 1e-9); }

    void to(double time) { state = advanceFlow(std::move(state), scene, parameters, time); }
    void step() { to(static_cast<double>(state.steps + 1) * parameters.step); }
    [[nodiscard]] std::vector<FlowSample> samples() const { return sampleFlow(state, scene, parameters); }
    [[nodiscard]] std::map<std::uint64_t, FlowSample> byId() const
    {
        std::map<std::uint64_t, FlowSample> found;
        for (const FlowSample& sample : samples()) {
            found.emplace(sample.id, sample);
        }
        return found;
    }

private:
    FlowObject object_;

public:
    FlowTerrain scene;
    FlowParameters parameters;
    FlowState state;
};

double speedOf(const FlowSample& sample)
{
    return length(sample.velocity);
}

TEST(PresetObject, MeshesAreSound)
{
    const std::map<PresetObject, std::pair<std::size_t, bool>> expected{
        {PresetObject::Slope, {1, false}}, {PresetObject::Slopes, {3, false}}, {PresetObject::Plate, {1, false}},
        {PresetObject::Sphere, {1, true}}, {PresetObject::Mask, {1, false}},   {PresetObject::Bottle, {1, true}},
        {PresetObject::Leaf, {1, false}},  {PresetObject::Car, {1, true}},     {PresetObject::Window, {1, false}}};
    for (const auto& [name, truth] : expected) {
        for (const double detail : {0.5, 1.0, 2.0}) {
            const FlowObject object = presetObject(name, detail);
            const FlowSurfaceReport report = flowSurface(object.vertices, object.triangles).report;
            const std::string where = std::to_string(static_cast<int>(name)) + " at " + std::to_string(detail);
            EXPECT_EQ(report.parts, truth.first) << where;
            EXPECT_EQ(report.boundary_edges == 0, truth.second) << where;
            EXPECT_EQ(report.without_area + report.duplicates + report.turned, 0U) << where;
            EXPECT_EQ(object.uvs.size(), object.vertices.size());
            EXPECT_EQ(object.materials.size(), object.triangles.size());
            EXPECT_EQ(object.material_names.size(), report.parts);
            EXPECT_LE(object.triangles.size(), 9000U * std::max(detail * detail, 1.0));
        }
    }
    EXPECT_NEAR(static_cast<double>(presetObject(PresetObject::Mask).triangles.size()), 2000.0, 150.0);
    EXPECT_THROW(presetObject(PresetObject::Leaf, 0.1), Error);
    EXPECT_THROW(presetObject(PresetObject::Leaf, std::nan("")), Error);
}

TEST(FlowPresets, NamesAreKnown)
{
    std::set<std::string> names;
    for (const FlowPreset& preset : flowPresets()) {
        EXPECT_TRUE(names.insert(preset.name).second);
        EXPECT_EQ(flowPresetNamed(preset.name).description, preset.description);
        EXPECT_GT(preset.duration, 0.0);
    }
    EXPECT_EQ(names.size(), 10U);
    EXPECT_THROW(flowPresetNamed("tears"), Error);
}

TEST(FlowPresets, MassesHeavyDropletsAreFasterAndSomeMerge)
{
    PresetRun run("masses");
    run.to(0.05);
    std::map<double, double> speeds;  // by volume
    for (const FlowSample& sample : run.samples()) {
        speeds[std::round(sample.volume / 60e-9)] = speedOf(sample);
    }
    ASSERT_GE(speeds.size(), 4U);
    for (int k = 2; k <= 4; ++k) {
        EXPECT_GT(speeds[k], 1.05 * speeds[k - 1]);
    }
    int changes = 0;
    while (run.state.time < flowPresetNamed("masses").duration) {
        const auto before = run.byId();
        run.step();
        for (const auto& [id, sample] : run.byId()) {
            const auto was = before.find(id);
            if (was != before.end() && sample.volume > was->second.volume * 1.01 && sample.face) {
                changes += std::abs(speedOf(sample) / speedOf(was->second) - 1.0) > 0.02 ? 1 : 0;
            }
        }
    }
    EXPECT_GE(run.state.counts.merged, 4U);
    EXPECT_GE(changes, 3) << "those that merge change their velocity";
}

TEST(FlowPresets, ViscositiesGiveInverseSpeeds)
{
    PresetRun run("viscosities");
    run.to(0.4);
    std::vector<double> speeds(3);
    for (const FlowSample& sample : run.samples()) {
        speeds.at(sample.place.x < -0.055 ? 0 : sample.place.x < 0.055 ? 1 : 2) = speedOf(sample);
    }
    // The left one is within 1 % of its terminal speed.
    EXPECT_NEAR(speeds[0] / speeds[1], 10.0, 0.2);
    EXPECT_NEAR(speeds[1] / speeds[2], 10.0, 1e-6);
}

TEST(FlowPresets, AdhesionsLetDropletsGoFartherBelowTheStrongerTheyAre)
{
    double before = 0.0;
    for (const double adhesion : {0.0, 2.5, 5.0, 7.5, 10.0}) {
        FlowPreset preset = flowPresetNamed("adhesions");
        preset.parameters.adhesion = adhesion;
        PresetRun run(preset);
        std::map<std::uint64_t, double> angles;  // where each one left
        while (angles.size() < preset.starts.size() && run.state.time < 3.0) {
            const auto last = run.byId();
            run.step();
            for (const auto& [id, sample] : run.byId()) {
                if (!sample.face) {
                    angles.try_emplace(id, std::acos(std::clamp(last.at(id).place.z / 0.1, -1.0, 1.0)));
                }
            }
        }
        ASSERT_EQ(angles.size(), preset.starts.size()) << adhesion;
        const auto [least, most] = std::minmax_element(
            angles.begin(), angles.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
        EXPECT_LT(most->second - least->second, 6.0 * kDegree) << adhesion;
        EXPECT_GT(least->second, before + 4.0 * kDegree) << adhesion;
        before = most->second;
    }
    EXPECT_GT(before, 115.0 * kDegree);
}

TEST(FlowPresets, RoughnessesHoldSmallDropletsAndStreaksCarryOthers)
{
    const FlowPreset& preset = flowPresetNamed("roughnesses");
    PresetRun run(preset);
    const auto begin = run.byId();
    const std::uint64_t small_right = 9;
    const std::uint64_t upper = 11;  // of the red frame
    const std::uint64_t lower = 12;
    double on_dry = 0.0;
    double fastest = 0.0;
    double merged = 0.0;
    double way_of_small = 0.0;
    while (run.state.time < 4.0 && merged == 0.0) {
        run.step();
        const auto now = run.byId();
        if (std::abs(run.state.time - 0.5) < 1e-9) {
            // Ways of the small droplets fall from left to right.
            double last = 1.0;
            for (const std::uint64_t id : {1U, 5U, 9U}) {
                const double way = length(now.at(id).place - begin.at(id).place);
                EXPECT_LT(way, 0.7 * last) << id;
                last = way;
            }
        }
        way_of_small = length(now.at(small_right).place - begin.at(small_right).place);
        if (!now.contains(lower) || !now.contains(upper)) {
            merged = speedOf(now.contains(upper) ? now.at(upper) : now.at(lower));
        } else if (now.at(upper).place.y > begin.at(lower).place.y + 0.01) {
            on_dry = std::max(on_dry, speedOf(now.at(upper)));
        } else {
            fastest = std::max(fastest, speedOf(now.at(upper)));
        }
    }
    EXPECT_LT(way_of_small, 0.02) << "it barely moves";
    EXPECT_GT(fastest, 1.5 * on_dry) << "the upper one accelerates on the streak";
    EXPECT_GT(merged, 0.0) << "and reaches the lower one";
    // The streak ends there: the velocity falls.
    const double after = run.state.time + 0.3;
    run.to(after);
    const auto whole = run.byId();
    EXPECT_LT(speedOf(whole.contains(upper) ? whole.at(upper) : whole.at(lower)), 0.85 * fastest);
}

TEST(FlowPresets, TearLeavesTheMaskBelowTheChinOnly)
{
    PresetRun run("tear");
    Vec3 last;
    while (run.state.counts.launches == 0 && run.state.time < 5.0) {
        last = run.samples().front().place;
        run.step();
    }
    EXPECT_EQ(run.state.counts.launches, 1U);
    EXPECT_LT(last.z, -0.092);
    EXPECT_LT(std::abs(last.x), 0.025);
    EXPECT_LT(run.state.time, flowPresetNamed("tear").duration);
    // Its streak goes from the eye to the chin without a gap.
    double highest = -1.0;
    double lowest = 1.0;
    for (std::size_t face = 0; face < run.state.wetness.size(); ++face) {
        if (run.state.wetness[face].id != 0) {
            highest = std::max(highest, run.scene.surface().faces[face].corners[0].z);
            lowest = std::min(lowest, run.scene.surface().faces[face].corners[0].z);
        }
    }
    EXPECT_GT(highest, -0.007);
    EXPECT_LT(lowest, -0.092);
    run.to(run.state.time + 3.0);
    EXPECT_EQ(run.state.counts.left, 1U);
    EXPECT_EQ(run.state.counts.launches, 1U);
}

TEST(FlowPresets, ForcesTurnToBothSidesOfADropletThatStays)
{
    PresetRun run("forces");
    double left = 0.0;
    double right = 0.0;
    while (run.state.time < flowPresetNamed("forces").duration) {
        run.step();
        const std::vector<FlowSample> samples = run.samples();
        ASSERT_EQ(samples.size(), 1U);
        EXPECT_EQ(speedOf(samples[0]), 0.0);
        EXPECT_EQ(samples[0].place, Vec3{});
        const Vec3 gravity = run.parameters.motion.at(run.state.time).toObject(run.parameters.gravity);
        const double aside = conditionsOf(samples[0], gravity).gravity.x / kStandardGravity;
        (frameOf(samples[0], gravity).ahead.x < 0.0 ? left : right) =
            std::max(aside, frameOf(samples[0], gravity).ahead.x < 0.0 ? left : right);
    }
    EXPECT_NEAR(left, std::sin(50.0 * kDegree), 0.01);
    EXPECT_NEAR(right, std::sin(50.0 * kDegree), 0.01);
}

TEST(FlowPresets, BottleSweatsAndRunningDropsWipeTheirTracks)
{
    FlowPreset preset = flowPresetNamed("bottle");
    preset.parameters.step = 1.0 / 30.0;
    PresetRun run(preset);
    run.to(1.0);
    const double dew = balanceOf(run.state).still / static_cast<double>(run.state.droplets.size());
    run.to(3.0);
    const double grown = balanceOf(run.state).still / static_cast<double>(run.state.droplets.size());
    EXPECT_GT(grown, 3.0 * dew);
    EXPECT_EQ(run.state.counts.launches, 0U) << "nothing runs yet";
    std::vector<FlowTrack> tracks;
    while (run.state.time < 7.0) {
        run.step();
        for (const FlowTrack& track : run.state.tracks) {
            if (run.state.time > 6.5 && std::abs(run.scene.surface().faces[track.face].normal.z) < 0.2) {
                tracks.push_back(track);
            }
        }
    }
    EXPECT_GT(balanceOf(run.state).left + balanceOf(run.state).airborne, 0.0) << "drops have fallen off";
    ASSERT_GT(tracks.size(), 100U);
    // Liquid close to the tracks of the last half second, apart from the drops that made them, against the mean.
    std::set<std::uint64_t> makers;
    for (const FlowTrack& track : tracks) {
        makers.insert(track.id);
    }
    const std::vector<FlowSample> samples = run.samples();
    double near = 0.0;
    double area = 0.0;
    for (std::size_t t = 0; t < tracks.size(); t += 16) {
        const FlowTrack& track = tracks[t];
        area += 0.25 * std::numbers::pi * track.width * track.width;
        for (const FlowSample& sample : samples) {
            if (!makers.contains(sample.id) && sample.face && length(sample.place - track.to) < 0.5 * track.width) {
                near += sample.volume;
            }
        }
    }
    const double mean = balanceOf(run.state).still / run.scene.area();
    EXPECT_LT(near / area, 0.2 * mean);
}

TEST(FlowPresets, LeafLosesLiquidAtItsTipAndMargin)
{
    PresetRun run("leaf");
    std::set<std::uint64_t> seen;
    std::size_t at_margin = 0;
    while (run.state.time < 6.0) {
        const auto before = run.byId();
        run.step();
        for (const auto& [id, sample] : run.byId()) {
            const auto was = before.find(id);
            if (sample.face || was == before.end() || !was->second.face || !seen.insert(id).second) {
                continue;
            }
            const FlowSurface& surface = run.scene.surface();
            double distance = 1.0;
            for (const FlowSurface::Face& face : surface.faces) {
                for (std::size_t k = 0; k < 3; ++k) {
                    if (face.neighbour[k] == FlowSurface::kNone) {
                        distance = std::min(
                            distance, length(0.5 * (face.corners[k] + face.corners[(k + 1) % 3]) - was->second.place));
                    }
                }
            }
            EXPECT_LT(distance, 8e-3) << id;
            ++at_margin;
        }
    }
    EXPECT_GE(at_margin, 5U);
    EXPECT_GE(run.state.counts.merged, 20U);
    EXPECT_GT(balanceOf(run.state).left, 0.0);
}

TEST(FlowPresets, CarsWindDrivesDropletsUpTheBonnet)
{
    for (const bool blows : {true, false}) {
        FlowPreset preset = flowPresetNamed("car");
        preset.parameters.wind = blows ? preset.parameters.wind : Vec3{};
        PresetRun run(preset);
        run.to(2.0);
        double up = 0.0;
        double down = 0.0;
        for (const FlowSample& sample : run.samples()) {
            const bool on_bonnet =
                sample.face && sample.normal.z > 0.8 && sample.place.y > -0.20 && sample.place.y < -0.10;
            if (on_bonnet && speedOf(sample) > 1e-3) {
                (sample.velocity.y > 0.0 ? up : down) += sample.volume;
            }
        }
        EXPECT_GT(blows ? up : down, 0.0);
        EXPECT_LT(blows ? down : up, 0.1 * (up + down)) << blows;
    }
}

}  // namespace
}  // namespace droplet
