// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/c/droplet.h"
#include "droplet/error.h"
#include "droplet/io/object.h"
#include "droplet/surface/textured_mesh.h"
#include "droplet/units.h"

namespace binding {
namespace {

namespace py = pybind11;

void check(DropletCode code)
{
    constexpr std::array kCodes{
        std::pair{DROPLET_INVALID_ARGUMENT, droplet::ErrorCode::InvalidArgument},
        std::pair{DROPLET_INVALID_INPUT, droplet::ErrorCode::InvalidInput},
        std::pair{DROPLET_OUTPUT_FAILED, droplet::ErrorCode::OutputFailed},
        std::pair{DROPLET_NO_SUCH_DROPLET, droplet::ErrorCode::NoSuchDroplet},
    };
    for (const auto& [known, thrown] : kCodes) {
        if (code == known) {
            throw droplet::Error(thrown, droplet_message());
        }
    }
    if (code == DROPLET_OUT_OF_MEMORY) {
        throw std::bad_alloc();
    }
    if (code != DROPLET_OK) {
        throw std::runtime_error(droplet_message());
    }
}

droplet::Dimension dimensionOf(std::string_view name)
{
    using droplet::Dimension;
    constexpr std::array kDimensions{
        std::pair{std::string_view("speed"), Dimension::Speed},
        std::pair{std::string_view("rain"), Dimension::Rainfall},
        std::pair{std::string_view("noise"), Dimension::Acceleration},
        std::pair{std::string_view("wiper-period"), Dimension::Duration},
        std::pair{std::string_view("gravity"), Dimension::Acceleration},
        std::pair{std::string_view("contact-angle"), Dimension::Angle},
        std::pair{std::string_view("viscosity-factor"), Dimension::Viscosity},
        std::pair{std::string_view("runoff"), Dimension::Duration},
        std::pair{std::string_view("mist"), Dimension::Rainfall},
        std::pair{std::string_view("slope"), Dimension::Angle},
    };
    const auto* const found =
        std::find_if(kDimensions.begin(), kDimensions.end(), [&](const auto& entry) { return entry.first == name; });
    return found != kDimensions.end() ? found->second : Dimension::Length;
}

/// Rain on a windshield, with the texture that it draws.
class Windshield {
public:
    explicit Windshield(const std::string& preset) { check(droplet_windshield_new(preset.c_str(), &made_)); }
    ~Windshield() { droplet_windshield_delete(made_); }
    Windshield(const Windshield&) = delete;
    Windshield& operator=(const Windshield&) = delete;

    /// Gives the glass the shape of a mesh.
    void setSurface(const std::filesystem::path& path)
    {
        const droplet::TexturedMesh object = droplet::readObject(path);
        std::vector<float> positions;
        std::vector<float> normals;
        std::vector<float> uvs;
        for (std::size_t k = 0; k < object.vertices.size(); ++k) {
            const auto add = [](std::vector<float>& list, double number) {
                list.push_back(static_cast<float>(number));
            };
            for (const auto member : {&droplet::Vec3::x, &droplet::Vec3::y, &droplet::Vec3::z}) {
                add(positions, object.vertices[k].*member);
                add(normals, object.normals[k].*member);
            }
            add(uvs, object.uvs[k].x);
            add(uvs, object.uvs[k].y);
        }
        std::vector<std::uint32_t> indices;
        for (const droplet::Triangle& triangle : object.triangles) {
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        }
        const DropletMesh mesh{object.vertices.size(),  positions.data(), normals.data(), uvs.data(), nullptr,
                               object.triangles.size(), indices.data()};
        check(droplet_windshield_surface(made_, &mesh));
    }

    void set(const py::kwargs& parameters)
    {
        for (const auto& [key, value] : parameters) {
            const std::string name = named(py::str(key));
            check(droplet_windshield_set(made_, name.c_str(),
                                         py::isinstance<py::str>(value)
                                             ? droplet::parseQuantity(std::string(py::str(value)), dimensionOf(name))
                                             : value.cast<double>()));
        }
    }

    [[nodiscard]] double get(const std::string& name) const
    {
        double value = 0.0;
        check(droplet_windshield_get(made_, named(name).c_str(), &value));
        return value;
    }

    void advance(double seconds)
    {
        const py::gil_scoped_release release;
        check(droplet_windshield_advance(made_, seconds));
    }

    void spray(double x, double y, double radius, double volume)
    {
        const DropletSpray spray{x, y, radius, volume};
        check(droplet_windshield_spray(made_, &spray));
    }

    void finger(std::pair<double, double> from, std::pair<double, double> to, double width)
    {
        const DropletStroke stroke{from.first, from.second, to.first, to.second, width};
        check(droplet_windshield_finger(made_, &stroke));
    }

    [[nodiscard]] DropletWindshieldFigures figures() const
    {
        DropletWindshieldFigures figures{};
        check(droplet_windshield_figures(made_, &figures));
        return figures;
    }

    [[nodiscard]] DropletWater water() const
    {
        DropletWater water{};
        check(droplet_windshield_water(made_, &water));
        return water;
    }

    [[nodiscard]] py::array_t<DropletRunning> running() const
    {
        const std::size_t count = droplet_windshield_running(made_, nullptr, 0);
        py::array_t<DropletRunning> droplets(static_cast<py::ssize_t>(count));
        droplet_windshield_running(made_, droplets.mutable_data(), count);
        return droplets;
    }

