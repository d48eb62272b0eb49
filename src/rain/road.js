// SPDX-License-Identifier: MIT
// The lights of a street on a wet evening, as seen from a place of it: what the C++ view's evening road has, and more of a
// town. Sizes are those of streets; colours are chosen by eye.

const kEye = 1.2;          // height of the eye over the road [m]
const kLane = 3.5;         // width of a lane [m]
const kFull = 34;          // distance from which on lights are weaker the farther they are [m]
const kFarthest = 420;     // largest distance of a visible light [m]
/** Numbers of a light: tangents right and up, its size, length of a reflection (0: a light), red, green, blue, 1 if it is a sign. */
export const kNumbers = 8;

const mix = (a, b, t) => a + (b - a) * t;
const smoothstep = (low, high, x) => {
    const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
    return t * t * (3 - 2 * t);
};
const wrapped = (value, period) => value - period * Math.floor(value / period);

/** A number from 0 to 1 for every whole number. */
function hashed(k) {
    let x = Math.imul(k + 0x9e3779b9, 0x85ebca6b);
    x = Math.imul(x ^ x >>> 15, 0xc2b2ae35);
    return ((x ^ x >>> 16) >>> 0) / 2 ** 32;
}

const kSodium = [1.6, 0.74, 0.2];
const kWhite = [1.7, 1.5, 1.15];    // halogen lamps
const kBluish = [1.15, 1.35, 1.65];  // and those of xenon
const kRed = [1.5, 0.05, 0.03];
const kGreen = [0.08, 1.25, 0.6];

/** Lights at one place. */
export class Road {
    #numbers = new Float32Array(512 * kNumbers);
    #count = 0;

    /** Adds a lamp and its reflection in the wet road. */
    #add(across, height, depth, size, [red, green, blue], dim, mirrored = 0) {
        if (dim <= 0.002 || this.#count + 2 > 512) {
            return;
        }
        const right = across / depth;
        dim *= Math.min(kFull / depth, 1) ** 1.3;
        const put = (...all) => this.#numbers.set(all, kNumbers * this.#count++);
        put(right, (height - kEye) / depth, size / depth, 0, dim * red, dim * green, dim * blue, 0);
        if (mirrored > 0) {
            const drop = (height + kEye) / depth;
            const share = dim * mirrored;
            put(right, -drop - 0.012, 1.2 * size / depth, Math.max(0.03, 0.45 * drop), share * red, share * green, share * blue, 1);
        }
    }

    /**
     * @param travelled  distance of the car from the start [m]
     * @param time       of lights that blink [s]
     * @return           numbers of all lights
     */
    at(travelled, time) {
        this.#count = 0;
        const passed = (period, times = 1) => wrapped(times * travelled, period);
        // Street lamps on both sides.
        const kLamps = 32;
        for (let k = 1; k < 10; ++k) {
            const depth = kLamps * k - passed(kLamps);
            for (const [across, at] of [[4.8, depth], [-8.3, depth + kLamps / 2]]) {
                this.#add(across, 7.2, at, 0.14, kSodium, smoothstep(7, 12, at) * (1 - smoothstep(260, kFarthest, at)), 0.2);
            }
        }
        // Cars ahead keep their distance; those that come nearer do so at the sum of both speeds.
        for (const [k, depth] of [19, 47, 92].entries()) {
            const sway = 0.12 * Math.sin(0.4 * time + 2 * k);
            const brakes = 0.75 + 0.5 * smoothstep(0.3, 0.6, Math.sin(0.33 * time + 1.7 * k));
            for (const side of [-0.68, 0.68]) {
                this.#add(0.1 + sway + side, 0.85, depth, 0.09, kRed, brakes, 0.3);
            }
        }
        const kTrain = 170;
        for (const [k, place] of [38, 71, 118, 150].entries()) {
            const depth = wrapped(place - passed(kTrain, 1.9), kTrain) + 7;
            const near = smoothstep(7, 11, depth) * (1 - smoothstep(150, 174, depth));
            for (const side of [-0.66, 0.66]) {
                this.#add(side - kLane, 0.7, depth, 0.1, k % 3 === 1 ? kBluish : kWhite, near, 0.34);
            }
        }
        // Windows, shops and signs at both sides.
        const kTown = 330;
        for (let k = 0; k < 96; ++k) {
            const depth = 18 + wrapped(kTown * hashed(7 * k + 1) - passed(kTown), kTown);
            const side = k % 2 === 0 ? 1 : -1;
            const across = side * (8.5 + 15 * hashed(7 * k + 2) ** 1.5) - 1.7;
            const kind = hashed(7 * k + 4);
            const tint = kind < 0.55 ? [1.1, 0.6, 0.22] : kind < 0.7 ? [1.0, 0.86, 0.62] : kind < 0.8 ? [0.5, 0.72, 1.1]
                : kind < 0.88 ? [0.14, 0.8, 0.66] : kind < 0.95 ? [1.15, 0.16, 0.24] : [0.95, 0.2, 0.85];
            const dim = smoothstep(18, 27, depth) * (1 - smoothstep(210, kTown + 18, depth)) * mix(0.15, 0.8, hashed(7 * k + 5) ** 2);
            const height = kind < 0.55 ? 1 + 9 * hashed(7 * k + 3) : 1.5 + 2.6 * hashed(7 * k + 3);
            this.#add(across, height, depth, mix(0.12, 0.4, hashed(7 * k + 6)), tint, dim, kind < 0.55 ? 0 : 0.12);
        }
        // Traffic lights that stay ahead, and change.
        const is_red = wrapped(time, 34) > 22;
        for (const across of [3.4, -7]) {
            this.#add(across, 5.2, 105, 0.16, is_red ? kRed : kGreen, 1, 0.2);
        }
        return this.#numbers.subarray(0, kNumbers * this.#count);
    }
}
