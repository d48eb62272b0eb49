// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/evolver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/sheet.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/domains.h"
#include "support/heights.h"

namespace droplet {
namespace {

using testing::CommandOptions;
using testing::CommandResult;
using testing::domainOf;
using testing::ellipseLoop;
using ::testing::HasSubstr;
using testing::heightsOf;
using testing::polygonLoop;
using testing::reversed;
using testing::runProgram;
using testing::ScratchDirectory;

constexpr double kPi = std::numbers::pi;

/// Energy, height, and volume and pressure of every body, as stated by the opening comments or by Evolver.
struct Statement {
    double energy = 0.0;
    double height = 0.0;
    std::vector<double> volumes;
    std::vector<double> pressures;
};

/// Last statement in a text with lines `energy E height H` and `body K volume V pressure P` among others.
Statement statementIn(const std::string& text)
{
    Statement statement;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        const char* words = line.c_str() + std::min(line.find_first_not_of("/ "), line.size());
        double a = 0.0;
        double b = 0.0;
        if (std::sscanf(words, "energy %lf height %lf", &a, &b) == 2) {
            statement = {a, b, {}, {}};
        } else if (std::sscanf(words, "body %*f volume %lf pressure %lf", &a, &b) == 2) {
            statement.volumes.push_back(a);
            statement.pressures.push_back(b);
        }
    }
    return statement;
}

/// Content of a datafile, parsed.
struct Datafile {
    struct Vertex {
        Vec3 place;
        std::string words;  ///< behind the place
    };
    struct Edge {
        std::array<std::size_t, 2> ends{};
        bool fixed = false;
    };
    struct Side {
        std::size_t edge = 0;
        bool along = true;  ///< from the edge's first end to its second
    };
    struct Body {
        std::vector<std::size_t> faces;
        std::string words;  ///< behind the faces
    };
    std::string opening;
    std::string top;
    std::map<std::string, double> parameters;
    std::vector<Vertex> vertices;
    std::vector<Edge> edges;
    std::vector<std::array<Side, 3>> faces;
    std::vector<Body> bodies;

    /// First vertices of a face's sides.
    [[nodiscard]] std::array<std::size_t, 3> cornersOf(std::size_t face) const
    {
        std::array<std::size_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Side& side = faces.at(face)[k];
            corners[k] = edges.at(side.edge).ends[side.along ? 0 : 1];
        }
        return corners;
    }
    /// 0 if the file states none.
    [[nodiscard]] double groundAt(std::size_t vertex) const
    {
        const std::string& words = vertices.at(vertex).words;
        const std::size_t at = words.find("ground ");
        return at == std::string::npos ? 0.0 : std::stod(words.substr(at + 7));
    }
};

/// Calls line(words) for every line of a section; lines begin with their numbers, from 1.
template <class Line>
void forLines(const std::string& text, const std::string& section, const Line& line)
{
    const std::size_t begin = text.find("\n" + section + "\n");
    ASSERT_NE(begin, std::string::npos);
    std::string lines = text.substr(begin + section.size() + 2);
    lines.resize(std::min(lines.find("\n\n"), lines.size()));
    for (std::size_t at = 0; (at = lines.find("\\\n", at)) != std::string::npos;) {
        lines.replace(at, 2, " ");
    }
    std::istringstream in(lines);
    std::size_t expected = 0;
    for (std::string content; std::getline(in, content);) {
        std::istringstream words(content);
        std::size_t number = 0;
        words >> number;
        ASSERT_EQ(number, ++expected) << section;
        line(words);
    }
}

std::string restOf(std::istringstream& words)
{
    std::string rest;
    std::getline(words, rest);
    return rest;
}

