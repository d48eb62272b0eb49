// SPDX-License-Identifier: GPL-3.0-or-later
// Loads the rain, and calls it: the C interface of include/droplet/c/droplet.h.
import { loadModule } from './c_module.js';
import { DropletError } from './droplet_error.js';

/** Parameters, as droplet_windshield_set() has them; those of the glass come first, before others depend on it. */
const kParameters = ['glass-width', 'glass-height', 'glass-radius', 'slope', 'seed', 'speed', 'rain', 'noise', 'wiper-period', 'gravity',
    'contact-angle', 'hysteresis', 'kinetic-fraction', 'viscosity-factor', 'film', 'still-diameter', 'runoff', 'mist', 'splashes'];
const camelCase = (name) => name.replace(/-(\w)/g, (_, letter) => letter.toUpperCase());
const kNames = new Map(kParameters.map((name) => [camelCase(name), name]));
/** Names of all parameters, and of those that a mesh has itself. */
export const kWindshieldParameters = [...kNames.keys()];
export const kGlassParameters = kWindshieldParameters.slice(0, 4);
/** Bytes of the largest structure of the interface, DropletPlace. */
const kRoom = 96;
const kMaxBlades = 8;
const kBladeRoom = 64;
const kCornerNumbers = 14;

/** Decodes IEEE 754 binary16, for programs that read pixels; textures take them as they are. */
export function halfFloat(bits) {
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = bits >> 10 & 31;
    const fraction = bits & 1023;
    return sign * (exponent === 0 ? fraction * 2 ** -24 : exponent === 31 ? (fraction ? NaN : Infinity) : (1024 + fraction) * 2 ** (exponent - 25));
}

/**
 * Loads the module.
 * @param wasm  bytes of droplet_rain.wasm, or the compiled module
 * @return      function that makes a windshield: see windshield() in windshield.js
 */
