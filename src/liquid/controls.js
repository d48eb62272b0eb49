// SPDX-License-Identifier: MIT
// The controls of 2D liquids, as those of the rain.
import { count, decimal, say } from '../html/words.js';

const same = { to: (value) => value, from: (shown) => shown };
/** Small values of a slider are finer: its square is the value. */
const squared = { to: (value) => Math.sqrt(value), from: (shown) => shown * shown };

export const kSliders = [
    { group: 'Liquid', name: 'gravity', label: 'Gravity', min: 0, max: 20, step: 0.1, ...same, show: (v) => `${decimal(v.toFixed(1))} m/s²` },
    { group: 'Liquid', name: 'surfaceTension', label: 'Surface tension', min: 0, max: 4, step: 0.05, ...squared, show: (v) => (v > 0 ? `${decimal(v.toFixed(v < 1 ? 2 : 1))} N/m` : say('none')) },
    { group: 'Liquid', name: 'particles', label: 'Particles', min: 1000, max: 20000, step: 500, ...same, show: count },
];

/** Scenes: their names, and the styles that suit them. */
export const kPresets = {
    splash: ['Splash', 'cartoon'], wave: ['Wave', 'wave'], dam: ['Dam', 'cartoon'], pour: ['Jet', 'cartoon'], basin: ['Empty', 'cartoon'],
};
export const kStyles = { realistic: 'Realistic', cartoon: 'Cartoon', wave: 'Wave' };
export const kLooks = { comic: 'Comic', flat: 'Flat', ink: 'Ink', night: 'Night' };
export const kRecords = { video: 'Video', lottie: 'Lottie' };
