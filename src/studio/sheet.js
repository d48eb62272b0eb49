// SPDX-License-Identifier: MIT
// The sheet to draw on: shows the layers, and turns pointers and keys into gestures of the tools.
import { around, whole } from './coverage.js';
import { kTools } from './tools.js';

const kLargestZoom = 16;
const kOtherLayers = 0.45;  // opacity of layers that are not selected
const kMargin = 20;         // around the sheet [CSS px]

/** Writes the layers' colours, bottom first: {data, ink, strength}. */
function compose(image, layers, { left, top, right, bottom }) {
    const { width, data } = image;
    for (let y = top; y < bottom; ++y) {
        for (let at = y * width + left; at < y * width + right; ++at) {
            let [red, green, blue, alpha] = [0, 0, 0, 0];
            for (const layer of layers) {
                const share = layer.data[at] * layer.strength;
                if (share > 0) {
                    const rest = 1 - share;
                    red = red * rest + layer.ink[0] * share;
                    green = green * rest + layer.ink[1] * share;
                    blue = blue * rest + layer.ink[2] * share;
                    alpha = alpha * rest + share;
                }
            }
            if (alpha > 0) {
                data[4 * at] = red / alpha;
                data[4 * at + 1] = green / alpha;
                data[4 * at + 2] = blue / alpha;
            }
            data[4 * at + 3] = 255 * alpha;
        }
    }
}

export class Sheet {
    /**
     * @param elements  {table, paper, sheet, cursor, fit}
     * @param ask       {layers(): [{data, ink, selected}], base(): the mask to draw on, or null, tool(): {name, removes, setting}}
     * @param tell      {began(), drew(mask, rect, time), ended(mask), gaveUp(), moved(x, y)}
     */
    constructor(elements, ask, tell) {
        Object.assign(this, { ...elements, ask, tell });
        this.context = this.sheet.getContext('2d', { alpha: true, desynchronized: false });
        this.touches = new Map();
        this.place = { zoom: 1, x: 0, y: 0 };
        this.#listen();
        new ResizeObserver(() => this.#lay()).observe(this.table);
    }

    /** Sets the sheet's sides [pixels], and the ruling's step as a part of the width. */
    resize(width, height, step) {
        if (this.image?.width !== width || this.image?.height !== height) {
            Object.assign(this.sheet, { width, height });
            this.image = new ImageData(width, height);
            this.keys = { x: width / 2, y: height / 2 };
            this.whole();
        }
        this.step = step;
        this.#lay();
    }

    whole() {
        this.place = { zoom: 1, x: 0, y: 0 };
        this.#lay();
    }

    /** Draws the layers again where they changed. */
    paint(rect = whole(this.image)) {
        const layers = this.ask.layers().map(({ data, ink, selected }) => ({ data, ink, strength: (selected ? 0.92 : kOtherLayers) / 255 }));
        compose(this.image, layers, rect);
        this.context.putImageData(this.image, 0, 0, rect.left, rect.top, rect.right - rect.left, rect.bottom - rect.top);
    }

    /** Fits the paper into the table, then zooms. */
    #lay() {
        const { table, paper, place, image } = this;
        const [wide, high] = [table.clientWidth - 2 * kMargin, table.clientHeight - 2 * kMargin];
        if (!image || wide <= 0 || high <= 0) {
            return;
        }
        const fit = Math.min(wide / image.width, high / image.height);
        const [width, height] = [image.width * fit, image.height * fit];
        Object.assign(paper.style, { width: `${width}px`, height: `${height}px` });
        const limit = (value, size) => Math.min(size / 2, Math.max(-size / 2, value));
        place.x = place.zoom === 1 ? 0 : limit(place.x, width * place.zoom);
        place.y = place.zoom === 1 ? 0 : limit(place.y, height * place.zoom);
        const left = (table.clientWidth - width * place.zoom) / 2 + place.x;
        const top = (table.clientHeight - height * place.zoom) / 2 + place.y;
        paper.style.transform = `translate(${left}px, ${top}px) scale(${place.zoom})`;
        paper.style.setProperty('--zoom', place.zoom);
        const step = this.step * width;
        paper.style.backgroundSize = `${step}px ${step}px`;
        paper.style.backgroundPosition = `${(width / 2) % step}px ${(height / 2) % step}px`;
        this.scale = fit * place.zoom;
        this.fit.hidden = place.zoom === 1;
        this.#showCursor();
    }

