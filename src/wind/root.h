// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace droplet {

/// Root of a continuous function, to the last digits, between two points where it is 0 or its signs differ. T. R.
/// Chandrupatla, "A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function without using
/// derivatives", Adv. Eng. Softw. 28 (1997) 145.
template <typename Function>
double rootBetween(double a, double b, const Function& function)
{
    double fa = function(a);
    double fb = function(b);
    double c = a;
    double fc = fa;
    double share = 0.5;
    constexpr int kMax = 200;  // bisection alone would need fewer
    for (int i = 0; i < kMax && fa != 0.0 && fb != 0.0; ++i) {
        const double x = a + share * (b - a);
        const double fx = function(x);
        if ((fx > 0.0) == (fa > 0.0)) {
            c = a;
            fc = fa;
        } else {
            c = b;
            fc = fb;
            b = a;
            fb = fa;
        }
        a = x;
        fa = fx;
        const double best = std::abs(fa) < std::abs(fb) ? a : b;
        const double tolerance = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(best);
        const double min = tolerance / std::abs(b - a);
        if (!(min < 0.5)) {
            break;
        }
        // Inverse quadratic interpolation if it is monotone, else bisection.
        const double xi = (a - b) / (c - b);
        const double phi = (fa - fb) / (fc - fb);
        share = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi
                    ? fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
                    : 0.5;
        share = std::clamp(share, min, 1.0 - min);
    }
    return std::abs(fa) < std::abs(fb) ? a : b;
}

}  // namespace droplet
