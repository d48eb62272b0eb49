// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

/// Raindrops in air by their diameter D: N(D) = N₀ e^(−ΛD) (J. S. Marshall, W. M. Palmer, "The distribution of
/// raindrops with size", J. Meteor. 5 (1948) 165, eqs. 1 and 3), N₀ = 8000 m⁻³ mm⁻¹, Λ = 4.1 R^(−0.21) mm⁻¹, R in mm/h.
///
/// It is a density in air, not a rate of arrival: see RainImpacts. All lengths in metres.
struct RaindropSizes {
    double intercept = 8e6;  ///< N₀ [m⁻⁴]
    double slope = 0.0;      ///< Λ [1/m]; 0: no rain

    /// N(D) [m⁻⁴], 0 without rain.
    [[nodiscard]] double density(double diameter) const;
    /// Raindrops larger than that in a cubic metre of air: ∫ N dD from there on [m⁻³].
    [[nodiscard]] double largerThan(double diameter) const;
    /// Water in a cubic metre of air by its volume: ∫ N π D³/6 dD over all diameters [m³/m³].
    [[nodiscard]] double waterContent() const;
    /// Share of that in raindrops of diameters from `min` to `max`.
    [[nodiscard]] double waterShare(double min, double max) const;
};

/// @param rainfall  R [m/s], ≥ 0, finite: kMillimetrePerHour makes it from mm/h
/// @throws Error    InvalidArgument
RaindropSizes raindropSizes(double rainfall);

/// Terminal speed v = 9.65 − 10.3 e^(−600 D) m/s, D in metres, 0 where that is negative: below 0.109 mm (D. Atlas, R.
/// C. Srivastava, R. S. Sekhon, "Doppler radar characteristics of precipitation at vertical incidence", Rev. Geophys.
/// 11 (1973) 1, eq. 8).
double terminalSpeed(double diameter);

/// The diameters that are simulated. Smaller ones do not fall (terminalSpeed) and hold 1.2 ‰ of the water at 1 mm/h,
/// less in heavier rain; larger ones break up and hold 0.05 ‰ at 25 mm/h, 1.6 ‰ at 100 mm/h.
struct RaindropRange {
    double min = 0.109e-3;  ///< [m], > 0
    double max = 8e-3;      ///< [m], > least

    /// @throws Error InvalidArgument
    void validate() const;

    friend bool operator==(const RaindropRange&, const RaindropRange&) = default;
};

/// Where rain meets a surface that moves through it: its outward unit normal against the upright and against the
/// direction of motion, which is level. A plane at slope β from horizontal, moving ahead, has cos β and sin β.
struct Exposure {
    double upward = 1.0;   ///< n·z
    double forward = 0.0;  ///< n·y, y ahead

    /// @param slope  β from horizontal [rad]
    static Exposure ofSlope(double slope);
};

/// Raindrops that meet a surface: the integrand of their rate is f(D) = N(D) max(0, v(D) n·z + U n·y), per area, time
/// and diameter. The vertical part falls on a floor, the other runs into a wall.
struct RainImpacts {
    RaindropSizes sizes;
    RaindropRange range;
    double speed = 0.0;  ///< of the surface, U [m/s], ≥ 0

    /// f(D) [m⁻³ s⁻¹], 0 outside of the range.
    [[nodiscard]] double density(double diameter, const Exposure& exposure) const;
    /// ∫ f dD over diameters from `min`, or the range's min if that is larger, to the range's max [m⁻² s⁻¹].
    [[nodiscard]] double rate(double min, const Exposure& exposure) const;
    /// ∫ N (v + U) dD over the range: what floor and wall catch together, which bounds every surface's rate
    /// [m⁻² s⁻¹].
    [[nodiscard]] double bound() const;
    /// The share of the raindrops of that diameter, of those bound() counts, that meets the surface: drawing by
    /// RaindropSampler and keeping this share draws from f, at its rate.
    [[nodiscard]] double kept(double diameter, const Exposure& exposure) const;
};

/// Draws diameters of raindrops, of those that RainImpacts::bound() counts: by the floor's share and the wall's, both
/// distributions inverted exactly.
class RaindropSampler {
public:
    /// @param impacts  with a bound() above 0
    explicit RaindropSampler(const RainImpacts& impacts);

    /// @param which  uniform in [0, 1): chooses floor or wall
    /// @param u      uniform in [0, 1): the share of that below the diameter
    /// @return       [m], in the range
    [[nodiscard]] double diameter(double which, double u) const;

private:
    RainImpacts impacts_;
    double floor_share_ = 0.0;  // of what meets either
    double fallen_ = 0.0;       // what meets the floor [m⁻² s⁻¹]
    double met_ = 0.0;          // of the raindrops above the least, how many are in the range
};

}  // namespace droplet