Datafile parsed(const std::string& text)
{
    Datafile file;
    file.opening = text.substr(0, text.find("\n\n"));
    file.top = text.substr(file.opening.size(), text.find("\n\nvertices\n") - file.opening.size());
    std::istringstream top(file.top);
    for (std::string line; std::getline(top, line);) {
        std::array<char, 32> name{};
        double value = 0.0;
        if (std::sscanf(line.c_str(), "parameter %31s = %lf", name.data(), &value) == 2) {
            file.parameters[name.data()] = value;
        }
    }
    forLines(text, "vertices", [&](std::istringstream& words) {
        Vec3 place;
        words >> place.x >> place.y >> place.z;
        file.vertices.push_back({place, restOf(words)});
    });
    forLines(text, "edges", [&](std::istringstream& words) {
        std::size_t a = 0;
        std::size_t b = 0;
        words >> a >> b;
        file.edges.push_back({{a - 1, b - 1}, restOf(words) == " fixed"});
    });
    forLines(text, "faces", [&](std::istringstream& words) {
        auto& face = file.faces.emplace_back();
        for (Datafile::Side& side : face) {
            long edge = 0;
            words >> edge;
            side = {static_cast<std::size_t>(std::abs(edge)) - 1, edge > 0};
        }
        EXPECT_EQ(restOf(words), "");
    });
    forLines(text, "bodies", [&](std::istringstream& words) {
        auto& body = file.bodies.emplace_back();
        for (std::size_t face = 0; words >> face;) {
            body.faces.push_back(face - 1);
        }
        words.clear();
        body.words = restOf(words);
    });
    return file;
}

/// Energy, height and volumes, computed from the file's numbers by the definitions in its opening comments: quadrature
/// at the edges' middles, exact for quadratics.
Statement recomputed(const Datafile& file)
{
    Statement statement;
    const double weight = file.parameters.at("weight");
    const Vec2 pull{file.parameters.at("pull_x"), file.parameters.at("pull_y")};
    for (const Datafile::Body& body : file.bodies) {
        double volume = 0.0;
        for (const std::size_t face : body.faces) {
            const auto corners = file.cornersOf(face);
            std::array<Vec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = file.vertices[corners[k]].place;
            }
            const Vec3 normal = 0.5 * cross(p[1] - p[0], p[2] - p[0]);
            statement.energy += length(normal);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t next = (k + 1) % 3;
                const Vec3 middle = 0.5 * (p[k] + p[next]);
                const double h = 0.5 * (file.groundAt(corners[k]) + file.groundAt(corners[next]));
                statement.energy += normal.z / 3.0 *
                                    (0.5 * weight * (middle.z * middle.z - h * h) -
                                     (pull.x * middle.x + pull.y * middle.y) * (middle.z - h));
                volume += normal.z / 3.0 * (middle.z - h);
            }
        }
        statement.volumes.push_back(volume);
    }
    for (std::size_t v = 0; v < file.vertices.size(); ++v) {
        statement.height = std::max(statement.height, file.vertices[v].place.z - file.groundAt(v));
    }
    return statement;
}

/// Droplets with given heights.
struct Droplets {
    std::vector<PlanarMesh> meshes;
    std::vector<CapillarySurface> fields;
    SolveOptions options;

    [[nodiscard]] std::string written() const
    {
        std::ostringstream out;
        const std::uint64_t bytes = writeEvolver(out, fields, options);
        EXPECT_TRUE(out.good());
        EXPECT_EQ(bytes, out.str().size());
        return out.str();
    }
};

using Function = std::function<double(Vec2)>;

/// Ground of a given height, whose slope does not count.
BaseSurface groundOf(const Function& height)
{
    return BaseSurface([height](Vec2 p) { return GroundPoint{height(p), {}}; });
}

/// Field of a given thickness, without the results of solving.
CapillarySurface fieldOf(const PlanarMesh& mesh, const Function& thickness, const BaseSurface& ground = {})
{
    std::vector<double> heights;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec2 p = mesh.vertices[v];
        heights.push_back((mesh.onRim(v) ? 0.0 : thickness(p)) + ground.at(p).height);
    }
    return testing::fieldOn(mesh, heights);
}

