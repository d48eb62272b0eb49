// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "body/body_grid.h"
#include "droplet/body/droplet_body.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"

namespace droplet {

/// Droplets of least energy over a family of footprints, from a table of elongations and Bond numbers. Slopes need no
/// table, because the solved heights are linear in them.
class CapillaryBody {
public:
    /// Solves the table.
    /// @param model  valid
    explicit CapillaryBody(const ForceModel& model);

    /// Elongation at a speed, 0 … 1.
    [[nodiscard]] double elongation(double volume, double speed) const;
    /// Shape of a droplet, of any size.
    [[nodiscard]] BodyGrid shape(const BodyConditions& conditions) const;

private:
    static constexpr std::size_t kElongations = 7;
    static constexpr std::size_t kBonds = 15;
    using Field = std::array<double, kBodyVertices>;

    /// Solved droplet, in units of the radius of a disc with the footprint's area. Its heights w are (1 − ρ²) q.
    struct Entry {
        Field level;            ///< q on level ground
        Field along;            ///< change of q per slope to +x
        Field aside;            ///< change of q per slope to +y
        double ahead = 0.0;     ///< limit of slopes to +x
        double behind = 0.0;    ///< limit of slopes to −x
        double sideways = 0.0;  ///< limit of slopes to ±y
        double growth = 1.0;    ///< square of the size over that of the spherical cap with the same radius and volume
    };
    /// Places on the ground, in units of the radius of the disc.
    struct Base {
        std::array<Vec2, kBodySlices> rim;
        double height = 1.0;  ///< half the largest width: there the cross-section is a segment with the contact angle
        std::array<double, kBodyRings> radii;  ///< ρ of the rings
    };
    /// Entries at one elongation.
    struct Row {
        std::array<Vec2, kBodySlices> rim;
        double height = 1.0;  ///< half the largest width: there the cross-section is a segment with the contact angle
        std::array<Entry, kBonds> entries;
        std::array<double, kBonds> cap_bonds;  ///< Bond numbers by the contact radius of the spherical cap, rising
    };

    /// Sets the Bond numbers of the caps, by the heights of round droplets.
    void calibrate(double angle);
    void scale(Row& row) const;
    void limitSlopes(const Row& row, const std::array<double, kBodyRings>& radii, Entry& entry) const;
    void place(BodyGrid& grid, const Base& footprint, const Field& q) const;

    double tangent_ = 0.0;      ///< tan(θ/2)
    double cap_radius_ = 0.0;   ///< contact radius of a cap with volume 1
    double weight_ = 0.0;       ///< ρ/σ
    double wedge_speed_ = 0.0;  ///< σ/ηf; infinite without viscosity
    double slope_share_ = 0.0;  ///< slope in the table's units per Bond number along the ground
    std::array<std::array<double, kBodyRings>, kBonds> radii_;  ///< ρ of the rings at each Bond number
    std::array<double, kBonds> bonds_;                          ///< Bond numbers of the table, rising
    std::vector<Row> rows_;
};

}  // namespace droplet
