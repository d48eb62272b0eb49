// SPDX-License-Identifier: GPL-3.0-or-later
// Loads 2D liquids, and calls them: the C interface of include/droplet/c/droplet.h.
import { loadModule } from './c_module.js';

const kNames = { gravity: 'gravity', surfaceTension: 'surface-tension', viscosity: 'viscosity' };
/** Bytes of the largest structures of the interface, DropletStir and DropletLiquid2dFigures. */
const kRoom = 48;
const kNoColour = 0xFFFFFFFF;
/** What outlines bound, by their numbers. */
export const kLayers = ['liquid', 'droplets', 'foam', 'walls'];

/**
 * Loads the module.
 * @param wasm  bytes of droplet_liquid.wasm, or the compiled module
 * @return      `make`, which makes a liquid of {preset, particles, style, and parameters}; `look`
 */
export async function loadLiquid2d(wasm) {
    const { calls, room, check, withText, view, textAt, numbers, count64, putNumbers } =
        await loadModule(wasm, kRoom, 'use fewer particles');

    class Liquid2d {
        #it;

        constructor({ preset, particles = 10000, style, ...values } = {}) {
            this.#it = withText(preset, (name) => withText(style, (named) => {
                view().setUint32(room, name, true);
                view().setBigUint64(room + 8, BigInt(particles), true);
                view().setUint32(room + 16, named, true);
                check(calls.droplet_liquid2d_new(room, room + 24));
                return view().getUint32(room + 24, true);
            }));
            this.set(values);
        }

        /** Sets parameters: gravity [m/s²], surfaceTension [N/m], viscosity [m²/s]. */
        set(values) {
            for (const [name, value] of Object.entries(values)) {
                withText(kNames[name] ?? name, (place) => check(calls.droplet_liquid2d_set(this.#it, place, value)));
            }
        }

        get(name) {
            return withText(kNames[name] ?? name, (place) => {
                check(calls.droplet_liquid2d_get(this.#it, place, room));
                return numbers(1)[0];
            });
        }

        set style(name) {
            withText(name, (place) => check(calls.droplet_liquid2d_style(this.#it, place)));
        }

        advance(seconds) {
            check(calls.droplet_liquid2d_advance(this.#it, seconds));
        }

        pour({ x, y, radius, vx = 0, vy = 0 }) {
            putNumbers([x, y, radius, vx, vy]);
            check(calls.droplet_liquid2d_pour(this.#it, room));
        }

        stir({ from, to, radius, seconds }) {
            putNumbers([from.x, from.y, to.x, to.y, radius, seconds]);
            check(calls.droplet_liquid2d_stir(this.#it, room));
        }

        figures() {
            check(calls.droplet_liquid2d_figures(this.#it, room));
            const [time, width, height, spacing, speed] = numbers(5);
            return { time, width, height, spacing, speed, particles: count64(room + 40) };
        }

        /** Outlines by layer: lists of arrays of x and y [m], which stay until the next call. */
        outlines() {
            check(calls.droplet_liquid2d_outlines(this.#it, room));
            const [list, count, points] = [0, 4, 8].map((at) => view().getUint32(room + at, true));
            const layers = Object.fromEntries(kLayers.map((layer) => [layer, []]));
            const heads = new Uint32Array(calls.memory.buffer, list, 2 * count);
            for (let k = 0, at = points; k < count; ++k) {
                const numbers = 2 * heads[2 * k + 1];
                layers[kLayers[heads[2 * k]]].push(new Float32Array(calls.memory.buffer, at, numbers));
                at += 4 * numbers;
            }
            return layers;
        }

        /** The outlines of the last call, as SVG. */
        svg(look, width) {
            return withText(look, (place) => {
                check(calls.droplet_liquid2d_svg(this.#it, place, width, room));
                return textAt(view().getUint32(room, true));
            });
        }

        /** Begins an animation in a look, of a width [px], that plays so many frames a second. */
        record(look, width, framesPerSecond) {
            withText(look, (place) => check(calls.droplet_liquid2d_record(this.#it, place, width, framesPerSecond)));
        }

        /** Adds the outlines of the last call to the animation. */
        keep() {
            check(calls.droplet_liquid2d_keep(this.#it));
        }

        /** The animation as a text of Lottie. */
        lottie() {
            check(calls.droplet_liquid2d_lottie(this.#it, room));
            return textAt(view().getUint32(room, true));
        }

        /** Gives its memory back at once. */
        free() {
            calls.droplet_liquid2d_delete(this.#it);
            this.#it = 0;
        }
    }

    const colour = (number) => (number === kNoColour ? undefined : `#${number.toString(16).padStart(6, '0')}`);
    return {
        make: (values) => new Liquid2d(values),
        /** Colours and the lines' width, in thousandths of the window's, of flat, comic, ink or night. */
        look: (name) => withText(name, (place) => {
            check(calls.droplet_liquid2d_look(place, room));
            const [water, droplet, foam, line, wall, background] = Array.from({ length: 6 }, (_, k) => colour(view().getUint32(room + 4 * k, true)));
            return { water, droplet, foam, line, wall, background, lineWidth: numbers(1, room + 24)[0] };
        }),
    };
}
