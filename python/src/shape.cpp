// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arguments.h"
#include "colour_shape.h"
#include "droplet/colours/colour_regions.h"
#include "droplet/error.h"
#include "droplet/render/render.h"
#include "droplet_report.h"
#include "file_droplets.h"
#include "mask.h"
#include "mask_shape.h"
#include "materials_file.h"
#include "option_values.h"
#include "shape_options.h"
#include "state.h"
#include "surroundings.h"
#include "this_process.h"
#include "work.h"

namespace binding {
namespace {

namespace py = pybind11;

/// Makes one droplet for each region of one colour.
std::shared_ptr<Droplet> makeByColour(const std::string& png, cli::ShapeOptions options, cli::StageClock& clock)
{
    const Work work(options.run.threads);
    options.input = "array";
    const droplet::ColourRegions regions = droplet::decodeColours(
        std::as_bytes(std::span(png)),
        {.colours = options.footprint.by_colour->colours, .channel = options.footprint.mask.channel});
    const cli::Surroundings around = cli::readSurroundings(options.settings);
    cli::DropletSettings settings = cli::completeSettings(cli::maskOf(regions), around, options);
    cli::ColourShape made = cli::makeOfColours(regions, settings, options,
                                               [&](droplet::Stage stage, double share) { clock.begin(stage, share); });
    settings.warnings.insert(settings.warnings.begin(), made.warnings.begin(), made.warnings.end());
    return Droplet::make(std::move(made.droplet), settings, {std::move(made.input), around, made.colours}, clock);
}

std::shared_ptr<Droplet> makeOfMask(Mask from, cli::ShapeOptions options, cli::StageClock& clock)
{
    if (options.footprint.mask.channel != droplet::Channel::Auto) {
        throw droplet::Error(droplet::ErrorCode::InvalidArgument,
                             "--channel needs --by-colour: a mask has coverage alone");
    }
    const Work work(options.run.threads);
    droplet::Mask& mask = from.mask;
    options.input = from.path;
    if (from.threshold && !options.footprint.mask.accept_any) {
        options.footprint.trace.threshold = *from.threshold;
    }
    if (options.footprint.mask.invert) {
        cli::invert(mask);
    }
    const cli::Surroundings around = cli::readSurroundings(options.settings);
    cli::DropletSettings settings = cli::completeSettings(mask, around, options);
    cli::MaskShape made = cli::makeOfMask(mask, settings, options,
                                          [&](droplet::Stage stage, double share) { clock.begin(stage, share); });
    for (auto& warning : {cli::maskWarning(mask, "look at the array of the mask"), cli::drawingWarning(mask)}) {
        if (warning) {
            settings.warnings.insert(settings.warnings.begin(), *warning);
        }
    }
    return Droplet::make(std::move(made.droplet), settings, {std::move(made.input), around}, clock);
}

std::shared_ptr<Droplet> makeFrom(const py::handle& from, const Arguments& arguments)
{
    cli::StageClock clock;
    clock.begin(droplet::Stage::Read);
    Arguments all = arguments;
    all.insert(all.end(), {"INPUT", "droplet.glb"});
    auto options = parsed(cli::parseShape, all);
    options.settings.with_object = false;  // save() reads what files need of it
    return options.footprint.by_colour ? makeByColour(pngOf(from), std::move(options), clock)
                                       : makeOfMask(maskOf(from), std::move(options), clock);
}

/// What files say of a droplet.
struct Figures {
    double volume = 0.0;         ///< [m³]
    double contact_angle = 0.0;  ///< mean along the rim [rad]
    double height_max = 0.0;     ///< [m]
    double pressure = 0.0;       ///< [Pa]
    std::optional<droplet::CssColour> colour = {};
};

/// Options of a droplet's file.
SaveOptions optionsOf(const Droplet& self, SaveOptions options, const std::string& nodes,
                      const std::optional<std::filesystem::path>& materials)
{
    options.nodes =
        cli::choice<droplet::Nodes>({nodes, "nodes"}, {{"one", droplet::Nodes::One}, {"each", droplet::Nodes::Each}});
    options.droplets = self.inFile(materialOf(self, options.material), options.nodes, materials);
    return options;
}

}  // namespace

template <>
struct Members<droplet::CssColour> {
    static constexpr std::tuple list{&droplet::CssColour::red, &droplet::CssColour::green, &droplet::CssColour::blue};
};

template <>
struct Members<Figures> {
    static constexpr std::tuple list{&Figures::volume, &Figures::contact_angle, &Figures::height_max,
                                     &Figures::pressure, &Figures::colour};
};

std::shared_ptr<const Stand> standOf(const cli::DropletSettings& settings, const cli::Surroundings& around,
                                     droplet::Vec2 extent)
{
    if (around.object) {
        return std::make_shared<const Stand>(Stand{around.object->mesh, true, settings.onto.value(), settings.reading});
    }
    const droplet::BaseSurface& ground = settings.droplet.solve.ground;
    return ground.flat() ? nullptr : std::make_shared<const Stand>(Stand{droplet::groundMesh(ground, extent), false});
}

std::shared_ptr<Droplet> Droplet::make(droplet::Droplet droplet, const cli::DropletSettings& settings,
                                       DropletSource source, cli::StageClock& clock)
{
    std::optional<droplet::ObjectReport> onto;
    if (source.around.object) {
        onto = cli::placeOnObject(droplet, *source.around.object, settings);
    }
    droplet::Report report = cli::describe(droplet, settings);
    report.input = std::move(source.input);
    report.onto = std::move(onto);
    for (std::size_t k = 0; k < source.colours.size(); ++k) {
        report.droplets[k].colour = source.colours[k];
    }
    report.time = clock.times();
    report.time_total = clock.total();
    report.peak_memory = cli::peakMemory();
    std::vector<droplet::DropletReport> droplets = report.droplets;
    std::vector<std::string> warnings = report.warnings;
    return std::shared_ptr<Droplet>(new Droplet({std::move(droplet.surface), settings.material, std::move(warnings)},
                                                standOf(settings, source.around, droplet.domain.extent),
                                                std::move(report), std::move(droplets)));
}

std::shared_ptr<Droplet> Droplet::ofState(const py::handle& state)
{
    const auto [parts, stand, json, figures] =
        state.cast<std::tuple<py::object, py::object, std::string, py::object>>();
    Reports droplets;
    for (const Figures& each : valueOf<std::vector<Figures>>(figures)) {
        droplet::DropletReport report;
        report.figures.volume = each.volume;
        report.figures.contact_angle.mean = each.contact_angle;
        report.figures.height_max = each.height_max;
        report.pressure = each.pressure;
        report.colour = each.colour;
        droplets.push_back(std::move(report));
    }
    return std::shared_ptr<Droplet>(new Droplet(partsOf(parts), binding::standOf(stand), json, std::move(droplets)));
}

py::object Droplet::state() const
{
    std::vector<Figures> figures;
    for (const droplet::DropletReport& each : droplets_) {
        figures.push_back({each.figures.volume, each.figures.contact_angle.mean, each.figures.height_max, each.pressure,
                           each.colour});
    }
    return py::make_tuple(stateOf(parts()), stateOf(stand()), json(), stateOf(figures));
}

std::vector<droplet::FileDroplet> Droplet::inFile(droplet::Material material, droplet::Nodes nodes,
                                                  const std::optional<std::filesystem::path>& materials) const
{
    std::optional<cli::Materials> read;
    if (materials) {
        read = cli::readMaterials(materials->string());
    }
    std::vector<std::string> warnings;
    auto droplets = cli::fileDroplets(droplets_, {material, nodes, read}, warnings);
    for (const py::handle& warning : warningsOf(warnings)) {
        if (PyErr_WarnEx(PyExc_UserWarning, std::string(py::str(warning)).c_str(), 1) != 0) {
            throw py::error_already_set();
        }
    }
    return droplets;
}

std::vector<droplet::Look> Droplet::looks() const
{
    std::vector<std::string> none;
    return droplet::looksOf(cli::fileDroplets(droplets_, {material(), droplet::Nodes::One, {}}, none));
}

std::string Droplet::json() const
{
    if (const auto* written = std::get_if<std::string>(&report_)) {
        return *written;
    }
    auto report = std::get<droplet::Report>(report_);
    report.output = cli::describeOutput(surface(), "", droplet::Format::Glb);
    std::ostringstream out;
    droplet::writeReport(out, report);
    return std::move(out).str();
}

void bindShape(py::module_& module)
{
    py::class_<Droplet, Surface, std::shared_ptr<Droplet>>(
        module, "Droplet", py::dynamic_attr(),
        R"(Droplets of liquid on one mask or text: a mesh with a report.

Made by make_droplet() and glyphs(); for the arrays see Surface.)")
        .def_property_readonly(
            "report",
            [](const py::object& self) {
                const py::dict cache = self.attr("__dict__");
                if (!cache.contains("_report")) {
                    const auto& droplet = self.cast<const Droplet&>();
                    std::string json;
                    {
                        const py::gil_scoped_release release;
                        json = droplet.json();
                    }
                    cache["_report"] = reportOf("Report", json);
                }
                return py::object(cache["_report"]);
            },
            "Options, results and warnings as a Report, with the names of the command's JSON report. Its output has no "
            "path, format or size, as there is no file.")
        .def(
            "save",
            [](const Droplet& self, const py::object& path, std::optional<std::string> format,
               std::optional<std::string> material, std::string unit, std::string compress, const std::string& nodes,
               const std::optional<std::filesystem::path>& materials, bool droplets_only, bool no_clobber) {
                auto options =
                    optionsOf(self, {std::move(format), std::move(material), std::move(unit), std::move(compress)},
                              nodes, materials);
                options.droplets_only = droplets_only;
                saveSurface(self, path, options, no_clobber);
            },
            py::arg("path"), py::kw_only(), py::arg("format") = py::none(), py::arg("material") = py::none(),
            py::arg("unit") = "mm", py::arg("compress") = "none", py::arg("nodes") = "one",
            py::arg("materials") = py::none(), py::arg("droplets_only") = false, py::arg("no_clobber") = false,
            R"(Writes the droplets to a file, completely or not at all, or to a file object.
A .glb, .gltf, .usda or .usdz has the object of onto with them, which is read
anew; other formats have the droplets alone.

path        ends in .glb, .gltf, .obj (with its .mtl), .ply, .stl, .usda or
            .usdz; or an object that is open for bytes, such as io.BytesIO()
format      glb, gltf, obj, ply, stl, usda, usdz or 3mf; a file object needs it [by
            the path]
material    water, glass, gold or another look, in glTF, OBJ and USD,
            below the colours of by_colour [the liquid's own]
unit        m, cm or mm: unit of length in OBJ and STL
compress    none, quantize or meshopt: compression of a .glb
nodes       one, or each for a node of every droplet in glTF and USD, with its
            figures
materials   TOML file with a material, colour, roughness or index of refraction
            for single droplets
droplets_only  leave the object out
no_clobber  refuse to replace a file

Warns if materials names a droplet that does not exist. Raises InvalidArgument
for another extension or format, OutputFailed if the file cannot be written.)")
        .def(
            "to_bytes",
            [](const Droplet& self, std::string format, std::optional<std::string> material, std::string unit,
               std::string compress, const std::string& nodes, const std::optional<std::filesystem::path>& materials,
               bool droplets_only) {
                auto options =
                    optionsOf(self, {std::move(format), std::move(material), std::move(unit), std::move(compress)},
                              nodes, materials);
                options.droplets_only = droplets_only;
                return bytesOf(self, options);
            },
            py::arg("format") = "glb", py::kw_only(), py::arg("material") = py::none(), py::arg("unit") = "mm",
            py::arg("compress") = "none", py::arg("nodes") = "one", py::arg("materials") = py::none(),
            py::arg("droplets_only") = false,
            R"(Bytes of a file. The arguments are those of save().

Raises InvalidArgument for another format.)")
        .def(py::pickle(
            [](const py::object& self) {
                return pickled(py::make_tuple(self.cast<const Droplet&>().state(), attributesOf(self)));
            },
            [](const py::tuple& pickle) {
                const py::tuple parts = unpickled(pickle);
                return std::pair(Droplet::ofState(parts[0]), parts[1].cast<py::dict>());
            }));

    module.def("make_droplet",
               [](const py::handle& mask, const Arguments& arguments) { return makeFrom(mask, arguments); });
}

}  // namespace binding
