// SPDX-License-Identifier: MIT
// A 2D liquid in a page: the simulation, its outlines on a canvas, what the pointer does, and the controls.
import { loadLiquid2d } from '../../npm/liquid2d.js';
import { say } from '../html/words.js';
import { download, Recorder, savePicture } from '../live/recorder.js';
import { kPresets } from './controls.js';
import { LottieRecorder } from './lottie_recorder.js';
import { Panel } from './panel.js';

const kLongest = 1 / 24;    // step of a frame [s]; where frames take longer, the liquid is slower than time
const kShortest = 1 / 120;
const kFrames = 24;         // after which figures are shown
/** Sizes of tools over the window's height. */
const kRadius = { pour: 0.03, drop: 0.1, stir: 0.09 };
const kFall = 2;            // speed of liquid that is poured or dropped [m/s]
const kFastest = 8;         // stirrer [m/s]; as fast as what has fallen 3 m
const kMargin = 0.25;       // around the window, for its walls [m]
const kBarHeight = 92;      // [CSS px] below the window
const kPanelWidth = 328;    // [CSS px] beside it
const kWide = 900;          // [CSS px], from which on the panel is open at first
const kSvgWidth = 1280;     // [px]
const kSolidWidth = 1024;   // [px]

/**
 * Fills an element with a liquid.
 * @param parent  element, empty or not
 * @param wasm    droplet_liquid.wasm, as bytes or compiled
 * @param given   `draw(canvas, title)`, which takes a drawing to make droplets of
 * @param leave   called when the user closes the liquid
 * @return        `close`, a function that ends the liquid and removes it
 */
export async function openLiquid(parent, wasm, given, leave) {
    const root = document.createElement('div');
    root.className = 'live liquid2d';
    const canvas = document.createElement('canvas');
    canvas.setAttribute('aria-label', 'A liquid in a basin. Pour, drop or stir with the pointer.');
    canvas.setAttribute('role', 'img');
    root.append(canvas);
    parent.append(root);
    const liquid = new Liquid(root, canvas, await loadLiquid2d(wasm), given, leave);
    return { close: () => liquid.close() };
}

/** A path of the canvas through outlines. */
function pathOf(outlines) {
    const path = new Path2D();
    for (const points of outlines) {
        path.moveTo(points[0], points[1]);
        for (let k = 2; k < points.length; k += 2) {
            path.lineTo(points[k], points[k + 1]);
        }
        path.closePath();
    }
    return path;
}