/// A square with a hole and a disc beside it, 10 mm and 4 mm wide, with all forces and a curved ground.
Droplets awkwardDroplets(FillSharing sharing)
{
    const auto square = [](double half) {
        return polygonLoop({{-half, -half}, {half, -half}, {half, half}, {-half, half}});
    };
    Domain domain = domainOf(square(5e-3), {reversed(square(2e-3))});
    Loop disc = ellipseLoop(2e-3, 2e-3);
    for (Vec2& p : disc.points) {
        p.x += 9e-3;
    }
    domain.droplets.push_back({disc, {}});
    Droplets droplets;
    droplets.meshes = triangulate(domain, {.edge = 1e-3});
    droplets.options.tilt = 100.0 * kDegree;  // beyond vertical: gravity also pulls away from the ground
    droplets.options.tilt_direction = 20.0 * kDegree;
    droplets.options.fill.sharing = sharing;
    droplets.options.ground = groundOf([](Vec2 p) { return 1e-4 * std::sin(1e3 * p.x) - 20.0 * p.y * p.y; });
    for (const PlanarMesh& mesh : droplets.meshes) {
        droplets.fields.push_back(fieldOf(
            mesh, [](Vec2 p) { return 1e-3 * (1.0 + 0.3 * std::cos(700.0 * (p.x - p.y))); }, droplets.options.ground));
        droplets.fields.back().pressure = 36.4 * static_cast<double>(droplets.fields.size());
    }
    return droplets;
}

TEST(Evolver, DatafileHasTheTriangulation)
{
    const Droplets droplets = awkwardDroplets(FillSharing::Each);
    const Datafile file = parsed(droplets.written());
    std::size_t vertex = 0;
    std::size_t face = 0;
    for (std::size_t k = 0; k < droplets.meshes.size(); ++k) {
        const PlanarMesh& mesh = droplets.meshes[k];
        const std::size_t first = vertex;
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v, ++vertex) {
            const Datafile::Vertex& written = file.vertices.at(vertex);
            // The unit of length is 10 mm or 1 mm.
            const double unit = std::abs(written.place.x) > 0.0 ? mesh.vertices[v].x / written.place.x : 1e-2;
            EXPECT_NEAR(unit, 1e-2, 1e-16);
            EXPECT_NEAR(written.place.y, 1e2 * mesh.vertices[v].y, 1e-15);
            EXPECT_NEAR(written.place.z, 1e2 * droplets.fields[k].vertices[v].z, 1e-16);
            EXPECT_NEAR(file.groundAt(vertex), 1e2 * testing::groundAt(droplets.fields[k], v, droplets.options.ground),
                        1e-16);
            EXPECT_EQ(written.words.find(" fixed") != std::string::npos, mesh.onRim(v)) << written.words;
        }
        for (const Triangle& t : mesh.triangles) {
            const auto corners = file.cornersOf(face);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_EQ(corners[i], first + t[i]);
                const Datafile::Side& side = file.faces[face][i];
                EXPECT_EQ(file.edges.at(side.edge).ends[side.along ? 1 : 0], first + t[(i + 1) % 3]);
            }
            ++face;
        }
    }
    EXPECT_EQ(vertex, file.vertices.size());
    EXPECT_EQ(face, file.faces.size());
    // The droplets are a ring and a disc.
    EXPECT_EQ(file.vertices.size() + file.faces.size() - file.edges.size(), 0U + 1U);
}

TEST(Evolver, DatafileHasEveryEdgeOnceAndRimsFixed)
{
    const Datafile file = parsed(awkwardDroplets(FillSharing::Each).written());
    std::vector<std::array<std::size_t, 2>> uses(file.edges.size());
    for (const auto& face : file.faces) {
        for (const Datafile::Side& side : face) {
            ++uses.at(side.edge)[side.along ? 0 : 1];
        }
    }
    std::set<std::array<std::size_t, 2>> seen;
    for (std::size_t e = 0; e < uses.size(); ++e) {
        const auto [a, b] = file.edges[e].ends;
        EXPECT_TRUE(seen.insert({std::min(a, b), std::max(a, b)}).second);
        EXPECT_LE(uses[e][0], 1U);
        EXPECT_LE(uses[e][1], 1U);
        EXPECT_EQ(uses[e][0] + uses[e][1], file.edges[e].fixed ? 1U : 2U);
    }
}

class EvolverSharing : public ::testing::TestWithParam<FillSharing> {};

INSTANTIATE_TEST_SUITE_P(Both, EvolverSharing, ::testing::Values(FillSharing::Each, FillSharing::Total));

