// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "colour_shape.h"
#include "droplet/error.h"
#include "droplet/footprint/colour_regions.h"
#include "droplet_report.h"
#include "file_droplets.h"
#include "mask.h"
#include "mask_shape.h"
#include "materials_file.h"
#include "option_values.h"
#include "shape_options.h"
#include "surroundings.h"
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
    std::optional<droplet::ObjectReport> onto;
    if (around.object) {
        onto = cli::placeOnObject(made.droplet, *around.object, *settings.onto);
    }
    return Droplet::make(std::move(made.droplet), settings, {std::move(made.input), std::move(onto), made.colours},
                         clock);
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
    if (auto warning = cli::maskWarning(mask, "look at the array of the mask")) {
        settings.warnings.insert(settings.warnings.begin(), std::move(*warning));
    }
    std::optional<droplet::ObjectReport> onto;
    if (around.object) {
        onto = cli::placeOnObject(made.droplet, *around.object, *settings.onto);
    }
    return Droplet::make(std::move(made.droplet), settings, {std::move(made.input), std::move(onto)}, clock);
}

std::shared_ptr<Droplet> makeFrom(const py::handle& from, const Arguments& arguments)
{
    cli::StageClock clock;
    clock.begin(droplet::Stage::Read);
    Arguments all = arguments;
    all.insert(all.end(), {"INPUT", "droplet.glb"});
    auto options = parsed(cli::parseShape, all);
    return options.footprint.by_colour ? makeByColour(pngOf(from), std::move(options), clock)
                                       : makeOfMask(maskOf(from), std::move(options), clock);
}

/// Writes the droplets to a file.
void saveDroplet(const Droplet& self, const SaveOptions& options, const std::string& nodes,
                 const std::optional<std::filesystem::path>& materials)
{
    std::optional<cli::Materials> read;
    if (materials) {
        read = cli::readMaterials(materials->string());
    }
    const auto in_file =
        cli::choice<droplet::Nodes>({nodes, "nodes"}, {{"one", droplet::Nodes::One}, {"each", droplet::Nodes::Each}});
    std::vector<std::string> warnings;
    const auto droplets = cli::fileDroplets(self.droplets(), {materialOf(self, options), in_file, read}, warnings);
    for (const py::handle& warning : warningsOf(warnings)) {
        if (PyErr_WarnEx(PyExc_UserWarning, std::string(py::str(warning)).c_str(), 1) != 0) {
            throw py::error_already_set();
        }
    }
    saveSurface(self, options, in_file, droplets);
}

}  // namespace

std::shared_ptr<Droplet> Droplet::make(droplet::Droplet droplet, const cli::DropletSettings& settings,
                                       DropletSource source, cli::StageClock& clock)
{
    droplet::Report report = cli::describe(droplet, settings);
    report.input = std::move(source.input);
    report.onto = std::move(source.onto);
    for (std::size_t k = 0; k < source.colours.size(); ++k) {
        report.droplets[k].colour = source.colours[k];
    }
    report.time = clock.times();
    report.time_total = clock.total();
    report.peak_memory = cli::peakMemory();
    return std::shared_ptr<Droplet>(new Droplet(std::move(droplet.surface), settings.material, std::move(report)));
}

std::string Droplet::json() const
{
    droplet::Report report = report_;
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
            [](const Droplet& self, std::filesystem::path path, std::optional<std::string> material, std::string unit,
               std::string compress, const std::string& nodes, const std::optional<std::filesystem::path>& materials,
               bool no_clobber) {
                saveDroplet(self,
                            {std::move(path), std::move(material), std::move(unit), std::move(compress), no_clobber},
                            nodes, materials);
            },
            py::arg("path"), py::kw_only(), py::arg("material") = py::none(), py::arg("unit") = "mm",
            py::arg("compress") = "none", py::arg("nodes") = "one", py::arg("materials") = py::none(),
            py::arg("no_clobber") = false,
            R"(Writes the droplets to a file, completely or not at all.

path        ends in .glb, .gltf, .obj (with its .mtl), .ply, .stl, .usda or .usdz
material    water, ink, mercury, honey or plain: the look in glTF, OBJ and USD,
            below the colours of by_colour [the liquid's own]
unit        m, cm or mm: unit of length in OBJ and STL
compress    none, quantize or meshopt: compression of a .glb
nodes       one, or each for a node of every droplet in glTF and USD, with its
            figures
materials   TOML file with a material, colour, roughness or index of refraction
            for single droplets
no_clobber  refuse to replace a file

Warns if materials names a droplet that does not exist. Raises InvalidArgument
for another extension, OutputFailed if the file cannot be written.)");

    module.def("make_droplet",
               [](const py::handle& mask, const Arguments& arguments) { return makeFrom(mask, arguments); });
}

}  // namespace binding