class Liquid {
    constructor(root, canvas, { make, look }, { draw }, leave) {
        Object.assign(this, { root, canvas, make, look, draw, leave });
        this.context = canvas.getContext('2d', { alpha: false });
        this.values = { preset: 'splash', style: 'cartoon', look: 'comic', particles: 10000, record: 'video' };
        this.tool = 'pour';
        this.ends = new AbortController();
        this.pointers = new Map();
        this.recorders = { video: new Recorder(canvas, 'splash', () => this.panel.recordedNothing()), lottie: new LottieRecorder(this) };
        if (!this.recorder.works) {
            this.values.record = 'lottie';
        }
        this.restart();
        this.values = { ...this.values, ...Object.fromEntries(['gravity', 'surfaceTension'].map((name) => [name, this.liquid.get(name)])) };
        this.panel = new Panel(root, this);
        if (root.clientWidth >= kWide) {
            this.panel.act('panel');
        }
        this.#followPointer();
        this.#dress();
        this.sizes = new ResizeObserver(() => this.#fit());
        this.sizes.observe(root);
        this.#fit();
        this.last = performance.now();
        requestAnimationFrame((now) => this.#frame(now));
    }

    /** Ends the liquid, and takes it out of the page. */
    close() {
        this.ends.abort();
        this.sizes.disconnect();
        this.recorder.stop();
        this.liquid.free();
        this.root.remove();
    }

    get recorder() {
        return this.recorders[this.values.record];
    }

    /** The scene from its start. It ends a recording of outlines. */
    restart() {
        if (this.recorders.lottie.runs) {
            this.panel.act('record');
        }
        this.liquid?.free();
        const { look, record, ...values } = this.values;
        this.liquid = this.make(values);
        this.outlines = this.liquid.outlines();
        this.draws = true;
        this.panel?.showAll();
    }

    /** Puts other values into effect; another scene begins at once, another number of particles soon. */
    take(values) {
        const before = this.values;
        const differ = (...names) => names.some((name) => values[name] !== before[name]);
        if (differ('record') && this.recorder.runs) {
            this.panel.act('record');
        }
        this.values = values;
        if (differ('preset')) {
            this.restart();
            this.#fit();
        } else if (differ('particles')) {
            clearTimeout(this.soon);
            this.soon = setTimeout(() => this.ends.signal.aborted || this.restart(), 250);
        }
        if (differ('style')) {
            this.liquid.style = values.style;
            this.outlines = this.liquid.outlines();
        }
        if (differ('look')) {
            this.#dress();
        }
        const { gravity, surfaceTension } = values;
        this.liquid.set({ gravity, surfaceTension });
        this.draws = true;
    }

    #dress() {
        this.colours = this.look(this.values.look);
        this.root.classList.toggle('dark', this.values.look === 'night');
    }

    /** Puts the window between bar and panel. */
    #fit() {
        const ratio = Math.min(devicePixelRatio, 2);
        const { clientWidth: wide, clientHeight: high } = this.root;
        this.canvas.width = Math.max(Math.round(wide * ratio), 16);
        this.canvas.height = Math.max(Math.round(high * ratio), 16);
        const { width, height } = this.liquid.figures();
        const free = wide >= kWide ? wide - kPanelWidth : wide;
        const scale = Math.max(Math.min(free / (width + 2 * kMargin), (high - kBarHeight) / (height + 2 * kMargin)), 1);
        this.place = { scale, left: (free - scale * width) / 2, bottom: (high - kBarHeight + scale * height) / 2, ratio };
        this.draws = true;
    }