TEST_P(EvolverSharing, DatafileStatesWhatItHolds)
{
    const Droplets droplets = awkwardDroplets(GetParam());
    const Datafile file = parsed(droplets.written());
    const std::size_t bodies = GetParam() == FillSharing::Each ? 2 : 1;
    ASSERT_EQ(file.bodies.size(), bodies);
    std::vector<std::size_t> faces;
    for (const Datafile::Body& body : file.bodies) {
        faces.insert(faces.end(), body.faces.begin(), body.faces.end());
    }
    std::vector<std::size_t> all(file.faces.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(faces, all);

    const Statement stated = statementIn(file.opening);
    const Statement found = recomputed(file);
    EXPECT_NEAR(stated.energy, found.energy, 1e-13 * std::abs(found.energy));
    EXPECT_EQ(stated.height, found.height);
    ASSERT_EQ(stated.volumes.size(), bodies);
    for (std::size_t b = 0; b < bodies; ++b) {
        EXPECT_NEAR(stated.volumes[b], found.volumes[b], 1e-13 * found.volumes[b]);
        // λ·(unit of length)/σ = 36.4·(b+1)·1e-2/0.0728
        EXPECT_NEAR(stated.pressures[b], 5.0 * static_cast<double>(b + 1), 1e-13);
        double constant = 0.0;
        double volume = 0.0;
        ASSERT_EQ(
            std::sscanf(file.bodies[b].words.c_str(), "volume %lf volconst %lf density weight", &volume, &constant), 2)
            << file.bodies[b].words;
        EXPECT_EQ(volume, stated.volumes[b]);
    }
}

TEST(Evolver, DatafileGivesFactorsToSi)
{
    Droplets droplets = awkwardDroplets(FillSharing::Total);
    const std::string text = droplets.written();
    double energy_factor = 0.0;
    double pressure_factor = 0.0;
    double height_factor = 0.0;
    double volume_factor = 0.0;
    ASSERT_EQ(std::sscanf(text.substr(text.find("energy * ")).c_str(),
                          "energy * %lf J, pressure * %lf Pa\n//   height * %lf m, volume * %lf m3", &energy_factor,
                          &pressure_factor, &height_factor, &volume_factor),
              4);
    const Statement stated = statementIn(text.substr(0, text.find("\n\n")));
    double volume = 0.0;
    double energy = 0.0;
    double height = 0.0;
    const double sigma = droplets.options.liquid.surface_tension;
    const double weight = droplets.options.liquid.density * droplets.options.gravity;
    for (std::size_t k = 0; k < droplets.meshes.size(); ++k) {
        const PlanarMesh& mesh = droplets.meshes[k];
        const CapillarySurface& field = droplets.fields[k];
        for (const Triangle& t : mesh.triangles) {
            const double third = doubleArea(mesh, t) / 6.0;
            std::array<Vec3, 3> p;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = {mesh.vertices[t[i]].x, mesh.vertices[t[i]].y, field.vertices[t[i]].z};
                height = std::max(height, testing::thicknessAt(field, t[i], droplets.options.ground));
            }
            energy += 0.5 * sigma * length(cross(p[1] - p[0], p[2] - p[0]));
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3;
                const Vec3 m = 0.5 * (p[i] + p[j]);
                const double h = 0.5 * (testing::groundAt(field, t[i], droplets.options.ground) +
                                        testing::groundAt(field, t[j], droplets.options.ground));
                const double downhill =
                    m.x * std::cos(droplets.options.tilt_direction) + m.y * std::sin(droplets.options.tilt_direction);
                volume += third * (m.z - h);
                energy += third * weight *
                          (0.5 * std::cos(droplets.options.tilt) * (m.z * m.z - h * h) -
                           std::sin(droplets.options.tilt) * downhill * (m.z - h));
            }
        }
    }
    EXPECT_NEAR(energy_factor * stated.energy, energy, 1e-13 * std::abs(energy));
    EXPECT_NEAR(pressure_factor * stated.pressures.at(0), 36.4, 1e-13 * 36.4);
    EXPECT_NEAR(height_factor * stated.height, height, 1e-13 * height);
    EXPECT_NEAR(volume_factor * stated.volumes.at(0), volume, 1e-13 * volume);
}

