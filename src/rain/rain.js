// SPDX-License-Identifier: MIT
// Rain on a windshield in a page: the simulation in fixed steps, its view, and the controls.
import { kGlassParameters, kWindshieldParameters, loadRain } from '../../npm/rain.js';
import { say } from '../html/words.js';
import { Recorder, savePicture } from '../live/recorder.js';
import { Backdrop } from './backdrop.js';
import { Panel } from './panel.js';
import { View } from './view.js';

const kStep = 1 / 60;
const kStepsAtOnce = 3;          // more in a frame, and the rain runs slower than time
const kMapWidths = [2048, 1536, 1024, 768, 512];
const kScales = [1, 0.8, 0.65, 0.5];
const kFrames = 45;              // after which the sizes are judged
const kSlowMaps = 8;             // [ms] a frame
const kSlowFrame = 1000 / 40;    // [ms]
/** Water of a sprayer [m³/s], and the radius that it meets [m]. */
const kSprayed = 2e-6;
const kSprayRadius = 0.035;
const kFinger = 16e-3;           // width [m]
const kBorder = 0.035;           // of the glass [m]
const kWarmUpAtOnce = 60;        // [ms]

/** Names of parameters that a glass has, which may be a mesh. */
const parametersOf = (surface) => (surface ? kWindshieldParameters.filter((name) => !kGlassParameters.includes(name)) : kWindshieldParameters);

/** The mesh of a glass, whose numbers are texts in base64. */
function meshOf({ positions, normals, uvs, indices }) {
    const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
    const [places, directions, maps] = [positions, normals, uvs].map((text) => new Float32Array(bytes(text)));
    return { positions: places, normals: directions, uvs: maps, indices: new Uint32Array(bytes(indices)) };
}

/**
 * Fills an element with the rain.
 * @param parent  element, empty or not
 * @param wasm    droplet_rain.wasm, as bytes or compiled
 * @param given   what the command wrote: `parameters` by the names of windshield.d.ts, `preset`, `surface`, the mesh of a
 *                glass, whose numbers are texts in base64, `warm_up` [s], `eye_distance` [m], `field_of_view` [rad],
 *                `background_blur` [rad], `background`, the URL of a picture
 * @param leave   called when the user closes the rain; without it nothing closes it
 * @return        `close`, a function that ends the rain and removes it
 */
export async function openRain(parent, wasm, given = {}, leave = undefined) {
    const root = document.createElement('div');
    root.className = 'live rain';
    parent.append(root);
    const state = document.documentElement.dataset;
    try {
        const rain = await Rain.open(root, wasm, given, leave);
        return { close: () => rain.close() };
    } catch (error) {
        const trouble = document.createElement('div');
        trouble.className = 'trouble';
        trouble.setAttribute('role', 'alert');
        trouble.textContent = say('The rain cannot be shown: {reason}', { reason: error.message });
        root.append(trouble);
        state.state = 'failed';
        throw error;
    }
}

class Rain {
    static async open(root, wasm, given, leave) {
        const canvas = document.createElement('canvas');
        canvas.setAttribute('aria-label', 'Rain on a windshield, from inside. Draw on it with a finger.');
        canvas.setAttribute('role', 'img');
        root.append(canvas);
        return new Rain(root, canvas, await loadRain(wasm), given, leave);
    }

