// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using droplet::Kernel;
using droplet::Vec2;

TEST(Kernel, IntegratesToOne)
{
    const Kernel kernel(0.3);
    const int steps = 20000;
    const double width = kernel.support() / steps;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double r = (k + 0.5) * width;
        sum += 2.0 * std::numbers::pi * r * kernel(r) * width;
    }
    EXPECT_NEAR(sum, 1.0, 1e-8);
}

TEST(Kernel, SlopeIsTheDerivative)
{
    const Kernel kernel(0.3);
    for (const double r : {0.05, 0.2, 0.29, 0.31, 0.45, 0.59}) {
        const double step = 1e-6;
        const double slope = (kernel(r + step) - kernel(r - step)) / (2.0 * step);
        EXPECT_NEAR(kernel.both(r).slope_over_distance * r, slope, 1e-6 * std::abs(kernel(0.0)));
        EXPECT_DOUBLE_EQ(kernel.both(r).value, kernel(r));
    }
}

TEST(Kernel, SumsOverTheLatticeAreOneAndItsGradientsZero)
{
    const double spacing = 0.3;
    const Kernel kernel(spacing);
    const double step = droplet::latticeStep(spacing);
    double sum = kernel.area() * kernel(0.0);
    Vec2 gradient;
    for (int row = -4; row <= 4; ++row) {
        for (int column = -6; column <= 6; ++column) {
            const Vec2 x{step * (column + 0.5 * row), step * 0.5 * std::sqrt(3.0) * row};
            const double r = length(x);
            if (r > 0.0 && r < kernel.support()) {
                sum += kernel.area() * kernel(r);
                gradient = gradient + (kernel.area() * kernel.both(r).slope_over_distance) * x;
            }
        }
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(length(gradient), 0.0, 1e-12);
    // The lattice has one particle per spacing²; the sum differs from the integral by little.
    EXPECT_NEAR(kernel.area(), spacing * spacing, 0.03 * spacing * spacing);
}

}  // namespace
