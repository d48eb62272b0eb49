// SPDX-License-Identifier: MIT
// Where blades have been since the last frame, as the map of their films takes it (kSweep in shaders.js).

/** Each way there or back has streaks of its own: so far apart [m]. */
const kApart = 0.37;
const kWays = 8;

export class Sweeps {
    #blades = [];
    #time;

    /** @param lasts  how long a film lasts [s] */
    constructor(lasts) {
        this.lasts = lasts;
        this.dry_at = -Infinity;
    }

    /**
     * Follows the blades to a time [s].
     * @param blades  of the windshield: where each begins and ends on the glass [m]
     * @return        `begins`, whether the map is to be empty before; `lost`, what all films lose; `numbers`, vertices of triangles,
     *                each the position on the glass, freshness, distance along the blade, way of its outer end, angle; `is_wet`,
     *                whether any film is left
     */
    follow(blades, time) {
        const begins = this.#time === undefined || time < this.#time;
        const passed = begins ? 0 : time - this.#time;
        this.#time = time;
        const numbers = [];
        this.#blades = blades.map((blade, k) => this.#swept(begins ? undefined : this.#blades[k], blade, passed / this.lasts, numbers));
        this.dry_at = numbers.length > 0 ? time + this.lasts : begins ? -Infinity : this.dry_at;
        return { begins, lost: passed / this.lasts, numbers, is_wet: time < this.dry_at };
    }

    /** Adds what a blade has swept; returns the blade with its way. */
    #swept(last, { inner, outer }, lost, numbers) {
        const now = { inner, outer, length: Math.hypot(outer.x - inner.x, outer.y - inner.y), angle: Math.atan2(outer.y - inner.y, outer.x - inner.x) };
        const turned = last ? now.angle - last.angle : 0;
        if (turned === 0) {
            return { ...now, turn: 0, way: 0, ways: last?.ways ?? 0 };
        }
        const same = Math.sign(turned) === Math.sign(last.turn);
        const ways = same ? last.ways : (last.ways + 1) % kWays;
        const from = same ? last.way : kApart * ways;
        const way = from + Math.hypot(outer.x - last.outer.x, outer.y - last.outer.y);
        const corner = (position, fresh, along, along_way, angle) => [position.x, position.y, fresh, along, along_way, angle];
        const [a, b] = [corner(last.inner, 1 - lost, 0, from, last.angle), corner(last.outer, 1 - lost, last.length, from, last.angle)];
        const [c, d] = [corner(outer, 1, now.length, way, now.angle), corner(inner, 1, 0, way, now.angle)];
        numbers.push(...a, ...b, ...c, ...a, ...c, ...d);
        return { ...now, turn: turned, way, ways };
    }
}