    constructor(root, canvas, windshield, given, leave) {
        this.leave = leave;
        this.root = root;
        this.canvas = canvas;
        this.make = windshield;
        this.surface = given.surface && meshOf(given.surface);
        this.warm_up = given.warm_up ?? 20;
        /** Parameters, and values of the view. Never written to. */
        this.values = {
            preset: given.preset ?? 'figure-3.12', backdrop: given.background,
            wind: 0, distance: given.eye_distance ?? 0.3, blur: given.background_blur ?? 2.6 * Math.PI / 180, exposure: 1, runoff: 1,
            ...given.parameters,
        };
        this.fieldOfView = given.field_of_view;
        this.full = location.hash === '#full';  // sizes stay, for pictures of the page
        this.map = 0;  // of kMapWidths
        this.map_width = kMapWidths[0];
        this.scale = 0;  // of kScales
        this.tool = 'finger';
        this.ends = new AbortController();
        this.view = new View(canvas);
        this.restart();
        this.backdrop = new Backdrop(this.view, root, this.ends.signal, (backdrop) => this.panel.change({ backdrop }),
            (name, trouble) => this.panel?.showBackdrop(name, trouble));
        this.recorder = new Recorder(canvas, 'rain', () => this.panel.recordedNothing());
        this.panel = new Panel(root, this);
        if (given.background) {
            this.backdrop.show(given.background);
        }
        this.#followPointer();
        addEventListener('resize', () => this.#fit(), { signal: this.ends.signal });
        this.#fit();
        this.last = performance.now();
        requestAnimationFrame((now) => this.#frame(now));
    }

    /** Ends the rain, and takes it out of the page. */
    close() {
        this.ends.abort();
        this.recorder.stop();
        this.backdrop.show(undefined);
        this.view.close();
        this.windshield.free();
        this.root.remove();
    }

    /** A dry glass, and the rain on it until now. */
    restart() {
        this.windshield?.free();
        const { preset, backdrop, wind, distance, blur, exposure, ...parameters } = this.values;
        this.windshield = this.make({ preset, surface: this.surface, ...parameters, mapWidth: this.map_width });
        // Those that are not given are the preset's.
        this.values = { ...Object.fromEntries(parametersOf(this.surface).map((name) => [name, this.windshield.get(name)])), ...this.values };
        this.#setSpeed();
        this.view.setGlass(this.windshield);
        this.behind = 0;       // time that has passed and was not simulated [s]
        this.travelled = 0;    // [m]
        this.to_warm_up = this.warm_up;
        this.strokes = [];
        this.draws = true;
        this.panel?.showAll();
    }

    /** Values of a figure of the thesis, with what it does not have as it is. */
    valuesOf(figure) {
        const { backdrop, distance, blur, exposure, mist, runoff, splashes, glassWidth, glassHeight, seed } = this.values;
        return { preset: `figure-${figure}`, backdrop, wind: 0, distance, blur, exposure, mist, runoff, splashes, glassWidth, glassHeight, seed };
    }

    /** Puts other values into effect; another preset begins at once, another slope soon. */
    take(values) {
        const before = this.values;
        const lacks = parametersOf(this.surface).some((name) => values[name] === undefined);
        const differ = Object.keys(values).filter((name) => values[name] !== before[name]);
        this.values = values;
        if (lacks || differ.includes('preset')) {
            this.restart();
        } else if (differ.includes('slope')) {
            clearTimeout(this.soon);
            this.soon = setTimeout(() => this.ends.signal.aborted || this.restart(), 250);
        }
        for (const name of differ.filter((each) => each !== 'slope' && kWindshieldParameters.includes(each))) {
            this.windshield.set({ [name]: values[name] });
        }
        this.#setSpeed();
        if (differ.includes('backdrop')) {
            this.backdrop.show(values.backdrop);
        }
        this.draws = true;
    }

    /** Droplets feel the car's speed and the wind against it. */
    #setSpeed() {
        const { speed = this.windshield.get('speed'), wind } = this.values;
        this.windshield.set({ speed: Math.min(speed + wind, 150) });
    }

    get camera() {
        return { distance: this.values.distance, fieldOfView: this.fieldOfView };
    }

    #fit() {
        const ratio = Math.min(devicePixelRatio, 2) * kScales[this.scale];
        this.canvas.width = Math.max(Math.round(this.root.clientWidth * ratio), 16);
        this.canvas.height = Math.max(Math.round(this.root.clientHeight * ratio), 16);
        this.draws = true;
    }

