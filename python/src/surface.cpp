// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "droplet/io/output.h"
#include "droplet/render/object_stand.h"
#include "files.h"
#include "option_values.h"
#include "preview.h"
#include "state.h"
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

/// Corners of the quadrilaterals.
py::array_t<std::uint32_t> quadsOf(const Surface& self)
{
    const droplet::Surface& surface = self.surface();
    const std::vector<std::uint32_t> first = droplet::quadrilaterals(surface);
    py::array_t<std::uint32_t> quads({static_cast<py::ssize_t>(first.size()), py::ssize_t{4}});
    auto corners = quads.mutable_unchecked<2>();
    for (py::ssize_t q = 0; q < corners.shape(0); ++q) {
        const std::uint32_t t = first[static_cast<std::size_t>(q)];
        const auto& [a, b, c] = surface.triangles[t];
        corners(q, 0) = a;
        corners(q, 1) = b;
        corners(q, 2) = c;
        corners(q, 3) = surface.triangles[t + 1][2];
    }
    return quads;
}

/// Options of the library for those of Python.
droplet::WriteOptions writeOptions(const Surface& surface, const SaveOptions& options)
{
    using droplet::LengthUnit;
    droplet::WriteOptions write;
    write.material = materialOf(surface, options.material);
    write.unit = cli::choice<LengthUnit>(
        {options.unit, "unit"},
        {{"m", LengthUnit::Metre}, {"cm", LengthUnit::Centimetre}, {"mm", LengthUnit::Millimetre}});
    write.nodes = options.nodes;
    write.droplets = options.droplets;
    write.compression = cli::forOption("compress", [&] { return droplet::compressionNamed(options.compress); });
    return write;
}

droplet::Format formatOf(const SaveOptions& options)
{
    if (!options.format) {
        cli::refuse("format: a file object has no extension; give its format, such as glb");
    }
    return cli::forOption("format", [&] { return droplet::formatNamed(*options.format); });
}

/// The object that a file has below the droplets, read anew; nothing if it has none.
/// @throws droplet::Error InvalidInput
std::optional<droplet::ObjectStand> objectFor(const Surface& surface, droplet::Format format,
                                              const SaveOptions& options)
{
    const auto& stand = surface.stand();
    if (!stand || !stand->is_object || options.droplets_only || !droplet::isAnimated(format)) {
        return std::nullopt;
    }
    return cli::forOption("onto", [&] { return droplet::readObjectStand(stand->path, stand->reading); });
}

/// Picture in a notebook, as PNG; None for a surface without triangles.
py::object pictureOf(const Surface& self)
{
    constexpr int kWidth = 640;
    constexpr int kHeight = 480;
    if (self.surface().triangles.empty()) {
        return py::none();
    }
    std::ostringstream png;
    {
        const py::gil_scoped_release release;
        cli::PreviewOptions options;
        options.width = kWidth;
        options.height = kHeight;
        cli::PreviewSubject subject{self.surface(), droplet::lookOf(self.material()), self.looks(), {}, {}, {}, {}, {}};
        subject.by_colour = !subject.looks.empty();
        if (const auto& stand = self.stand(); stand && stand->is_object) {
            subject.object = droplet::ObjectStand{stand->mesh};
        } else if (stand) {
            subject.curved = stand->mesh;
        }
        cli::previewFiles(options, subject).front().write(png);
    }
    return py::bytes(png.str());
}

}  // namespace

template <>
struct Members<droplet::RefillState> {
    static constexpr std::tuple list{&droplet::RefillState::fill, &droplet::RefillState::vertices,
                                     &droplet::RefillState::normals};
};

template <>
struct Members<droplet::Refill> {
    static constexpr std::tuple list{&droplet::Refill::min, &droplet::Refill::max, &droplet::Refill::states};
};

template <>
struct Members<droplet::Surface> {
    static constexpr std::tuple list{&droplet::Surface::vertices,    &droplet::Surface::normals,
                                     &droplet::Surface::uvs,         &droplet::Surface::contact_angle,
                                     &droplet::Surface::triangles,   &droplet::Surface::weld,
                                     &droplet::Surface::texture_map, &droplet::Surface::mean_height,
                                     &droplet::Surface::refill,      &droplet::Surface::parts};
};

template <>
struct Members<droplet::TexturedMesh> {
    static constexpr std::tuple list{&droplet::TexturedMesh::vertices, &droplet::TexturedMesh::normals,
                                     &droplet::TexturedMesh::uvs, &droplet::TexturedMesh::triangles};
};

template <>
struct Members<droplet::ObjectOptions> {
    static constexpr std::tuple list{&droplet::ObjectOptions::scale, &droplet::ObjectOptions::size,
                                     &droplet::ObjectOptions::up, &droplet::ObjectOptions::weights};
};

template <>
struct Members<Stand> {
    static constexpr std::tuple list{&Stand::mesh, &Stand::is_object, &Stand::path, &Stand::reading};
};

template <>
struct Members<SurfaceParts> {
    static constexpr std::tuple list{&SurfaceParts::surface, &SurfaceParts::material, &SurfaceParts::warnings};
};

py::object stateOf(const SurfaceParts& parts)
{
    return stateOf<SurfaceParts>(parts);
}

py::object stateOf(const std::shared_ptr<const Stand>& stand)
{
    return stand ? stateOf(*stand) : py::none();
}

