// SPDX-License-Identifier: MIT
// Where blades have been since the last frame, as the map of their films takes it (kSweep in shaders.js), and the water that they
// push ahead and leave where they turn, as src/windshield_view/wiper_view.cpp has it.

/** Each way there or back has streaks of its own: so far apart [m]. */
const kApart = 0.37;
const kWays = 8;
/** How long the water lasts where a blade has turned [s]. */
const kWedgeLasts = 0.8;

const smoothstep = (low, high, value) => {
    const t = Math.min(Math.max((value - low) / (high - low), 0), 1);
    return t * t * (3 - 2 * t);
};

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
        if (!begins && time === this.#time) {
            return { begins, lost: 0, numbers: [], is_wet: time < this.dry_at };
        }
        const passed = begins ? 0 : time - this.#time;
        this.#time = time;
        const numbers = [];
        const step = { lost: passed / this.lasts, numbers, time };
        this.#blades = blades.map((blade, k) => this.#swept(begins ? undefined : this.#blades[k], blade, step));
        this.dry_at = numbers.length > 0 ? time + this.lasts : begins ? -Infinity : this.dry_at;
        return { begins, lost: passed / this.lasts, numbers, is_wet: time < this.dry_at };
    }

    /**
     * Lines of water that are there now: ahead of blades, and where they have turned.
     * @return  of each, the blade's number, the angle of the line [rad], the side that the water is on, 1 or −1, how much there is, which
     *          share has drained, which is below 0 ahead of blades, and a number that differs from stroke to stroke
     */
    beads() {
        const beads = [];
        this.#blades.forEach(({ angle, first, last, turn, turned, ways }, blade) => {
            if (turn !== 0) {
                const done = Math.abs(angle - (Math.sign(turn) === Math.sign(last - first) ? first : last)) / Math.abs(last - first);
                // The blade releases the water just before it turns.
                const pushed = Math.sqrt(done) * (1 - smoothstep(0.97, 1, done));
                beads.push({ blade, angle, side: Math.sign(turn), pushed, drained: -1, seed: ways });
            }
            const drained = turned ? (this.#time - turned.time) / kWedgeLasts : 1;
            if (drained < 1) {
                beads.push({ blade, ...turned, pushed: 1, drained });
            }
        });
        return beads;
    }

    /** Adds what a blade has swept; returns the blade with its way. */
    #swept(last, { inner, outer, first, last: end }, { lost, numbers, time }) {
        const now = {
            inner, outer, first, last: end, turned: last?.turned,
            length: Math.hypot(outer.x - inner.x, outer.y - inner.y), angle: Math.atan2(outer.y - inner.y, outer.x - inner.x),
        };
        const turned = last ? now.angle - last.angle : 0;
        const same = Math.sign(turned) === Math.sign(last?.turn ?? 0);
        if (!same && last?.turn) {
            now.turned = { angle: last.angle, side: Math.sign(last.turn), time, seed: last.ways };
        }
        if (turned === 0) {
            return { ...now, turn: 0, way: 0, ways: last?.ways ?? 0 };
        }
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
