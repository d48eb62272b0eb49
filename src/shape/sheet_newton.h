// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "shape/sheet_base.h"
#include "shape/sheet_energy.h"
#include "shape/symmetric_factor.h"

namespace droplet {

/// Limits of Newton's method.
struct NewtonLimits {
    int steps = 14;            ///< most steps
    int shifted_steps = 4;     ///< most steps with a matrix that had to be shifted to have a minimum
    double tolerance = 1e-9;   ///< relative residual at which it ends
    double stagnated = 1e-7;   ///< relative residual that is good enough when steps no longer lower it
    double chord = 0.0;        ///< relative residual from which on steps take the factors of the last one; 0: none do
    double worn = 0.0;         ///< smallest angle of a triangle, over that at the start, below which it ends
    int factorisations = 150;  ///< after which no step begins
    double max_work = std::numeric_limits<double>::infinity();  ///< as of SheetOptions; nothing is factorised beyond
};

/// Result of Newton's method.
struct NewtonResult {
    bool converged = false;  ///< to a minimum of the energy at the given volume
    int steps = 0;
    int factorisations = 0;
    double work = 0.0;            ///< as SheetOptions::max_work
    double residual = 0.0;        ///< relative
    std::vector<Vec3> tangent;    ///< if converged: motion of every vertex per volume [1/m²]
    double pressure_slope = 0.0;  ///< if converged: change of the pressure per volume [1/m⁴]
};

/// Equilibria of sheets with one topology: area and gravity are least at a given volume, and nothing is below the
/// ground.
class SheetSolver {
public:
    /// @param sheet   gives the topology
    /// @param weight  as in integrate()
    /// @param base    what the sheet lies on; volumes are those above it
    SheetSolver(const CapillarySurface& sheet, Vec3 weight, SheetBase base = {});

    /// Moves the vertices inside until the sheet is in equilibrium; the volume is exact in every step.
    /// @param sheet     start, near enough; receives the result, also of a failure
    /// @param volume    [m³]
    /// @param pressure  λ over the surface tension, start and result [1/m]
    NewtonResult solve(CapillarySurface& sheet, double volume, double& pressure, const NewtonLimits& limits = {});

private:
    struct Linear {
        Eigen::VectorXd gradient;  ///< of the energy, g
        Eigen::VectorXd volume;    ///< of the volume, b
        Eigen::VectorXd mass;      ///< area around every vertex
        std::vector<Vec3> directions;
        std::vector<double> clearance;       ///< of every unknown's vertex, above the ground [m]
        std::vector<double> rise;            ///< its change per motion
        Eigen::SparseMatrix<double> matrix;  ///< with rows of held unknowns cleared
        Eigen::SparseMatrix<double> full;    ///< without shift and holding
    };
    struct Step {
        Eigen::VectorXd motion;
        double pressure = 0.0;  ///< change
    };

    /// Newton's method over a base that stays.
    NewtonResult solveOnBase(CapillarySurface& sheet, double volume, double& pressure, const NewtonLimits& limits);
    void linearise(const CapillarySurface& sheet);
    void assemble(const CapillarySurface& sheet, double pressure);
    bool factor(double shift);
    /// Solves for the response to the pressure.
    bool respond();
    /// Step with the last factors.
    [[nodiscard]] std::optional<Step> chord(const CapillarySurface& sheet, double pressure, double missing);
    /// Takes up vertices that a step would move below the ground, and releases those that it would pull up.
    /// @return  whether there are any
    bool changeHeld(const Step& step, const Eigen::VectorXd& forces, bool may_release);
    /// Damps vertices of triangles that a step would turn or squeeze too much.
    /// @return  whether there are any
    bool damp(const CapillarySurface& sheet, const Step& step);
    /// Number of negative eigenvalues of the bordered matrix: 1 at a minimum.
    [[nodiscard]] int negatives() const;
    [[nodiscard]] Step solveBordered(const Eigen::VectorXd& forces, double volume_change) const;
    [[nodiscard]] double residual(double pressure) const;
    /// Integrals over the liquid between a sheet and the base of the current solve().
    [[nodiscard]] SheetIntegrals liquidUnder(const CapillarySurface& sheet) const;
    /// What errors of the volume are relative to [m³].
    [[nodiscard]] double volumeScale(double volume) const;
    /// Work so far in the current solve().
    [[nodiscard]] double workOf(int factorisations, const CapillarySurface& sheet) const;
    /// @param sums  integrals over the sheet, before and after
    bool moveWithin(CapillarySurface& sheet, const Step& step, double volume, SheetIntegrals& sums);
    void describe(NewtonResult& result) const;

    std::uint32_t rim_;
    Vec3 weight_;
    SheetBase base_;
    SheetIntegrals under_ = {};  ///< of the base in the current solve()
    MeshPattern pattern_;
    std::unique_ptr<SymmetricFactor> factor_;
    Linear linear_;
    Eigen::VectorXd response_;                 ///< w = L⁻¹b
    std::vector<std::uint8_t> held_;           ///< unknowns that the ground holds
    std::vector<double> held_motion_;          ///< their motion in the current step
    std::vector<double> damping_;              ///< of every unknown, over its diagonal entry
    std::size_t passes_ = 0;                   ///< integrations over all triangles in the current solve()
    std::vector<std::uint8_t> factored_held_;  ///< held unknowns of the factors; empty if these are of no use any more
    double factored_residual_ = 0.0;           ///< relative residual where they were made
};

/// How far triangles may change.
struct MotionLimits {
    double min_cosine = 0.5;  ///< of the angle by which a triangle turns
    double min_area = 0.2;    ///< after the motion, over that before
    double max_area = 4.0;
};

/// Whether a triangle turns or changes its area within the limits.
bool isGentle(Vec3 area_before, Vec3 area_after, const MotionLimits& limits);

/// Whether all triangles do.
bool isGentle(const CapillarySurface& before, const CapillarySurface& after, const MotionLimits& limits);

}  // namespace droplet