SurfaceParts partsOf(const py::handle& state)
{
    auto parts = valueOf<SurfaceParts>(state);
    if (!parts.surface.triangles.empty()) {
        parts.surface.validate();
    }
    return parts;
}

std::shared_ptr<const Stand> standOf(const py::handle& state)
{
    if (state.is_none()) {
        return nullptr;
    }
    auto stand = std::make_shared<const Stand>(valueOf<Stand>(state));
    stand->mesh.validate();
    return stand;
}

droplet::Material materialOf(const Surface& surface, const std::optional<std::string>& name)
{
    return name ? cli::forOption("material", [&] { return droplet::materialNamed(*name); }) : surface.material();
}

bool isFileObject(const py::object& file)
{
    return py::hasattr(file, "write");
}

std::filesystem::path pathOf(const py::object& file)
{
    return py::module_::import("os").attr("fspath")(file).cast<std::filesystem::path>();
}

py::bytes bytesOf(const Surface& surface, const SaveOptions& options)
{
    std::ostringstream out;
    {
        const py::gil_scoped_release release;
        const droplet::Format format = formatOf(options);
        const auto object = objectFor(surface, format, options);
        std::uint64_t bytes = 0;
        cli::surfaceFiles(surface.surface(), {"", format, writeOptions(surface, options), object ? &*object : nullptr},
                          bytes)
            .front()
            .write(out);
    }
    return out.str();
}

void saveSurface(const Surface& surface, const py::object& file, const SaveOptions& options, bool no_clobber)
{
    if (isFileObject(file)) {
        file.attr("write")(bytesOf(surface, options));
        return;
    }
    const auto path = pathOf(file);
    const py::gil_scoped_release release;
    const std::string name = path.string();
    const auto format = options.format ? formatOf(options) : cli::forOption("path: '" + name + "'", [&] {
        return droplet::formatNamed(path.extension().string());
    });
    const auto object = objectFor(surface, format, options);
    std::uint64_t bytes = 0;
    cli::writeTogether(
        cli::surfaceFiles(surface.surface(),
                          {name, format, writeOptions(surface, options), object ? &*object : nullptr}, bytes),
        {no_clobber});
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
        .def_property_readonly("vertices", view<double>(&droplet::Surface::vertices),
                               "Places of the vertices [m]: an (n, 3) array of float64, z up. A vertex that needs two "
                               "normals, as on the rim, is there twice; see weld.")
        .def_property_readonly("triangles", view<std::uint32_t>(&droplet::Surface::triangles),
                               "Vertices of the triangles, counter-clockwise from outside: an (m, 3) array of uint32.")
        .def_property_readonly("quads", &quadsOf,
                               "Vertices of the quadrilaterals that pairs of triangles make with the option quads, "
                               "counter-clockwise from outside: a (q, 4) array of uint32, a copy.")
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
            [](const Surface& self, const py::object& path, std::optional<std::string> format,
               std::optional<std::string> material, std::string unit, std::string compress, bool no_clobber) {
                saveSurface(self, path, {std::move(format), std::move(material), std::move(unit), std::move(compress)},
                            no_clobber);
            },
            py::arg("path"), py::kw_only(), py::arg("format") = py::none(), py::arg("material") = py::none(),
            py::arg("unit") = "mm", py::arg("compress") = "none", py::arg("no_clobber") = false,
            R"(Writes the surface to a file, completely or not at all, or to a file object.

path        ends in .glb, .gltf, .obj (with its .mtl), .ply, .stl, .usda or
            .usdz; or an object that is open for bytes, such as io.BytesIO()
format      glb, gltf, obj, ply, stl, usda, usdz or 3mf; a file object needs it [by
            the path]
material    water, glass, gold or another look, in glTF, OBJ and USD [the
            liquid's own]
unit        m, cm or mm: unit of length in OBJ and STL
compress    none, quantize or meshopt: compression of a .glb
no_clobber  refuse to replace a file

Raises InvalidArgument for another extension or format, OutputFailed if the
file cannot be written.)")
        .def(
            "to_bytes",
            [](const Surface& self, std::string format, std::optional<std::string> material, std::string unit,
               std::string compress) {
                return bytesOf(self, {std::move(format), std::move(material), std::move(unit), std::move(compress)});
            },
            py::arg("format") = "glb", py::kw_only(), py::arg("material") = py::none(), py::arg("unit") = "mm",
            py::arg("compress") = "none",
            R"(Bytes of a file. The arguments are those of save().

Raises InvalidArgument for another format.)")
        .def("_repr_png_", &pictureOf, "Picture for notebooks, 640 x 480 pixels, as PNG.")
        .def(py::pickle(
            [](const Surface& self) { return pickled(py::make_tuple(stateOf(self.parts()), stateOf(self.stand()))); },
            [](const py::tuple& pickle) {
                const py::tuple states = unpickled(pickle);
                return std::make_shared<Surface>(partsOf(states[0]), standOf(states[1]));
            }))
        .def("__repr__", [](const py::object& self) {
            const auto& surface = self.cast<const Surface&>().surface();
            return "<" + std::string(py::str(py::type::of(self).attr("__name__"))) + " of " +
                   std::to_string(surface.triangles.size()) + " triangles>";
        });
}

}  // namespace binding