TEST(Evolver, DatafileHasOnlyTheForcesThatAct)
{
    Droplets droplets = awkwardDroplets(FillSharing::Each);
    droplets.options.tilt = 0.0;
    droplets.options.ground = {};
    const Datafile level = parsed(droplets.written());
    EXPECT_EQ(level.top.find("tilt"), std::string::npos);
    EXPECT_EQ(level.top.find("constraint"), std::string::npos);
    EXPECT_EQ(level.parameters.at("ground_energy"), 0.0);
    EXPECT_GT(level.parameters.at("weight"), 0.0);
    for (const Datafile::Vertex& vertex : level.vertices) {
        EXPECT_THAT(vertex.words, ::testing::AnyOf("", " fixed"));
    }
    droplets.options.no_penetration = true;
    const Datafile one_sided = parsed(droplets.written());
    EXPECT_THAT(one_sided.top, HasSubstr("constraint 1 nonnegative\nformula: z = ground"));
    for (const Datafile::Vertex& vertex : one_sided.vertices) {
        EXPECT_THAT(vertex.words, ::testing::AnyOf(" constraint 1", " fixed"));
    }
}

TEST(Evolver, RefusesInconsistentInput)
{
    const Droplets good = awkwardDroplets(FillSharing::Each);
    const auto refusal = [](const Droplets& droplets) {
        std::ostringstream out;
        try {
            writeEvolver(out, droplets.fields, droplets.options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_EQ(out.str(), "");
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal({{}, {}, good.options}), "surfaces must hold at least one droplet");
    Droplets bad = good;
    bad.fields[1].vertices.pop_back();
    EXPECT_THAT(refusal(bad), HasSubstr("triangles of its own vertices"));
    bad = good;
    bad.fields[1].contact_angle.pop_back();
    EXPECT_THAT(refusal(bad), HasSubstr("a contact angle for every rim vertex"));
    bad = good;
    bad.fields[0].vertices.back().z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(bad), "surfaces[0] must be finite");
    bad = good;
    bad.options.liquid.surface_tension = 0.0;
    EXPECT_NE(refusal(bad), "");
}

/// Evolver's results for droplets and commands.
Statement evolved(const Droplets& droplets, const std::string& commands)
{
    const ScratchDirectory scratch;
    testing::writeFile(scratch.path() / "droplets.fe", droplets.written());
    CommandOptions session;
    session.input = commands + "\nq\nq\n";
    session.directory = scratch.path();
    session.environment = {{"HOME", scratch.path()}};  // Evolver keeps a history of commands there
    const CommandResult result = runProgram({"evolver", "droplets.fe"}, session);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.error, "");
    EXPECT_THAT(result.output, ::testing::Not(HasSubstr("ERROR")));
    return statementIn(result.output);
}

TEST_P(EvolverSharing, EvolverFindsWhatTheDatafileStates)
{
    const Droplets droplets = awkwardDroplets(GetParam());
    const Statement stated = statementIn(parsed(droplets.written()).opening);
    const Statement found = evolved(droplets, "report");
    EXPECT_NEAR(found.energy, stated.energy, 1e-13 * std::abs(stated.energy));
    EXPECT_EQ(found.height, stated.height);
    ASSERT_EQ(found.volumes.size(), stated.volumes.size());
    for (std::size_t b = 0; b < found.volumes.size(); ++b) {
        EXPECT_NEAR(found.volumes[b], stated.volumes[b], 1e-13 * stated.volumes[b]);
    }
}

/// A disc of radius 1 with σ = ρ = 1, lengths in metres, and a start with a volume of about that much.
Droplets unitDisc(double volume, double edge)
{
    Droplets droplets;
    droplets.options.liquid = {"unit", 1.0, 1.0};
    droplets.options.gravity = 0.0;
    droplets.meshes = triangulate(domainOf(ellipseLoop(1.0, 1.0)), {.edge = edge});
    droplets.fields = {fieldOf(droplets.meshes[0], [&](Vec2 p) { return 2.0 / kPi * volume * (1.0 - dot(p, p)); })};
    return droplets;
}

