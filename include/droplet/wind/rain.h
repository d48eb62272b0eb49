// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Size distribution of raindrops in air over their diameter D: N(D) = N₀ e^(−ΛD) (J. S. Marshall, W. M. Palmer, "The
/// distribution of raindrops with size", J. Meteor. 5 (1948) 165, eqs. 1 and 3), N₀ = 8000 m⁻³ mm⁻¹, Λ = 4.1 R^(−0.21)
/// mm⁻¹, R in mm/h. It is a density in air, not a rate of arrival: see RainImpacts. All lengths are in metres.
struct RaindropSizes {
    double intercept = 8e6;  ///< N₀ [m⁻⁴]
    double slope = 0.0;      ///< Λ [1/m]; 0: no rain

    /// N(D) [m⁻⁴]; 0 without rain.
    [[nodiscard]] double density(double diameter) const;
    /// Number of larger raindrops in a cubic metre of air: ∫ N dD from `diameter` on [m⁻³].
    [[nodiscard]] double largerThan(double diameter) const;
    /// Volume of water in a cubic metre of air: ∫ N π D³/6 dD over all diameters [m³/m³].
    [[nodiscard]] double waterContent() const;
    /// Share of that water in raindrops with diameters from `min` to `max`.
    [[nodiscard]] double waterShare(double min, double max) const;
};

/// Size distribution of the raindrops of a rainfall.
/// @param rainfall  R [m/s], ≥ 0, finite; mm/h times kMillimetrePerHour
/// @throws Error    InvalidArgument
RaindropSizes raindropSizes(double rainfall);

/// Terminal speed v = 9.65 − 10.3 e^(−600 D) m/s, D in metres; 0 below 0.109 mm, where that is negative (D. Atlas, R.
/// C. Srivastava, R. S. Sekhon, "Doppler radar characteristics of precipitation at vertical incidence", Rev. Geophys.
/// 11 (1973) 1, eq. 8).
double terminalSpeed(double diameter);

/// Range of the simulated diameters. Smaller raindrops do not fall (terminalSpeed) and have 1.2 ‰ of the water at 1
/// mm/h, less in heavier rain. Larger ones break up and have 0.05 ‰ at 25 mm/h, 1.6 ‰ at 100 mm/h.
struct RaindropRange {
    double min = 0.109e-3;  ///< [m], > 0
    double max = 8e-3;      ///< [m], > min

    /// Checks both fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;

    friend bool operator==(const RaindropRange&, const RaindropRange&) = default;  ///< Compares all members.
};

/// Orientation of a surface that moves ahead through rain, by its outward unit normal n. A plane at slope β from
/// horizontal has (cos β, sin β).
struct Exposure {
    double upward = 1.0;   ///< n·z, z up
    double forward = 0.0;  ///< n·y, y ahead

    /// Exposure of a plane.
    /// @param slope  β from horizontal [rad]
    static Exposure ofSlope(double slope);
};

/// Arrival of raindrops at a surface: their rate per area, time and diameter is f(D) = N(D) max(0, v(D) n·z + U n·y).
/// The first term is what a floor catches, the second what a wall catches.
struct RainImpacts {
    RaindropSizes sizes;  ///< raindrops in air
    RaindropRange range;  ///< diameters that are simulated
    double speed = 0.0;   ///< U, speed of the surface [m/s], ≥ 0

    /// f(D) [m⁻³ s⁻¹]; 0 outside of the range.
    [[nodiscard]] double density(double diameter, const Exposure& exposure) const;
    /// ∫ f dD from `min`, or range.min if it is larger, to range.max [m⁻² s⁻¹].
    [[nodiscard]] double rate(double min, const Exposure& exposure) const;
    /// ∫ N (v + U) dD over the range: rate of a floor and a wall together; the upper bound of every surface's rate
    /// [m⁻² s⁻¹].
    [[nodiscard]] double bound() const;
    /// Volume that a floor at rest catches: ∫ N v π D³/6 dD over the range [m/s].
    [[nodiscard]] double rainfall() const;
    /// Share of the raindrops of bound() with a given diameter that the surface catches. Draws of RaindropSampler, kept
    /// with this probability, have the density f and its rate.
    [[nodiscard]] double kept(double diameter, const Exposure& exposure) const;
};

/// Draws diameters of the raindrops that RainImpacts::bound() counts: first floor or wall, then a diameter of its
/// distribution. Both distributions are inverted exactly.
class RaindropSampler {
public:
    /// Prepares the distributions.
    /// @param impacts  with a bound() above 0
    explicit RaindropSampler(const RainImpacts& impacts);

    /// Diameter for two random numbers [m]; in the range.
    /// @param which  uniform in [0, 1): chooses floor or wall
    /// @param u      uniform in [0, 1): share of the raindrops that are smaller
    [[nodiscard]] double diameter(double which, double u) const;

private:
    RainImpacts impacts_;
    double floor_share_ = 0.0;  // share of the floor in bound()
    double floor_rate_ = 0.0;   // rate of the floor [m⁻² s⁻¹]
    double in_range_ = 0.0;     // share of the raindrops above range.min that are in the range
};

}  // namespace droplet