    /** Smaller maps, or fewer pixels, if frames are slow. */
    #judge(busy, whole) {
        if (this.full || this.to_warm_up > 0) {
            return;
        }
        if (busy > kSlowMaps && this.map + 1 < kMapWidths.length) {
            this.map_width = this.windshield.mapWidth = kMapWidths[++this.map];
        } else if (whole > kSlowFrame && this.scale + 1 < kScales.length) {
            ++this.scale;
            this.#fit();
        }
    }

    #advance(seconds) {
        const before = this.windshield.figures().speed;
        this.windshield.advance(seconds);
        this.time = this.windshield.figures().time;
        this.travelled += Math.max(before - this.values.wind, 0) * seconds;
    }

    /** Rain before the first frame, some of it in each. */
    #warmUp() {
        const begin = performance.now();
        while (this.to_warm_up > 0 && performance.now() - begin < kWarmUpAtOnce) {
            const step = Math.min(1 / 30, this.to_warm_up);
            this.#advance(step);
            this.to_warm_up = this.to_warm_up - step < 1e-9 ? 0 : this.to_warm_up - step;
        }
    }

    /** What the pointers have done since the last step. */
    #touch() {
        for (const stroke of this.strokes.splice(0)) {
            this.windshield.finger(stroke);
        }
        for (const at of this.sprays?.values() ?? []) {
            this.windshield.spray({ ...at, radius: kSprayRadius, volume: kSprayed * kStep });
        }
    }

    #frame(now) {
        if (this.ends.signal.aborted) {
            return;
        }
        requestAnimationFrame((next) => this.#frame(next));
        const state = document.documentElement.dataset;
        const passed = Math.min((now - this.last) / 1000, 0.25);
        this.last = now;
        const begin = performance.now();
        if (this.to_warm_up > 0) {
            this.#warmUp();  // nothing is shown until it is done
            return;
        }
        if (!this.paused) {
            this.behind = Math.min(this.behind + passed, kStepsAtOnce * kStep + 1e-9);
            for (; this.behind >= kStep; this.behind -= kStep) {
                this.#touch();
                this.#advance(kStep);
            }
        } else if (this.strokes.length > 0) {
            this.#touch();
            this.draws = true;
        }
        if (!this.paused || this.draws) {
            this.view.setWater(this.windshield.draw());
            this.view.setMist(this.windshield.mist());
            this.view.setRunoff(this.windshield.runoff());
        }
        const busy = performance.now() - begin;
        if (!this.paused || this.draws || this.backdrop.moves) {
            this.#draw();
            this.draws = false;
        }
        state.state = this.paused ? 'paused' : 'running';
        state.frames = Number(state.frames ?? 0) + 1;
        this.root.classList.add('ready');
        this.#measure(busy, passed);
    }

    #measure(busy, passed) {
        const sums = this.sums ??= { busy: 0, whole: 0, frames: 0 };
        sums.busy += busy;
        sums.whole += 1000 * passed;
        if (++sums.frames < kFrames) {
            return;
        }
        const [mean, whole] = [sums.busy / kFrames, sums.whole / kFrames];
        this.sums = undefined;
        document.documentElement.dataset.busy = mean.toFixed(2);
        document.documentElement.dataset.map = this.windshield.mapWidth;
        this.panel.showFigures(this.windshield.figures(), mean, 1000 / whole);
        if (!this.paused) {
            this.#judge(mean, whole);
        }
    }

    #draw() {
        const { blur, exposure } = this.values;
        this.view.draw(this.windshield, { travelled: this.travelled, time: this.time ?? 0, blur, exposure, camera: this.camera, border: kBorder });
    }

    pause(paused = !this.paused) {
        this.paused = paused;
        this.behind = 0;
        this.panel.showPaused(paused);
    }

    /** Saves the frame as a picture; a canvas keeps it only until the browser shows it. */
    savePicture() {
        this.#draw();
        savePicture(this.canvas, 'rain');
    }

    /** The pointer is a finger, or a sprayer. */
    #followPointer() {
        const { canvas } = this;
        const last = new Map();
        this.sprays = new Map();
        const placed = ({ clientX, clientY }) => {
            const box = canvas.getBoundingClientRect();
            return this.view.onGlass(2 * (clientX - box.left) / box.width - 1, 1 - 2 * (clientY - box.top) / box.height, this.windshield, this.camera);
        };
        const spray = (event) => this.sprays.set(event.pointerId, placed(event));
        canvas.addEventListener('pointerdown', (event) => {
            canvas.setPointerCapture(event.pointerId);
            if (this.tool === 'spray') {
                spray(event);
                return;
            }
            const at = placed(event);
            last.set(event.pointerId, at);
            this.strokes.push({ from: at, to: { x: at.x + 1e-4, y: at.y }, width: kFinger });
        });
        canvas.addEventListener('pointermove', (event) => {
            this.panel.wake();
            if (this.sprays.has(event.pointerId)) {
                spray(event);
            }
            const from = last.get(event.pointerId);
            if (!from) {
                return;
            }
            const to = placed(event);
            if (Math.hypot(to.x - from.x, to.y - from.y) > 1e-3) {
                this.strokes.push({ from, to, width: kFinger });
                last.set(event.pointerId, to);
            }
        });
        for (const end of ['pointerup', 'pointercancel']) {
            canvas.addEventListener(end, ({ pointerId }) => {
                last.delete(pointerId);
                this.sprays.delete(pointerId);
            });
        }
    }
}
