// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// Values on the nodes of a grid that covers liquid on its way: above one half in it, below outside.
class MorphField {
public:
    /// @param lower, upper  box that the grid covers
    /// @param cell          side of its cells
    MorphField(Vec2 lower, Vec2 upper, double cell);

    /// Adds `weight` times the share of the area around each node that particles cover.
    /// @param area    of a particle
    /// @param radius  of the kernel, in which the share is measured
    struct Particles {
        std::span<const Vec2> position;
        double area = 0.0;
        double radius = 0.0;
    };
    void add(const Particles& particles, double weight);

    /// Adds `weight` times a ramp over the signed distance from a region's rim, from 0 outside to 1 inside.
    /// @param width  of the ramp
    void add(const Region& region, double width, double weight);

    /// Lets liquid fill slits narrower than a width, and holes of less than that radius, gradually: what is filled
    /// changes with the width without jumps.
    void fill(double width);

    /// Loops around places with more than `level`, but for those that enclose less than `min_area`.
    [[nodiscard]] std::vector<Loop> loops(double level, double min_area) const;

    /// Loops that enclose an area, at the level that gives it.
    [[nodiscard]] std::vector<Loop> loopsOfArea(double area, double min_area) const;

private:
    [[nodiscard]] Vec2 place(int column, int row) const;
    [[nodiscard]] double& at(int column, int row);

    Vec2 lower_;
    double cell_;
    int columns_;
    int rows_;
    std::vector<double> values_;
};

}  // namespace droplet
