// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/image/css_colour.h"
#include "droplet/io/report.h"
#include "droplet_options.h"
#include "stage_clock.h"
#include "surface.h"
#include "surroundings.h"

namespace binding {

/// Origin of droplets.
struct DropletSource {
    droplet::InputReport input;
    const cli::Surroundings& around;
    std::vector<droplet::CssColour> colours = {};  ///< one per droplet, or none
};

/// What a surface lies on; nothing if the ground is flat.
/// @param settings  with the ground, and the object's file if there is one
/// @param extent    of the picture [m]
std::shared_ptr<const Stand> standOf(const cli::DropletSettings& settings, const cli::Surroundings& around,
                                     droplet::Vec2 extent);

/// Droplet with its report.
class Droplet : public Surface {
public:
    /// Lays a droplet on its object, if it has one.
    /// @param droplet   its surface becomes the base
    /// @param settings  settings that it was made with
    /// @param source    for the report
    /// @param clock     for the report
    /// @throws droplet::Error  as cli::placeOnObject
    static std::shared_ptr<Droplet> make(droplet::Droplet droplet, const cli::DropletSettings& settings,
                                         DropletSource source, cli::StageClock& clock);

    /// Droplet with the state of another.
    /// @throws droplet::Error  InvalidArgument: the surface is not valid
    static std::shared_ptr<Droplet> ofState(const pybind11::handle& state);

    /// State for pickle.
    [[nodiscard]] pybind11::object state() const;

    /// Names, looks and figures of the droplets in a file, as in WriteOptions. Warns in Python.
    /// @param material   of the file
    /// @param nodes      name in Python
    /// @param materials  path of a file of materials
    /// @throws droplet::Error InvalidArgument, InvalidInput
    [[nodiscard]] std::vector<droplet::FileDroplet> inFile(
        droplet::Material material, droplet::Nodes nodes,
        const std::optional<std::filesystem::path>& materials = {}) const;

    [[nodiscard]] std::vector<droplet::Look> looks() const override;

    /// Report as JSON, with the schema droplet-shape.report/1.
    [[nodiscard]] std::string json() const;

private:
    using Reports = std::vector<droplet::DropletReport>;

    Droplet(SurfaceParts parts, std::shared_ptr<const Stand> stand, std::variant<droplet::Report, std::string> report,
            Reports droplets)
        : Surface(std::move(parts), std::move(stand)), report_(std::move(report)), droplets_(std::move(droplets))
    {
    }

    std::variant<droplet::Report, std::string> report_;  ///< without output; or its JSON, from a state
    Reports droplets_;                                   ///< from a state: what files need of them
};

/// Adds droplets to the module.
void bindShape(pybind11::module_& module);

}  // namespace binding
