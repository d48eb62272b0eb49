// SPDX-License-Identifier: MIT
// The controls of the page: what each changes, its range and its unit. Values are in SI units; `from` and `to` turn them into
// what a slider has.
import { decimal, say } from '../html/words.js';

const kDegree = Math.PI / 180;
const kMillimetrePerHour = 1e-3 / 3600;
const kDenseMist = 10e-6;  // thickness at which mist grows no more [m]
const scaled = (factor) => ({ to: (value) => value / factor, from: (shown) => shown * factor });
/** A number in the user's language. */
const fixed = (value, places) => decimal(value.toFixed(places));
/** Small values of a slider are finer: its square is the value. */
const squared = (factor) => ({ to: (value) => Math.sqrt(value / factor), from: (shown) => shown * shown * factor });

export const kSliders = [
    { group: 'Weather', name: 'rain', label: 'Rain', min: 0, max: 10, step: 0.1, ...squared(kMillimetrePerHour), show: (v) => `${(v / kMillimetrePerHour).toFixed(0)} mm/h` },
    { group: 'Weather', name: 'wind', label: 'Head wind', min: 0, max: 30, step: 0.5, ...scaled(1), show: (v) => `${v.toFixed(0)} m/s` },
    { group: 'Weather', name: 'mist', label: 'Mist', min: 0, max: 1, step: 0.01, ...squared(1e-6), show: (v) => (v > 0 ? say('dense in {time} s', { time: (kDenseMist / v).toFixed(0) }) : say('none')) },
    { group: 'Car', name: 'speed', label: 'Speed', min: 0, max: 200, step: 1, ...scaled(1 / 3.6), show: (v) => `${(3.6 * v).toFixed(0)} km/h` },
    { group: 'Car', name: 'wiperPeriod', label: 'Wipers every', min: 0, max: 10, step: 0.2, to: (v) => v, from: (s) => (s < 1.2 ? 0 : s), show: (v) => (v > 0 ? `${fixed(v, 1)} s` : say('off')) },
    { group: 'Car', name: 'noise', label: 'Vibration', min: 0, max: 5, step: 0.1, ...scaled(1), show: (v) => `${fixed(v, 1)} m/s²` },
    { group: 'Glass', name: 'contactAngle', label: 'Contact angle', min: 20, max: 160, step: 1, ...scaled(kDegree), show: (v) => `${(v / kDegree).toFixed(0)}°` },
    { group: 'Glass', name: 'hysteresis', label: 'Static hysteresis', min: 0, max: 1.5, step: 0.01, ...scaled(1), show: (v) => fixed(v, 2) },
    { group: 'Glass', name: 'kineticFraction', label: 'Dynamic, of static', min: 0, max: 1, step: 0.01, ...scaled(1), show: (v) => fixed(v, 2) },
    { group: 'Glass', name: 'runoff', label: 'Film of heavy rain', min: 0, max: 3, step: 0.1, ...scaled(1), show: (v) => (v > 0 ? say('lasts {time} s', { time: fixed(v, 1) }) : say('none')) },
    { group: 'Glass', name: 'slope', label: 'Slope', min: 5, max: 85, step: 1, ...scaled(kDegree), show: (v) => `${(v / kDegree).toFixed(0)}°` },
    { group: 'Glass', name: 'gravity', label: 'Gravity', min: 0, max: 25, step: 0.1, ...scaled(1), show: (v) => `${fixed(v, 1)} m/s²` },
    { group: 'View', name: 'distance', label: 'Eye to glass', min: 15, max: 140, step: 1, ...scaled(0.01), show: (v) => `${(100 * v).toFixed(0)} cm` },
    { group: 'View', name: 'blur', label: 'Out of focus', min: 0, max: 6, step: 0.1, ...scaled(kDegree), show: (v) => `${fixed(v / kDegree, 1)}°` },
    { group: 'View', name: 'exposure', label: 'Exposure', min: -2, max: 2, step: 0.1, to: (v) => Math.log2(v), from: (s) => 2 ** s, show: (v) => say('{exposure} stops', { exposure: fixed(Math.log2(v), 1) }) },
];

/** Contact angle [degrees], hysteresis, and friction of a moving droplet over what holds it at rest. */
export const kCoatings = {
    'Clean glass': [35, 0.25, 0.8],
    'Old glass': [60, 0.6, 0.9],
    'Waxed': [90, 0.3, 0.9],
    'Rain repellent': [108, 0.12, 0.8],
    'Lotus leaf': [150, 0.03, 0.9],
};
export const angleOfCoating = (degrees) => degrees * kDegree;

/** Figures of the thesis: their names, and what they show. */
export const kFigures = { '3.10': 'the droplets do not move', '3.11': 'they move along the bend', '3.12': 'the large ones climb' };