// The spherical cap: V = πh(3+h²)/6, area π(1+h²), λ = 4h/(1+h²).
TEST(Evolver, EvolverMakesASphericalCap)
{
    std::vector<std::array<double, 3>> errors;
    for (const double edge : {0.1, 0.05}) {
        const Droplets droplets = unitDisc(1.0, edge);
        const Statement found = evolved(droplets, "equilibrate; report");
        const double volume = statementIn(parsed(droplets.written()).opening).volumes.at(0);
        EXPECT_NEAR(found.volumes.at(0), volume, 1e-12);
        double h = 0.5;
        for (int k = 0; k < 20; ++k) {
            h -= (kPi * h * (3.0 + h * h) / 6.0 - volume) / (0.5 * kPi * (1.0 + h * h));
        }
        errors.push_back({std::abs(found.height - h), std::abs(found.energy - kPi * (1.0 + h * h)),
                          std::abs(found.pressures.at(0) - 4.0 * h / (1.0 + h * h))});
    }
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(std::log2(errors[0][k] / errors[1][k]), 1.8) << k << " " << errors[0][k] << " " << errors[1][k];
    }
}

/// Area of the polygon that approximates the disc of area π.
double footprintOf(const Droplets& droplets)
{
    return area(droplets.meshes[0]);
}

// On an upright wall −Δu = λ + sx, whose solution is (1 − r²)(λ/4 + sx/8); the energy of small slopes with it.
TEST(Evolver, EvolverSagsOnAWall)
{
    constexpr double kPull = 0.1;
    constexpr double kVolume = 0.02;
    for (const double direction : {0.0, 130.0}) {
        Droplets droplets = unitDisc(kVolume, 0.06);
        droplets.options.gravity = kPull;
        droplets.options.tilt = 90.0 * kDegree;
        droplets.options.tilt_direction = direction * kDegree;
        const Statement found = evolved(droplets, "equilibrate; report");
        const double pressure = 8.0 * kVolume / kPi;
        const double energy = 0.5 * pressure * kVolume - kPull * kPull * kPi / 192.0;
        EXPECT_NEAR(found.energy - footprintOf(droplets), energy, 0.02 * energy) << direction;
        EXPECT_NEAR(found.pressures.at(0), pressure, 0.01 * pressure) << direction;
    }
}

// u = c(1 − I₀(kr)/I₀(k)) on the ground and c(J₀(kr)/J₀(k) − 1) below a ceiling, k² = ρ|g|/σ and λ = k²c.
TEST(Evolver, EvolverStandsAndHangs)
{
    constexpr double kVolume = 0.02;
    constexpr double k = 1.5;
    Droplets droplets = unitDisc(kVolume, 0.06);
    droplets.options.gravity = k * k;
    const double standing = 0.5 - std::cyl_bessel_i(1, k) / (k * std::cyl_bessel_i(0, k));
    const double hanging = std::cyl_bessel_j(1, k) / (k * std::cyl_bessel_j(0, k)) - 0.5;
    const auto pressure = [&](double shape) { return k * k * kVolume / (2.0 * kPi * shape); };
    EXPECT_NEAR(evolved(droplets, "equilibrate; report").pressures.at(0), pressure(standing),
                0.01 * pressure(standing));
    droplets.options.tilt = 180.0 * kDegree;
    EXPECT_NEAR(evolved(droplets, "equilibrate; report").pressures.at(0), pressure(hanging), 0.01 * pressure(hanging));
}

// Raising the ground by c changes only the zero of heights: E by wcV, λ by wc.
TEST(Evolver, EvolverKnowsWhatLiesUnderTheGround)
{
    constexpr double kRaised = 0.7;
    std::array<Statement, 2> found;
    double weight = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        Droplets droplets = unitDisc(0.4, 0.1);
        droplets.options.gravity = 2.0;
        droplets.options.tilt = 40.0 * kDegree;
        droplets.options.ground =
            groundOf([i](Vec2 p) { return 0.1 * p.x * p.x - 0.2 * p.y + (i == 0 ? 0.0 : kRaised); });
        droplets.fields = {fieldOf(
            droplets.meshes[0], [](Vec2 p) { return 0.3 * (1.0 - dot(p, p)); }, droplets.options.ground)};
        found[i] = evolved(droplets, "equilibrate; report");
        weight = parsed(droplets.written()).parameters.at("weight");
    }
    EXPECT_NEAR(weight, 2.0 * std::cos(40.0 * kDegree), 1e-14);
    const double volume = found[0].volumes.at(0);
    EXPECT_NEAR(found[1].volumes.at(0), volume, 1e-12);
    EXPECT_NEAR(found[1].energy - found[0].energy, weight * kRaised * volume, 1e-10);
    EXPECT_NEAR(found[1].pressures.at(0) - found[0].pressures.at(0), weight * kRaised, 1e-9);
    EXPECT_NEAR(found[1].height, found[0].height, 1e-9);
}