    #zoom(factor, x, y) {
        const { place, table } = this;
        const zoom = Math.min(kLargestZoom, Math.max(1, place.zoom * factor));
        const box = table.getBoundingClientRect();
        const [dx, dy] = [x - box.left - box.width / 2, y - box.top - box.height / 2];
        place.x = dx - (dx - place.x) * zoom / place.zoom;
        place.y = dy - (dy - place.y) * zoom / place.zoom;
        place.zoom = zoom;
        this.#lay();
    }

    /** A pointer's place on the sheet. */
    #point(event) {
        const box = this.sheet.getBoundingClientRect();
        return {
            x: (event.clientX - box.left) * this.image.width / box.width,
            y: (event.clientY - box.top) * this.image.height / box.height,
            pressure: event.pointerType === 'pen' && event.pressure > 0 ? 0.25 + 0.95 * event.pressure : 1,
            constrained: event.shiftKey,
        };
    }

    #begin(point, time) {
        const base = this.ask.base();
        if (!base) {
            return;
        }
        const { name, removes, setting } = this.ask.tool();
        this.tell.began();
        this.gesture = kTools[name].begin(base, removes, setting, point);
        this.#drew(this.gesture.started, time);
        if (kTools[name].at_once) {
            this.#end();
        }
    }

    #drew(rect, time) {
        if (rect) {
            this.changed = true;
            this.tell.drew(this.gesture.mask, rect, time);
        }
    }

    #end() {
        const { gesture, changed } = this;
        this.gesture = undefined;
        this.changed = false;
        if (gesture && changed) {
            this.tell.ended(gesture.mask);
        } else if (gesture) {
            this.tell.gaveUp();
        }
    }

    /** Gives the gesture up. */
    cancel() {
        if (this.gesture) {
            this.gesture = undefined;
            this.changed = false;
            this.tell.gaveUp();
        }
    }

    #listen() {
        const { sheet, table } = this;
        // On the whole table, so that a stroke may begin, and a finger rest, beside the sheet.
        table.addEventListener('pointerdown', (event) => {
            if (event.button !== 0 || event.target.closest('button')) {
                return;
            }
            event.preventDefault();
            sheet.focus({ preventScroll: true, focusVisible: false });
            if (event.pointerType === 'touch') {
                this.touches.set(event.pointerId, event);
            }
            table.setPointerCapture(event.pointerId);
            if (this.touches.size > 1 || (this.has_pen && event.pointerType === 'touch')) {
                this.cancel();  // two fingers move the sheet; beside a pen, one does
                this.drawing = undefined;
                return;
            }
            this.has_pen ||= event.pointerType === 'pen';
            this.drawing = event.pointerId;
            this.by_keys = false;
            this.#begin(this.#point(event), event.timeStamp);
        });
        table.addEventListener('pointermove', (event) => {
            if (this.touches.has(event.pointerId) && this.drawing !== event.pointerId) {
                this.#slide(event);
                return;
            }
            const point = this.#point(event);
            if (event.pointerType !== 'touch') {
                this.#showCursor(point);
            }
            if (this.drawing === event.pointerId && this.gesture) {
                const events = event.getCoalescedEvents?.() ?? [];
                let rect = null;
                for (const each of events.length > 0 ? events : [event]) {
                    rect = around(rect, this.gesture.extend(this.#point(each)));
                }
                this.#drew(rect, event.timeStamp);
            }
        });
        const up = (event) => {
            this.touches.delete(event.pointerId);
            if (this.drawing === event.pointerId) {
                this.drawing = undefined;
                this.#end();
            }
        };
        table.addEventListener('pointerup', up);
        table.addEventListener('pointercancel', (event) => {
            this.touches.delete(event.pointerId);
            if (this.drawing === event.pointerId) {
                this.drawing = undefined;
                this.cancel();
            }
        });
        table.addEventListener('pointerleave', () => this.#showCursor());
        table.addEventListener('wheel', (event) => {
            event.preventDefault();
            if (event.ctrlKey || event.metaKey) {
                this.#zoom(Math.exp(-0.006 * event.deltaY), event.clientX, event.clientY);
            } else {
                this.place.x -= event.deltaX;
                this.place.y -= event.deltaY;
                this.#lay();
            }
        }, { passive: false });
        this.fit.addEventListener('click', () => this.whole());
        sheet.addEventListener('keydown', (event) => this.#key(event));
        sheet.addEventListener('blur', () => {
            this.by_keys = false;
            this.cancel();
            this.#showCursor();
        });
    }

    /** Two fingers zoom and shift the sheet; beside a pen, one shifts it. */
    #slide(event) {
        const before = [...this.touches.values()];
        this.touches.set(event.pointerId, event);
        const after = [...this.touches.values()];
        const middle = (list) => [list.reduce((sum, { clientX }) => sum + clientX, 0) / list.length,
            list.reduce((sum, { clientY }) => sum + clientY, 0) / list.length];
        const spread = (list) => (list.length > 1 ? Math.hypot(list[0].clientX - list[1].clientX, list[0].clientY - list[1].clientY) : 1);
        const [[x0, y0], [x, y]] = [middle(before), middle(after)];
        this.place.x += x - x0;
        this.place.y += y - y0;
        this.#zoom(spread(after) / Math.max(spread(before), 1), x, y);
    }

    /** Arrows move the cursor of the keyboard; Space begins and ends a gesture. */
    #key(event) {
        const { keys, image } = this;
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        const point = { ...keys, pressure: 1, constrained: false };
        if (way && !event.altKey) {
            const far = Math.max(image.width, image.height);
            const step = event.shiftKey ? 1 : Math.round(far / (event.ctrlKey || event.metaKey ? 10 : 64));
            keys.x = Math.min(image.width, Math.max(0, keys.x + way[0] * step));
            keys.y = Math.min(image.height, Math.max(0, keys.y + way[1] * step));
            if (this.gesture) {
                this.#drew(this.gesture.extend({ ...keys, pressure: 1, constrained: false }), event.timeStamp);
            }
            this.tell.moved(keys.x, keys.y);
        } else if (event.key === ' ' || event.key === 'Enter') {
            if (event.repeat) {
                return;
            }
            if (this.gesture) {
                this.#end();
            } else if (event.key === ' ') {
                this.#begin(point, event.timeStamp);
                if (this.gesture && this.ask.tool().name === 'text') {
                    this.#end();
                }
            }
        } else if (event.key === 'Escape' && this.gesture) {
            this.cancel();
        } else {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
        this.by_keys = true;
        this.#showCursor();
    }

    /** Shows the brush at the pointer, or the keyboard's cursor. */
    #showCursor(point) {
        const { cursor, by_keys } = this;
        const at = by_keys ? this.keys : point;
        cursor.hidden = !at;
        if (!at) {
            return;
        }
        const { name, setting } = this.ask.tool();
        const size = kTools[name].sized ? Math.max(setting.size * this.scale / this.place.zoom, 3) : by_keys ? 6 : 0;
        cursor.hidden = size === 0;
        cursor.classList.toggle('keys', by_keys === true);
        Object.assign(cursor.style, {
            width: `${size}px`, height: `${size}px`,
            left: `${100 * at.x / this.image.width}%`, top: `${100 * at.y / this.image.height}%`,
        });
    }
}