    /// The texture, and the tiles of it that have changed.
    py::tuple draw(std::int32_t width)
    {
        if (!pixels_ || pixels_.shape(1) != width) {
            std::int32_t height = 0;
            check(droplet_windshield_map_height(made_, width, &height));
            pixels_ = py::array(py::dtype("e"), {height, width, 4});
        }
        DropletTiles tiles{};
        check(droplet_windshield_draw(made_, width, static_cast<std::uint16_t*>(pixels_.mutable_data()), &tiles));
        py::list changed;
        for (std::size_t k = 0; k < tiles.count; ++k) {
            const DropletTile& tile = tiles.list[k];
            changed.append(py::make_tuple(tile.x, tile.y, tile.width, tile.height));
        }
        return py::make_tuple(pixels_, changed);
    }

    py::array mist()
    {
        DropletMistMap map{};
        check(droplet_windshield_mist(made_, &map));
        return py::array_t<std::uint8_t>({map.height, map.width}, map.pixels);
    }

    py::array runoff()
    {
        DropletMistMap map{};
        check(droplet_windshield_runoff(made_, &map));
        return py::array_t<std::uint8_t>({map.height, map.width}, map.pixels);
    }

private:
    /// Python's names have underscores.
    static std::string named(std::string name)
    {
        std::replace(name.begin(), name.end(), '_', '-');
        return name;
    }

    DropletWindshield* made_ = nullptr;
    py::array pixels_ = py::reinterpret_borrow<py::array>(py::handle());
};

}  // namespace

void bindWindshield(py::module_& module)
{
    PYBIND11_NUMPY_DTYPE(DropletRunning, id, x, y, vx, vy, volume, radius);
    py::class_<DropletWindshieldFigures>(module, "WindshieldFigures", "Figures of a Windshield, in SI units.")
        .def_readonly("time", &DropletWindshieldFigures::time, "Time since the start [s].")
        .def_readonly("speed", &DropletWindshieldFigures::speed, "Speed of the car now [m/s].")
        .def_readonly("width", &DropletWindshieldFigures::width, "Width of the unrolled glass [m].")
        .def_readonly("height", &DropletWindshieldFigures::height, "Height of the unrolled glass [m].")
        .def_readonly("running", &DropletWindshieldFigures::running, "Number of droplets that are large enough to run.")
        .def_readonly("still", &DropletWindshieldFigures::still, "Number of droplets that are not.")
        .def_readonly("raindrops", &DropletWindshieldFigures::raindrops,
                      "Number of raindrops that have met the glass.");
    py::class_<DropletWater>(module, "WindshieldWater", "Water of a Windshield, in SI units.")
        .def_readonly("volume", &DropletWater::volume, "Volume on the glass [m³].")
        .def_readonly("balance_error", &DropletWater::balance_error,
                      "Water that appeared or vanished, over all that has come.");
    py::class_<Windshield>(module, "Windshield",
                           R"(Rain on a windshield that advances with your frames.

preset      figure-3.10, figure-3.11 or figure-3.12 of the thesis
surface     file of the glass, as of windshield(); otherwise it is bent as a
            cylinder, whose parameters a file does not have
parameters  as of set()

Positions are on the unrolled glass: x to the driver's right, y up the glass
[m]. For files and films there is windshield().)")
        .def(py::init([](const std::string& preset, const std::optional<std::filesystem::path>& surface,
                         const py::kwargs& parameters) {
                 auto made = std::make_unique<Windshield>(preset);
                 if (surface) {
                     made->setSurface(*surface);
                 }
                 made->set(parameters);
                 return made;
             }),
             py::arg("preset") = "figure-3.12", py::arg("surface") = py::none())
        .def("set", &Windshield::set,
             R"(Sets parameters, at any time; those of the glass and the seed only before the
first step. Numbers are in SI units, texts have a unit: speed="50km/h".

speed, rain, noise, wiper_period, seed, gravity, contact_angle, hysteresis,
kinetic_fraction, viscosity_factor, film, still_diameter, runoff, mist,
splashes, glass_width, glass_height, glass_radius, slope: docs/engines.md has their ranges.)")
        .def("get", &Windshield::get, py::arg("name"), "Value of a parameter of set().")
        .def("advance", &Windshield::advance, py::arg("seconds"),
             "Advances the rain by a time [s]; at most 1/30 is advised.")
        .def("spray", &Windshield::spray, py::arg("x"), py::arg("y"), py::arg("radius") = 0.1, py::arg("volume") = 5e-7,
             "Sprays water [m³] onto a place; it meets the glass in the next step.")
        .def("finger", &Windshield::finger, py::arg("start"), py::arg("end"), py::arg("width") = 0.014,
             "Moves a finger over the glass: it takes mist and droplets, and leaves beads beside its path.")
        .def_property_readonly("figures", &Windshield::figures, "Time, speed, size of the glass and counts.")
        .def_property_readonly("water", &Windshield::water,
                               "Volume of the water, and its balance; sums up all droplets.")
        .def_property_readonly("running", &Windshield::running,
                               "Droplets that are large enough to run: an array with id, x, y, vx, vy, volume, radius.")
        .def_property_readonly("mist", &Windshield::mist, "Mist as bytes, upper row first; 1 x 1 without mist.")
        .def_property_readonly("runoff", &Windshield::runoff,
                               "Film that runs off, as bytes of 2 um, upper row first; 1 x 1 without a film.")
        .def("draw", &Windshield::draw, py::arg("width") = 1024,
             R"(Brings the texture up to the state.

Returns it and the tiles that have changed, as (x, y, width, height) in pixels.
The texture is an array of float16, height x width x 4, and the same each time:
x and y of the water's normal times the wetness, thickness in mm, wetness.)");
}

}  // namespace binding
