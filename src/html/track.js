// SPDX-License-Identifier: MIT
// A value of a node over time, as glTF's animations have it.

export class Track {
    #last = 0;

    /**
     * @param times   of the keys [s], ascending
     * @param values  of all keys
     * @param size    numbers in a value
     * @param steps   whether a value holds until the next key; otherwise it changes along a line
     */
    constructor(times, values, size, steps) {
        Object.assign(this, { times, values, size, steps });
    }

    /** The last key that is not later, or the first one. Most questions are about a time soon after the last. */
    keyAt(seconds) {
        const { times } = this;
        let key = seconds < times[this.#last] ? 0 : this.#last;
        while (key + 1 < times.length && times[key + 1] <= seconds) {
            ++key;
        }
        this.#last = key;
        return key;
    }

    /**
     * Writes the value at a time.
     * @param to    receives it
     * @param span  `from` and `until` [s], which become those of a time in which the value stays, if that is shorter
     */
    read(seconds, to, span) {
        const { times, values, size, steps } = this;
        const key = this.keyAt(seconds);
        const next = key + 1 < times.length ? times[key + 1] : Infinity;
        const changes = !steps && seconds >= times[key] && next < Infinity &&
            to.some((_, k) => values[size * key + k] !== values[size * (key + 1) + k]);
        const share = changes ? (seconds - times[key]) / (next - times[key]) : 0;
        for (let k = 0; k < size; ++k) {
            const value = values[size * key + k];
            to[k] = share > 0 ? value + share * (values[size * (key + 1) + k] - value) : value;
        }
        span.from = Math.max(span.from, changes ? seconds : seconds < times[key] || key === 0 ? -Infinity : times[key]);
        span.until = Math.min(span.until, changes ? seconds : seconds < times[key] ? times[key] : next);
    }
}