// A ground that rises into the liquid: with the constraint no vertex is below it, without it some are.
TEST(Evolver, EvolverKeepsAboveTheGround)
{
    Droplets droplets = unitDisc(0.1, 0.1);
    droplets.options.ground = groundOf([](Vec2 p) { return 0.5 * std::pow(1.0 - dot(p, p), 2.0); });
    droplets.fields = {fieldOf(
        droplets.meshes[0], [](Vec2 p) { return 0.1 * (1.0 - dot(p, p)); }, droplets.options.ground)};
    const std::string commands = "equilibrate; printf \"energy %g height 0\\n\", min(vertex, z - ground)";
    EXPECT_LT(evolved(droplets, commands).energy, -0.01);
    droplets.options.no_penetration = true;
    EXPECT_NEAR(evolved(droplets, commands).energy, 0.0, 1e-12);
}

/// Forces on a droplet of water.
struct Situation {
    const char* name;
    double gravity = 0.0;
    double tilt = 0.0;  ///< [deg]
    BaseSurface ground;
    double volume = 0.0;  ///< [m³]
    FillSharing sharing = FillSharing::Each;

    friend void PrintTo(const Situation& situation, std::ostream* out) { *out << situation.name; }
};

class EvolverAndUs : public ::testing::TestWithParam<Situation> {};

const BaseSurface kWavyGround([](Vec2 p) {
    const double k = 900.0;
    return GroundPoint{
        2e-4 * std::sin(k * p.x) * std::cos(k * p.y),
        {2e-4 * k * std::cos(k * p.x) * std::cos(k * p.y), -2e-4 * k * std::sin(k * p.x) * std::sin(k * p.y)}};
});

INSTANTIATE_TEST_SUITE_P(Situations, EvolverAndUs,
                         ::testing::Values(Situation{"Weightless", 0.0, 0.0, {}, 40e-9},
                                           Situation{"Standing", 9.81, 0.0, {}, 40e-9},
                                           Situation{"OnASlope", 9.81, 50.0, {}, 30e-9},
                                           Situation{"Hanging", 9.81, 180.0, {}, 20e-9},
                                           Situation{"OnWavesOnAWall", 9.81, 90.0, kWavyGround, 28e-9},
                                           Situation{"Sharing", 9.81, 20.0, kWavyGround, 50e-9, FillSharing::Total}),
                         [](const ::testing::TestParamInfo<Situation>& info) { return info.param.name; });

// A square, 8 mm wide, and in the last situation a disc beside it. Evolver starts at the linear model's heights and
// reaches those of the exact model within the tolerance of Newton's method.
TEST_P(EvolverAndUs, FindTheSameEquilibrium)
{
    const Situation& situation = GetParam();
    Domain domain = domainOf(polygonLoop({{-4e-3, -4e-3}, {4e-3, -4e-3}, {4e-3, 4e-3}, {-4e-3, 4e-3}}));
    if (situation.sharing == FillSharing::Total) {
        Loop disc = ellipseLoop(3e-3, 3e-3);
        for (Vec2& p : disc.points) {
            p.x += 9e-3;
        }
        domain.droplets.push_back({disc, {}});
    }
    Droplets droplets;
    droplets.meshes = triangulate(domain, {.edge = 3e-4});
    droplets.options.gravity = situation.gravity;
    droplets.options.tilt = situation.tilt * kDegree;
    droplets.options.ground = situation.ground;
    droplets.options.fill = {FillBy::Volume, situation.volume, situation.sharing};
    droplets.fields = solve(droplets.meshes, droplets.options).droplets;
    ASSERT_EQ(droplets.fields.size(), droplets.meshes.size());
    const Statement theirs = evolved(droplets, "equilibrate; report");
    const Statement start = statementIn(parsed(droplets.written()).opening);

    droplets.options.model = Model::Exact;
    droplets.fields = solve(droplets.meshes, droplets.options).droplets;
    ASSERT_EQ(droplets.fields.size(), droplets.meshes.size());
    const Statement ours = statementIn(parsed(droplets.written()).opening);
    EXPECT_NEAR(ours.energy, theirs.energy, 1e-12 * std::abs(theirs.energy));
    EXPECT_NEAR(ours.height, theirs.height, 1e-8 * theirs.height);
    EXPECT_NEAR(ours.volumes.at(0), theirs.volumes.at(0), 1e-10 * theirs.volumes.at(0));
    EXPECT_NEAR(ours.pressures.at(0), theirs.pressures.at(0), 1e-8 * std::abs(theirs.pressures.at(0)));
    // The start differs from the solution.
    EXPECT_GT(start.energy, theirs.energy + 1e-7 * std::abs(theirs.energy));
}

