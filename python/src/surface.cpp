// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <utility>

#include "droplet/io/output.h"
#include "files.h"
#include "option_values.h"
#include "surface_files.h"

namespace binding {
namespace {

namespace py = pybind11;

// Views need arrays of plain numbers without gaps.
static_assert(sizeof(droplet::Vec3) == 3 * sizeof(double));
static_assert(sizeof(droplet::Vec2) == 2 * sizeof(double));
static_assert(sizeof(droplet::Triangle) == 3 * sizeof(std::uint32_t));

/// Read-only array that shares the memory of a vector.
/// @param owner  Python object that owns the vector; the array keeps it alive
template <typename Number, typename Item>
py::array viewOf(const std::vector<Item>& items, const py::object& owner)
{
    constexpr auto kColumns = static_cast<py::ssize_t>(sizeof(Item)) / static_cast<py::ssize_t>(sizeof(Number));
    const auto rows = static_cast<py::ssize_t>(items.size());
    std::vector<py::ssize_t> shape{rows};
    if constexpr (kColumns > 1) {
        shape.push_back(kColumns);
    }
    // Without a pointer NumPy allocates, so an empty vector gets a pointer, too.
    static const Number nothing{};
    const void* data = items.empty() ? static_cast<const void*>(&nothing) : items.data();
    py::array view(py::dtype::of<Number>(), shape, {}, data, owner);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

/// Property that is a view of a member of the surface.
template <typename Number, typename Item>
auto view(std::vector<Item> droplet::Surface::*member)
{
    return [member](const py::object& self) {
        return viewOf<Number>(self.cast<const Surface&>().surface().*member, self);
    };
}

}  // namespace

droplet::Material materialOf(const Surface& surface, const SaveOptions& options)
{
    return options.material ? cli::forOption("material", [&] { return droplet::materialNamed(*options.material); })
                            : surface.material();
}

void saveSurface(const Surface& surface, const SaveOptions& options, droplet::Nodes nodes,
                 const std::vector<droplet::FileDroplet>& droplets)
{
    const py::gil_scoped_release release;
    using droplet::LengthUnit;
    const std::string path = options.path.string();
    cli::SurfaceTarget target{path, droplet::Format::Glb, {}};
    target.format =
        cli::forOption("path: '" + path + "'", [&] { return droplet::formatNamed(options.path.extension().string()); });
    target.options.material = materialOf(surface, options);
    target.options.unit = cli::choice<LengthUnit>(
        {options.unit, "unit"},
        {{"m", LengthUnit::Metre}, {"cm", LengthUnit::Centimetre}, {"mm", LengthUnit::Millimetre}});
    target.options.nodes = nodes;
    target.options.droplets = droplets;
    target.options.compression =
        cli::forOption("compress", [&] { return droplet::compressionNamed(options.compress); });
    std::uint64_t bytes = 0;
    cli::writeTogether(cli::surfaceFiles(surface.surface(), target, bytes), {options.no_clobber});
}

py::object reportOf(const char* name, const std::string& json)
{
    return py::module_::import("droplet_shape._reports").attr(name).attr("from_json")(json);
}

py::tuple warningsOf(const std::vector<std::string>& warnings)
{
    const py::object in_python = py::module_::import("droplet_shape._errors").attr("in_python");
    py::tuple lines(warnings.size());
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        lines[i] = in_python(warnings[i]);
    }
    return lines;
}

void bindSurface(py::module_& module)
{
    py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface",
                                                  R"(A triangle mesh in space: metres, z up.

The arrays share the memory of the mesh. They are read-only, and stay valid
after the surface is deleted.)")
        .def_property_readonly("vertices", view<double>(&droplet::Surface::positions),
                               "Places of the vertices [m]: an (n, 3) array of float64, z up. A vertex that needs two "
                               "normals, as on the rim, is there twice; see weld.")
        .def_property_readonly("triangles", view<std::uint32_t>(&droplet::Surface::triangles),
                               "Vertices of the triangles, counter-clockwise from outside: an (m, 3) array of uint32.")
        .def_property_readonly("normals", view<double>(&droplet::Surface::normals),
                               "Outward normals of the vertices, of length 1: an (n, 3) array of float64.")
        .def_property_readonly("uv", view<double>(&droplet::Surface::uvs),
                               "Texture coordinates: an (n, 2) array of float64; (0, 0) is the top left of the mask, "
                               "(1, 1) the bottom right.")
        .def_property_readonly("contact_angle", view<float>(&droplet::Surface::contact_angle),
                               "Contact angles at the liquid's vertices on the rim [rad], 0 at all others: an (n,) "
                               "array of float32. Empty if the surface has none.")
        .def_property_readonly("weld", view<std::uint32_t>(&droplet::Surface::weld),
                               "Smallest index of a vertex at the same place: an (n,) array of uint32.")
        .def_property_readonly(
            "warnings", [](const Surface& self) { return warningsOf(self.warnings()); },
            "Warnings, one line each, the grave ones first.")
        .def(
            "save",
            [](const Surface& self, std::filesystem::path path, std::optional<std::string> material, std::string unit,
               std::string compress, bool no_clobber) {
                saveSurface(self,
                            {std::move(path), std::move(material), std::move(unit), std::move(compress), no_clobber});
            },
            py::arg("path"), py::kw_only(), py::arg("material") = py::none(), py::arg("unit") = "mm",
            py::arg("compress") = "none", py::arg("no_clobber") = false,
            R"(Writes the surface to a file, completely or not at all.

path        ends in .glb, .gltf, .obj (with its .mtl), .ply, .stl, .usda or .usdz
material    water, ink, mercury, honey or plain: the look in glTF, OBJ and USD
            [the liquid's own]
unit        m, cm or mm: unit of length in OBJ and STL
compress    none, quantize or meshopt: compression of a .glb
no_clobber  refuse to replace a file

Raises InvalidArgument for another extension, OutputFailed if the file cannot
be written.)")
        .def("__repr__", [](const py::object& self) {
            const auto& surface = self.cast<const Surface&>().surface();
            return "<" + std::string(py::str(py::type::of(self).attr("__name__"))) + " of " +
                   std::to_string(surface.triangles.size()) + " triangles>";
        });
}

}  // namespace binding
