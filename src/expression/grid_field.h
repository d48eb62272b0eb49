// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// Sum of the signed areas of loops.
double areaOf(const std::vector<Loop>& loops);

/// Values on the nodes of a grid that covers liquid between two shapes: above one half in it, below outside.
class GridField {
public:
    /// @param lower, upper  box that the grid covers
    /// @param cell          side of its cells
    GridField(Vec2 lower, Vec2 upper, double cell);

    /// Adds `weight` times the share of the area around each node that particles cover.
    /// @param area    of a particle
    /// @param radius  of the kernel, in which the share is measured
    struct Particles {
        std::span<const Vec2> position;
        double area = 0.0;
        double radius = 0.0;
    };
    void add(const Particles& particles, double weight);

    /// Adds a function of the signed distance from a region's rim, which is positive inside. Without loops all is
    /// outside, as far as the grid is long. Beyond two cells the distance is that of a sweep: within a cell of the
    /// exact one, and without jumps.
    void add(const Region& region, const std::function<double(double)>& value_at);

    /// Lets liquid fill slits narrower than a width, and holes of less than that radius, gradually: what is filled
    /// changes with the width without jumps.
    void fill(double width);

    /// Loops around places with more than `level`, but for those that enclose less than `min_area`.
    [[nodiscard]] std::vector<Loop> loops(double level, double min_area) const;

    /// Loops that enclose an area, at the level that gives it.
    [[nodiscard]] std::vector<Loop> loopsOfArea(double area, double min_area) const;

    /// Value at a place within the grid.
    [[nodiscard]] double at(Vec2 place) const;

private:
    [[nodiscard]] Vec2 place(int column, int row) const;
    [[nodiscard]] std::size_t node(int column, int row) const;
    [[nodiscard]] std::vector<double> signedDistance(const Region& region) const;

    Vec2 lower_;
    double cell_;
    int columns_;
    int rows_;
    std::vector<double> values_;
};

}  // namespace droplet
