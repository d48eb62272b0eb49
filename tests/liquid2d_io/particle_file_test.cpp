// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/particle_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/liquid2d_io/particle_usda.h"
#include "droplet/liquid2d_io/write_particles.h"
#include "support/paths.h"
#include "support/usda.h"

namespace {

using droplet::Error;
using droplet::parseParticles;
using droplet::ParticleFile;
using droplet::ParticleFormat;
using droplet::ParticleFrame;
using droplet::testing::numbersIn;
using droplet::testing::UsdaReader;
using droplet::testing::UsdPrim;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

std::filesystem::path data(const std::string& name)
{
    return std::filesystem::path(droplet::testing::kSourceDir) / "tests/liquid2d_io/data" / name;
}

std::string bytesOf(const std::string& name)
{
    std::ifstream file(data(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

auto refuses(const std::string& what)
{
    return ThrowsMessage<Error>(AllOf(StartsWith("cannot use some.file: "), HasSubstr(what), Not(HasSubstr("\n"))));
}

/// Three particles whose numbers are floats.
ParticleFrame smallFrame()
{
    return {0.25,
            0.125,
            {{0.5, 1.25}, {-0.75, 2.0}, {3.0, -4.5}},
            {{1.0, -2.0}, {0.0, 0.5}, {-0.25, 8.0}},
            {7, 4000000U, 0},
            {1.0, 0.5, 1.5}};
}

std::string written(const ParticleFrame& frame, ParticleFormat format)
{
    std::ostringstream out;
    const std::uint64_t bytes = writeParticles(frame, out, format);
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

TEST(WriteParticles, AreReadBackAsTheyWere)
{
    const ParticleFrame frame = smallFrame();
    ParticleFrame no_density = frame;
    no_density.density.clear();
    for (const ParticleFormat format : {ParticleFormat::Csv, ParticleFormat::Vtp, ParticleFormat::Bgeo}) {
        for (const ParticleFrame& given : {frame, no_density}) {
            droplet::ParticleFileOptions options;
            options.spacing = given.spacing;
            options.rest_density = 1.0;
            const ParticleFile file = parseParticles(written(given, format), "some.file", options);
            EXPECT_EQ(file.frame.position, given.position);
            EXPECT_EQ(file.frame.velocity, given.velocity);
            EXPECT_EQ(file.frame.density, given.density);
            EXPECT_EQ(file.frame.id, given.id);
            EXPECT_EQ(file.time, format == ParticleFormat::Vtp ? std::optional(0.25) : std::nullopt);
        }
    }
}

TEST(WriteParticles, PlyHasAHeadAndARecordForEach)
{
    const std::string file = written(smallFrame(), ParticleFormat::Ply);
    const std::string end = "property uint id\nend_header\n";
    const std::size_t head = file.find(end) + end.size();
    EXPECT_THAT(file.substr(0, head), HasSubstr("element vertex 3\nproperty float x\n"));
    // Eight floats and a number each; the last one's id is 0.
    ASSERT_EQ(file.size() - head, std::size_t{3} * 36);
    EXPECT_EQ(file.substr(file.size() - 4), std::string(4, '\0'));
    float x = 0.0F;
    std::memcpy(&x, file.data() + head + 36, sizeof x);
    EXPECT_EQ(x, -0.75F);
}

TEST(ParticleUsda, HasPointsWithSamplesOfEveryFrame)
{
    droplet::ParticleUsda usda(12.5);
    const ParticleFrame first = smallFrame();
    ParticleFrame second = first;
    second.position.pop_back();
    second.velocity.pop_back();
    second.id.pop_back();
    second.density.pop_back();
    usda.add(first);
    usda.add(second);
    std::ostringstream out;
    usda.write(out);
    const UsdPrim root = UsdaReader(out.str()).read();
    EXPECT_EQ(root.metadata.at("timeCodesPerSecond"), "12.5");
    EXPECT_EQ(root.metadata.at("endTimeCode"), "1");
    EXPECT_EQ(root.metadata.at("upAxis"), "Y");
    const UsdPrim& points = root.child("liquid");
    EXPECT_EQ(points.type, "Points");
    EXPECT_EQ(points.value("widths"), "[0.125]");
    EXPECT_EQ(points.properties.at("widths").metadata.at("interpolation"), "constant");
    const auto at = [&](const char* name, double code) {
        return numbersIn(points.properties.at(name).samples.at(code));
    };
    EXPECT_EQ(at("points", 0.0), (std::vector<double>{0.5, 1.25, 0.0, -0.75, 2.0, 0.0, 3.0, -4.5, 0.0}));
    EXPECT_EQ(at("velocities", 0.0), (std::vector<double>{1.0, -2.0, 0.0, 0.0, 0.5, 0.0, -0.25, 8.0, 0.0}));
    EXPECT_EQ(at("ids", 0.0), (std::vector<double>{7.0, 4e6, 0.0}));
    EXPECT_EQ(at("primvars:density", 0.0), (std::vector<double>{1.0, 0.5, 1.5}));
    EXPECT_EQ(at("ids", 1.0), (std::vector<double>{7.0, 4e6}));
    EXPECT_EQ(at("points", 1.0).size(), 6U);
    // The extent holds the points with their width.
    EXPECT_EQ(at("extent", 0.0), (std::vector<double>{-0.8125, -4.5625, -0.0625, 3.0625, 2.0625, 0.0625}));
}

TEST(ParticleUsda, HoldsFramesWithoutParticlesOrDensity)
{
    droplet::ParticleUsda usda(24.0);
    ParticleFrame frame = smallFrame();
    frame.density.clear();
    usda.add(frame);
    usda.add({1.0, 0.125, {}, {}, {}, {}});
    std::ostringstream out;
    usda.write(out);
    const UsdPrim points = UsdaReader(out.str()).read().child("liquid");
    EXPECT_EQ(points.properties.at("points").samples.at(1.0), "[]");
    EXPECT_EQ(points.properties.count("primvars:density"), 0U);
}

TEST(WriteParticles, FormatsFollowTheExtension)
{
    EXPECT_EQ(droplet::particleFormatOf("a/0001.VTP"), ParticleFormat::Vtp);
    EXPECT_EQ(droplet::particleFormatOf("0001.bgeo"), ParticleFormat::Bgeo);
    EXPECT_EQ(droplet::particleFormatOf("0001.vtk"), std::nullopt);
}

class Files : public testing::TestWithParam<const char*> {};

TEST_P(Files, HoldTheSameParticles)
{
    const ParticleFile file = droplet::readParticles(data(GetParam()));
    ASSERT_EQ(file.frame.position.size(), 24U);
    EXPECT_TRUE(file.has_velocity);
    EXPECT_TRUE(file.has_id);
    EXPECT_TRUE(file.spacing_estimated);
    EXPECT_NEAR(file.frame.spacing, 0.1, 1e-6);
    const bool has_time = std::string(GetParam()).find("bgeo") == std::string::npos;
    EXPECT_EQ(file.time.has_value(), has_time);
    EXPECT_EQ(file.frame.time, has_time ? 0.25 : 0.0);
    for (std::size_t i = 0; i < 24; ++i) {
        const auto k = static_cast<double>(i);
        EXPECT_NEAR(file.frame.position[i].x, 0.1 * static_cast<double>(i % 6), 1e-6);
        EXPECT_NEAR(file.frame.position[i].y, 0.1 * static_cast<double>(i / 6), 1e-6);
        EXPECT_EQ(file.frame.velocity[i], (droplet::Vec2{1.0 + 0.25 * k, -0.5 * k}));
        EXPECT_EQ(file.frame.id[i], 100 + 7 * i);
        EXPECT_NEAR(file.frame.density[i], (1000.0 + k) / 1012.0, 1e-12);
    }
}

// Every beginning of a file either holds all particles or is refused in one line.
TEST_P(Files, CutOffAnywhereAreRefused)
{
    const std::string whole = bytesOf(GetParam());
    for (std::size_t length = 0; length < whole.size(); length += 13) {
        try {
            const ParticleFile file = parseParticles(whole.substr(0, length), "some.file");
            EXPECT_EQ(file.frame.position.size(), 24U) << length;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), droplet::ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), AllOf(HasSubstr("some.file"), Not(HasSubstr("\n"))));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Particles, Files,
                         testing::Values("poly_ascii_51.vtk", "poly_binary_42.vtk", "grid_binary_51.vtk",
                                         "grid_ascii_42.vtk", "ascii.vtp", "binary.vtp", "binary_zlib.vtp",
                                         "appended_base64_zlib.vtp", "appended_raw_zlib.vtp",
                                         "appended_raw_big_endian.vtu", "partio_layout.bgeo", "partio_layout.bgeo.gz"));

TEST(ParticleFile, TakesTheColumnsOfSeveralPrograms)
{
    for (const char* header : {"x,y,vx,vy", "x_m,y_m,velocity_x_m_per_s,velocity_y_m_per_s",
                               "\"Points:0\",\"Points:1\",\"velocity:0\",velocity:1"}) {
        const ParticleFile file = parseParticles(std::string(header) + "\n0,1,2,3\n0.5,1,4,5\n", "some.file");
        EXPECT_EQ(file.frame.position[1], (droplet::Vec2{0.5, 1.0})) << header;
        EXPECT_EQ(file.frame.velocity[1], (droplet::Vec2{4.0, 5.0})) << header;
        EXPECT_EQ(file.frame.spacing, 0.5);
        EXPECT_FALSE(file.has_id);
    }
}

TEST(ParticleFile, TurnsPlanesAndScales)
{
    const ParticleFile file = parseParticles("id,x,y,z,vx,vy,vz\n3,1,2,3,4,5,6\n1,0,0,0,0,0,0\n", "some.file",
                                             {.spacing = 0.25, .scale = 0.5, .plane = "zy", .rest_density = {}});
    EXPECT_EQ(file.frame.position[0], (droplet::Vec2{1.5, 1.0}));
    EXPECT_EQ(file.frame.velocity[0], (droplet::Vec2{3.0, 2.5}));
    EXPECT_EQ(file.frame.spacing, 0.25);
    EXPECT_EQ(file.frame.id[0], 3U);
    EXPECT_THAT([] { parseParticles("x,y\n", "some.file", {.spacing = {}, .plane = "xx", .rest_density = {}}); },
                ThrowsMessage<Error>(HasSubstr("plane is xx")));
}

TEST(ParticleFile, NamesWhatIsWrong)
{
    const auto with = [](const std::string& text) { return [text] { parseParticles(text, "some.file"); }; };
    EXPECT_THAT(with(""), refuses("empty"));
    EXPECT_THAT(with("x,y\n0,0\n1,nan\n"), ThrowsMessage<Error>(HasSubstr("some.file: row 3: y is 'nan'")));
    EXPECT_THAT(with("a,b\n0,0\n"), ThrowsMessage<Error>(HasSubstr("some.file: is no particle file")));
    EXPECT_THAT(with("x,y,id\n0,0,4\n1,1,4\n"), refuses("two particles have the id 4"));
    EXPECT_THAT(with("x,y,id\n0,0,4\n1,1,-1\n"), refuses("the id of particle 2 is -1"));
    EXPECT_THAT(with("x,y\n0,0\n"), refuses("needs two particles"));
    EXPECT_THAT(with("\x7fNSJ1234"), refuses("Houdini 12"));
    const std::string head = "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\n";
    EXPECT_THAT(with(head + "POINTS 99999999999 float\n0 0 0"), refuses("more than 20000000"));
    EXPECT_THAT(with(head + "POINTS 19999999 float\n0 0 0"), refuses("cut off"));
    EXPECT_THAT(with(head + "POINTS 2 float\n0 0 0 0 nan 0"), refuses("the position of particle 2 is not finite"));
    EXPECT_THAT(with(head + "POINTS 2 float\n0 0 0 0 1 0\nPOINT_DATA 3\n"), refuses("POINT_DATA has 3 values for 2"));
    std::string bgeo = bytesOf("partio_layout.bgeo");
    bgeo[9] = 0x01;  // 2^24 particles more
    EXPECT_THAT(with(bgeo), refuses("cut off"));
    EXPECT_THAT(with("<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\">"), refuses("vtkLZ4"));
    EXPECT_THAT([] { droplet::readParticles("/missing.vtp"); }, ThrowsMessage<Error>(HasSubstr("/missing.vtp")));
}

TEST(ParticleFile, VelocitiesFollowFromThePreviousFrame)
{
    const ParticleFrame before{
        .time = 1.0, .spacing = 1, .position = {{5, 5}, {0, 0}}, .velocity = {{}, {}}, .id = {7, 3}, .density = {}};
    const ParticleFrame now{
        .time = 1.5, .spacing = 1, .position = {{1, 2}, {9, 9}}, .velocity = {{}, {1, 1}}, .id = {3, 8}, .density = {}};
    const ParticleFrame filled = droplet::fillVelocities(before, now);
    EXPECT_EQ(filled.velocity[0], (droplet::Vec2{2.0, 4.0}));
    EXPECT_EQ(filled.velocity[1], (droplet::Vec2{1.0, 1.0}));
    EXPECT_THAT([&] { droplet::fillVelocities(now, before); }, ThrowsMessage<Error>(HasSubstr("frame.time is 1,")));
}

}  // namespace
