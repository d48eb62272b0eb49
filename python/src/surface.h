// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/io/object.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"
#include "droplet/surface/textured_mesh.h"

namespace binding {

/// Object or curved ground below a surface, for pictures.
struct Stand {
    droplet::TexturedMesh mesh;
    bool is_object = false;  ///< false: curved ground
    std::string path = {};   ///< of the object's file
    droplet::ObjectOptions reading = {};
};

/// Parts of a Surface.
struct SurfaceParts {
    droplet::Surface surface;
    droplet::Material material = droplet::Material::Water;
    std::vector<std::string> warnings = {};
};

/// Surface that Python holds, with what its files and its picture need. It does not change after it was made, because
/// arrays in Python share its memory.
class Surface {
public:
    /// @param stand  nothing if the ground is flat; frames share it
    Surface(SurfaceParts parts, std::shared_ptr<const Stand> stand) : parts_(std::move(parts)), stand_(std::move(stand))
    {
    }
    virtual ~Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    [[nodiscard]] const SurfaceParts& parts() const { return parts_; }
    [[nodiscard]] const std::shared_ptr<const Stand>& stand() const { return stand_; }
    [[nodiscard]] const droplet::Surface& surface() const { return parts_.surface; }
    [[nodiscard]] droplet::Material material() const { return parts_.material; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return parts_.warnings; }

    /// Looks of single droplets; empty if all have that of the material.
    [[nodiscard]] virtual std::vector<droplet::Look> looks() const { return {}; }

private:
    SurfaceParts parts_;
    std::shared_ptr<const Stand> stand_;
};

/// What save() and to_bytes() in Python have in common.
struct SaveOptions {
    std::optional<std::string> format;    ///< empty: by the extension of the path
    std::optional<std::string> material;  ///< empty: the surface's own
    std::string unit = "mm";
    std::string compress = "none";
    droplet::Nodes nodes = droplet::Nodes::One;
    std::vector<droplet::FileDroplet> droplets = {};  ///< as in WriteOptions
    bool droplets_only = false;                       ///< leave out the object that they lie on
};

/// Material of a file.
/// @throws droplet::Error InvalidArgument
droplet::Material materialOf(const Surface& surface, const std::optional<std::string>& name);

/// Writes a surface to a file, completely or not at all, or to a file object. Other threads of Python run meanwhile.
/// @param file            path, or an object with a method `write`
/// @throws droplet::Error InvalidArgument, OutputFailed
void saveSurface(const Surface& surface, const pybind11::object& file, const SaveOptions& options, bool no_clobber);

/// Bytes of a file in the options' format.
/// @throws droplet::Error InvalidArgument
pybind11::bytes bytesOf(const Surface& surface, const SaveOptions& options);

/// Whether an object takes bytes, as a file that is open does.
bool isFileObject(const pybind11::object& file);

/// Path of a file; TypeError in Python for an object that is none.
std::filesystem::path pathOf(const pybind11::object& file);

/// State of parts for pickle.
pybind11::object stateOf(const SurfaceParts& parts);

/// State of a stand for pickle; None for nothing.
pybind11::object stateOf(const std::shared_ptr<const Stand>& stand);

/// Parts of a state.
/// @throws droplet::Error InvalidArgument: the surface is not valid
SurfaceParts partsOf(const pybind11::handle& state);

/// Stand of a state.
/// @throws droplet::Error InvalidArgument: it is not valid
std::shared_ptr<const Stand> standOf(const pybind11::handle& state);

/// Object of the package's reports from JSON text.
/// @param name  class of droplet_shape._reports
pybind11::object reportOf(const char* name, const std::string& json);

/// Tuple of warnings, with the names that options have in Python.
pybind11::tuple warningsOf(const std::vector<std::string>& warnings);

/// Adds the class Surface to the module.
void bindSurface(pybind11::module_& module);

}  // namespace binding
