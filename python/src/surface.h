// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/surface/material.h"
#include "droplet/surface/surface.h"

namespace binding {

/// Surface that Python holds, with what its files need. It does not change after it was made, because arrays in Python
/// share its memory.
class Surface {
public:
    Surface(droplet::Surface surface, droplet::Material material, std::vector<std::string> warnings)
        : surface_(std::move(surface)), material_(material), warnings_(std::move(warnings))
    {
    }
    virtual ~Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    [[nodiscard]] const droplet::Surface& surface() const { return surface_; }
    [[nodiscard]] droplet::Material material() const { return material_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

private:
    droplet::Surface surface_;
    droplet::Material material_;
    std::vector<std::string> warnings_;
};

/// Arguments of save() in Python.
struct SaveOptions {
    std::filesystem::path path;
    std::optional<std::string> material;  ///< empty: the surface's own
    std::string unit = "mm";
    std::string compress = "none";
    bool no_clobber = false;
};

/// Material of a file.
/// @throws droplet::Error InvalidArgument
droplet::Material materialOf(const Surface& surface, const SaveOptions& options);

/// Writes a surface to a file, completely or not at all. Other threads of Python run meanwhile.
/// @param droplets        as in WriteOptions
/// @throws droplet::Error InvalidArgument, OutputFailed
void saveSurface(const Surface& surface, const SaveOptions& options, droplet::Nodes nodes = droplet::Nodes::One,
                 const std::vector<droplet::FileDroplet>& droplets = {});

/// Object of the package's reports from JSON text.
/// @param name  class of droplet_shape._reports
pybind11::object reportOf(const char* name, const std::string& json);

/// Tuple of warnings, with the names that options have in Python.
pybind11::tuple warningsOf(const std::vector<std::string>& warnings);

/// Adds the class Surface to the module.
void bindSurface(pybind11::module_& module);

}  // namespace binding