export async function loadRain(wasm) {
    const { calls: rain, room, check, allocated, withText, view, numbers, count64, putNumbers } =
        await loadModule(wasm, Math.max(kRoom, kBladeRoom * kMaxBlades), 'use smaller maps');

    /** What windshield.d.ts says. */
    class Windshield {
        #it;
        #map;

        constructor({ preset, mapWidth = 1024, surface, ...values } = {}) {
            this.#it = withText(preset, (name) => {
                check(rain.droplet_windshield_new(name, room));
                return view().getUint32(room, true);
            });
            try {
                if (surface) {
                    this.#setSurface(surface);
                }
                this.set(values);
                this.mapWidth = mapWidth;
            } catch (error) {
                this.free();
                throw error;
            }
        }

        /** Gives the glass the shape of a mesh. */
        #setSurface({ positions, normals, uvs, indices }) {
            const vertices = positions.length / 3;
            for (const [name, list, length] of [['positions', positions, 3 * vertices], ['normals', normals, 3 * vertices], ['uvs', uvs, 2 * vertices]]) {
                if (!Number.isInteger(vertices) || list.length !== length) {
                    throw new DropletError('InvalidArgument', `surface.${name}: ${list.length} numbers; positions and normals must have three for each vertex, uvs two`);
                }
            }
            if (indices.length % 3 !== 0) {
                throw new DropletError('InvalidArgument', `surface.indices: ${indices.length} numbers; there must be three for each triangle`);
            }
            const places = [[Float32Array, positions], [Float32Array, normals], [Float32Array, uvs], [Uint32Array, indices]].map(([Numbers, list]) => {
                const place = allocated(Math.max(4 * list.length, 1));
                new Numbers(rain.memory.buffer, place, list.length).set(list);
                return place;
            });
            const [place, normal, uv, index] = places;
            [vertices, place, normal, uv, 0, indices.length / 3, index].forEach((value, k) => view().setUint32(room + 4 * k, value, true));
            try {
                check(rain.droplet_windshield_surface(this.#kept(), room));
            } finally {
                places.forEach(rain.free);
            }
        }

        set(values) {
            for (const name of Object.keys(values)) {
                if (!kNames.has(name)) {
                    throw new DropletError('InvalidArgument', `${name}: unknown parameter; known are preset, mapWidth, ${[...kNames.keys()].join(', ')}`);
                }
            }
            for (const [name, dashed] of kNames) {
                const value = values[name];
                if (value === undefined) {
                    continue;
                }
                if (typeof value !== 'number') {
                    throw new DropletError('InvalidArgument', `${name}: ${JSON.stringify(value)} must be a number`);
                }
                withText(dashed, (place) => check(rain.droplet_windshield_set(this.#kept(), place, value)));
            }
        }

        get(name) {
            return withText(kNames.get(name) ?? name, (place) => {
                check(rain.droplet_windshield_get(this.#kept(), place, room));
                return numbers(1)[0];
            });
        }

        advance(seconds) {
            check(rain.droplet_windshield_advance(this.#kept(), seconds));
        }

        spray({ x, y, radius = 0.05, volume = 1e-6 }) {
            putNumbers([x, y, radius, volume]);
            check(rain.droplet_windshield_spray(this.#kept(), room));
        }

        finger({ from, to, width = 14e-3 }) {
            putNumbers([from.x, from.y, to.x, to.y, width]);
            check(rain.droplet_windshield_finger(this.#kept(), room));
        }

        figures() {
            check(rain.droplet_windshield_figures(this.#kept(), room));
            const [time, speed, width, height] = numbers(4);
            const [running, still, raindrops] = [32, 40, 48].map((at) => count64(room + at));
            return { time, speed, width, height, running, still, raindrops };
        }

        water() {
            check(rain.droplet_windshield_water(this.#kept(), room));
            const [volume, balanceError] = numbers(2);
            return { volume, balanceError };
        }

        running() {
            const kBytes = 56;
            const count = rain.droplet_windshield_running(this.#kept(), 0, 0);
            const list = allocated(Math.max(kBytes * count, 1));
            rain.droplet_windshield_running(this.#it, list, count);
            const droplets = Array.from({ length: count }, (_, k) => {
                const [x, y, vx, vy, volume, radius] = numbers(6, list + kBytes * k + 8);
                return { id: count64(list + kBytes * k), x, y, vx, vy, volume, radius };
            });
            rain.free(list);
            return droplets;
        }

        place(x, y) {
            check(rain.droplet_windshield_place(this.#kept(), x, y, room));
            const all = numbers(12);
            return { point: all.slice(0, 3), normal: all.slice(3, 6), across: all.slice(6, 9), up: all.slice(9) };
        }

        triangles() {
            check(rain.droplet_windshield_triangles(this.#kept(), room));
            const [list, count] = [0, 4].map((at) => view().getUint32(room + at, true));
            const all = new Float64Array(rain.memory.buffer, list, 3 * kCornerNumbers * count);
            const corner = (k) => {
                const [x, y, ...place] = all.subarray(kCornerNumbers * k, kCornerNumbers * (k + 1));
                return { x, y, point: place.slice(0, 3), normal: place.slice(3, 6), across: place.slice(6, 9), up: place.slice(9) };
            };
            return Array.from({ length: count }, (_, k) => [corner(3 * k), corner(3 * k + 1), corner(3 * k + 2)]);
        }

        blades() {
            const count = Math.min(rain.droplet_windshield_blades(this.#kept(), room, kMaxBlades), kMaxBlades);
            return Array.from({ length: count }, (_, k) => {
                const [innerX, innerY, outerX, outerY, x, y, first, last] = numbers(8, room + kBladeRoom * k);
                return { inner: { x: innerX, y: innerY }, outer: { x: outerX, y: outerY }, pivot: { x, y }, first, last };
            });
        }

        /** Width of the maps [px]; after another width all is drawn anew. */
        get mapWidth() {
            return this.#map.width;
        }

        set mapWidth(width) {
            check(rain.droplet_windshield_map_height(this.#kept(), width, room));
            const height = view().getInt32(room, true);
            rain.free(this.#map?.pixels ?? 0);
            this.#map = undefined;
            this.#map = { width, height, pixels: allocated(8 * width * height) };
        }

        get mapHeight() {
            return this.#map.height;
        }

        draw() {
            const { width, height, pixels } = this.#map;
            check(rain.droplet_windshield_draw(this.#kept(), width, pixels, room));
            const [list, count] = [0, 4].map((at) => view().getUint32(room + at, true));
            const all = new Int32Array(rain.memory.buffer, list, 4 * count);
            const tiles = Array.from({ length: count }, (_, k) =>
                ({ x: all[4 * k], y: all[4 * k + 1], width: all[4 * k + 2], height: all[4 * k + 3] }));
            return { width, height, tiles, pixels: new Uint16Array(rain.memory.buffer, pixels, 4 * width * height) };
        }

        mist() {
            return this.#cells(rain.droplet_windshield_mist);
        }

        runoff() {
            const map = this.#cells(rain.droplet_windshield_runoff);
            check(rain.droplet_windshield_runoff_drift(this.#kept(), room));
            const [x, y] = numbers(2);
            return { ...map, drift: { x, y } };
        }

        #cells(brought) {
            check(brought(this.#kept(), room));
            const pixels = view().getUint32(room, true);
            const [width, height] = [4, 8].map((at) => view().getInt32(room + at, true));
            const [right, top] = numbers(2, room + 16);
            return { width, height, right, top, pixels: new Uint8Array(rain.memory.buffer, pixels, width * height).slice() };
        }

        /** Gives its memory back at once. */
        free() {
            rain.droplet_windshield_delete(this.#it ?? 0);
            rain.free(this.#map?.pixels ?? 0);
            this.#it = this.#map = undefined;
        }

        #kept() {
            if (!this.#it) {
                throw new DropletError('InvalidArgument', 'the windshield was freed');
            }
            return this.#it;
        }
    }

    return (values) => new Windshield(values);
}