    /** What the pointers do in a step. */
    #touch(seconds) {
        const { height } = this.liquid.figures();
        for (const pointer of this.pointers.values()) {
            const { tool, at, from } = pointer;
            const radius = kRadius[tool] * height;
            if (tool === 'stir') {
                const way = Math.hypot(at.x - from.x, at.y - from.y);
                const part = Math.min(1, kFastest * seconds / Math.max(way, 1e-9));
                this.liquid.stir({ from: { x: at.x - part * (at.x - from.x), y: at.y - part * (at.y - from.y) }, to: at, radius, seconds });
                pointer.from = at;
            } else if (tool === 'pour' || !pointer.dropped) {
                this.liquid.pour({ ...at, radius, vy: -kFall });
                pointer.dropped = true;
            }
            if (pointer.ended) {
                this.pointers.delete(pointer.id);
            }
        }
    }

    #frame(now) {
        if (this.ends.signal.aborted) {
            return;
        }
        requestAnimationFrame((next) => this.#frame(next));
        const state = document.documentElement.dataset;
        const passed = (now - this.last) / 1000;
        this.last = now;
        const begin = performance.now();
        if (!this.paused) {
            const step = Math.min(Math.max(passed, kShortest), kLongest);
            this.#touch(step);
            this.liquid.advance(step);
            this.outlines = this.liquid.outlines();
            this.recorders.lottie.keep();
            this.draws = true;
        }
        const busy = performance.now() - begin;
        if (this.draws) {
            this.#draw();
            this.draws = false;
        }
        const { particles, speed } = this.liquid.figures();
        Object.assign(state, { state: this.paused ? 'paused' : 'running', frames: Number(state.frames ?? 0) + 1, particles, speed });
        this.root.classList.add('ready');
        this.#measure(busy, passed);
    }

    #measure(busy, passed) {
        const sums = this.sums ??= { busy: 0, whole: 0, frames: 0 };
        sums.busy += busy;
        sums.whole += passed;
        if (++sums.frames === kFrames) {
            document.documentElement.dataset.busy = (sums.busy / kFrames).toFixed(2);
            this.panel.showFigures(this.liquid.figures(), sums.busy / kFrames, kFrames / sums.whole);
            this.sums = undefined;
        }
    }

    #draw() {
        const { context, colours, place, outlines } = this;
        const { scale, left, bottom, ratio } = place;
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.fillStyle = colours.background ?? getComputedStyle(this.root).backgroundColor;
        context.fillRect(0, 0, this.canvas.width, this.canvas.height);
        context.setTransform(scale * ratio, 0, 0, -scale * ratio, left * ratio, bottom * ratio);
        const { width, height } = this.liquid.figures();
        context.strokeStyle = colours.line;
        context.lineWidth = 1e-3 * colours.lineWidth * width;
        context.lineJoin = 'round';
        for (const [layer, fill] of [['liquid', colours.water], ['droplets', colours.droplet], ['foam', colours.foam]]) {
            if (fill) {
                const path = pathOf(outlines[layer]);
                context.fillStyle = fill;
                context.fill(path);
                if (colours.lineWidth > 0) {
                    context.stroke(path);
                }
            }
        }
        context.fillStyle = colours.wall;
        for (const wall of outlines.walls) {  // one by one: they may overlap
            context.fill(pathOf([wall]));
        }
        if (this.hover && !this.recorder.runs) {
            context.beginPath();
            context.arc(this.hover.x, this.hover.y, kRadius[this.tool] * height, 0, 2 * Math.PI);
            context.lineWidth = 1.5 / scale;
            context.strokeStyle = this.values.look === 'night' ? 'rgb(255 255 255 / 55%)' : 'rgb(29 39 48 / 45%)';
            context.stroke();
        }
    }

    pause(paused = !this.paused) {
        this.paused = paused;
        this.panel.showPaused(paused);
    }

    savePicture() {
        this.hover = undefined;
        this.#draw();
        savePicture(this.canvas, 'splash');
    }

    saveSvg() {
        download(new Blob([this.liquid.svg(this.values.look, kSvgWidth)], { type: 'image/svg+xml' }), 'splash.svg');
    }

    /** Gives the liquid, without foam and walls, to be made droplets of. */
    makeSolid() {
        const { width, height } = this.liquid.figures();
        const scale = kSolidWidth / Math.max(width, height);
        const canvas = document.createElement('canvas');
        canvas.width = Math.round(scale * width);
        canvas.height = Math.round(scale * height);
        const context = canvas.getContext('2d', { willReadFrequently: true });
        context.setTransform(scale, 0, 0, -scale, 0, canvas.height);
        context.fill(pathOf([...this.outlines.liquid, ...this.outlines.droplets]));
        const { draw, values } = this;
        this.leave();
        draw(canvas, say(kPresets[values.preset][0]));
    }

    #followPointer() {
        const { canvas, pointers } = this;
        const placed = ({ clientX, clientY }) => {
            const { scale, left, bottom } = this.place;
            const box = canvas.getBoundingClientRect();
            return { x: (clientX - box.left - left) / scale, y: (bottom - (clientY - box.top)) / scale };
        };
        canvas.addEventListener('pointerdown', (event) => {
            canvas.setPointerCapture(event.pointerId);
            const at = placed(event);
            pointers.set(event.pointerId, { id: event.pointerId, tool: this.tool, at, from: at });
        });
        canvas.addEventListener('pointermove', (event) => {
            this.hover = event.pointerType === 'touch' ? undefined : placed(event);
            this.draws = true;
            const pointer = pointers.get(event.pointerId);
            if (pointer && !pointer.ended) {
                pointer.at = placed(event);
            }
        });
        canvas.addEventListener('pointerleave', () => {
            this.hover = undefined;
            this.draws = true;
        });
        for (const end of ['pointerup', 'pointercancel']) {
            canvas.addEventListener(end, ({ pointerId }) => {
                const pointer = pointers.get(pointerId);
                if (pointer) {
                    pointer.ended = true;  // after the next step, so that no touch is too short
                }
            });
        }
    }
}