// Beads, and a corner where liquid leans over and lies on the ground: in the file, the sheet is in equilibrium.
TEST(Evolver, EvolverAgreesOnSheets)
{
    struct Bead {
        const char* name;
        Loop rim;
        double degrees;
        double tilt;
        BaseSurface ground;
    };
    const double side = 3e-3;
    const std::vector<Bead> beads{
        {"disc", ellipseLoop(2e-3, 2e-3), 130.0, 0.0, {}},
        {"disc on a ball", ellipseLoop(2e-3, 2e-3), 110.0, 10.0, BaseSurface::sphere(6e-3)},
        {"square on a slope", polygonLoop({{0, 0}, {side, 0}, {side, side}, {0, side}}), 100.0, 20.0, {}},
        {"corner",
         polygonLoop({{0, 0}, {2 * side, 0}, {2 * side, side}, {side, side}, {side, 2 * side}, {0, 2 * side}}),
         70.0,
         0.0,
         {}}};
    for (const Bead& bead : beads) {
        SCOPED_TRACE(bead.name);
        Droplets droplets;
        droplets.meshes = triangulate(domainOf(bead.rim), {.edge = 2.5e-4});
        droplets.options.model = Model::Exact;
        droplets.options.tilt = bead.tilt * kDegree;
        droplets.options.ground = bead.ground;
        droplets.options.fill = {FillBy::ContactAngle, bead.degrees * kDegree, FillSharing::Each};
        SheetResult result = solveSheet(droplets.meshes.front(), droplets.options);
        ASSERT_EQ(result.end, SheetEnd::Reached);
        droplets.fields = {std::move(result.surface)};
        const Statement ours = statementIn(parsed(droplets.written()).opening);
        const Statement theirs = evolved(droplets, "equilibrate; report");
        EXPECT_NEAR(ours.energy, theirs.energy, 1e-9 * std::abs(theirs.energy));
        EXPECT_NEAR(ours.height, theirs.height, 1e-6 * theirs.height);
        EXPECT_NEAR(ours.volumes.at(0), theirs.volumes.at(0), 1e-10 * theirs.volumes.at(0));
        EXPECT_NEAR(ours.pressures.at(0), theirs.pressures.at(0), 1e-6 * std::abs(theirs.pressures.at(0)));
    }
}

// A large disc on a steep slope is dry at its upper end. Dry vertices stay fixed; between them and the rim Evolver must
// find the same heights, none below the ground.
TEST(Evolver, EvolverAgreesWhereTheGroundIsDry)
{
    Droplets droplets;
    droplets.meshes = triangulate(domainOf(ellipseLoop(15e-3, 15e-3)), {.edge = 1e-3});
    droplets.options.tilt = 60.0 * kDegree;
    droplets.options.model = Model::Exact;
    droplets.options.no_penetration = true;
    droplets.options.fill = {FillBy::Volume, 50e-9, FillSharing::Each};
    droplets.fields = solve(droplets.meshes, droplets.options).droplets;
    ASSERT_EQ(droplets.fields.size(), 1U);
    ASSERT_FALSE(droplets.fields[0].dry.empty());
    const Statement ours = statementIn(parsed(droplets.written()).opening);
    const Statement theirs = evolved(droplets, "equilibrate; report");
    EXPECT_NEAR(ours.energy, theirs.energy, 1e-10 * std::abs(theirs.energy));
    EXPECT_NEAR(ours.pressures.at(0), theirs.pressures.at(0), 1e-8 * std::abs(theirs.pressures.at(0)));
}

}  // namespace
}  // namespace droplet
