// SPDX-License-Identifier: MIT
// Tools: each turns the points of a gesture into a changed mask. Pointer and keyboard drive them the same way.
import { around, copyOf, drawPiece, drawShape, flood, restore, shifted, whole } from './coverage.js';

/** Fonts of the text tool; every system has one of each kind. */
export const kFonts = { sans: 'system-ui, sans-serif', serif: 'Georgia, "DejaVu Serif", serif', round: 'ui-rounded, "Arial Rounded MT Bold", cursive', mono: 'ui-monospace, monospace' };

/** A gesture that draws piece by piece. */
function tracing(base, removes, setting, first) {
    const mask = copyOf(base);
    const disc = ({ x, y, pressure }) => ({ x, y, radius: Math.max(0.5, setting.size / 2 * pressure) });
    let last = disc(first);
    let changed = drawPiece(mask, last, last, removes);
    return {
        mask,
        started: changed,
        extend(point) {
            const next = disc(point);
            changed = drawPiece(mask, last, next, removes);
            last = next;
            return changed;
        },
    };
}

/** A gesture that draws one shape, again at every point. */
function shaping(base, first, draw) {
    const mask = copyOf(base);
    let old = draw(mask, first, first);
    return {
        mask,
        started: old,
        extend(point) {
            if (old) {
                restore(mask, base, old);
            }
            const now = draw(mask, first, point);
            const changed = around(old, now);
            old = now;
            return changed;
        },
    };
}

const boxOf = (a, b) => ({
    left: Math.min(a.x, b.x), top: Math.min(a.y, b.y), right: Math.max(a.x, b.x), bottom: Math.max(a.y, b.y),
});

/** The second corner; with Shift the shape is as wide as it is high. */
function corner(first, point) {
    if (!point.constrained) {
        return point;
    }
    const side = Math.max(Math.abs(point.x - first.x), Math.abs(point.y - first.y));
    return { ...point, x: first.x + Math.sign(point.x - first.x) * side, y: first.y + Math.sign(point.y - first.y) * side };
}

/** With Shift a line's direction is a multiple of 45°. */
function snapped(first, point) {
    if (!point.constrained) {
        return point;
    }
    const angle = Math.round(Math.atan2(point.y - first.y, point.x - first.x) / (Math.PI / 4)) * Math.PI / 4;
    const length = Math.hypot(point.x - first.x, point.y - first.y);
    return { ...point, x: first.x + length * Math.cos(angle), y: first.y + length * Math.sin(angle) };
}

/** Box of a text whose middle is at a point, and what paints it. */
function textAt({ text, font, text_size }, { x, y }) {
    const style = `600 ${text_size}px ${kFonts[font] ?? kFonts.sans}`;
    const context = new OffscreenCanvas(1, 1).getContext('2d');
    context.font = style;
    const lines = text.split('\n');
    const half = Math.max(...lines.map((line) => context.measureText(line).width)) / 2 + text_size / 2;
    const height = lines.length * text_size * 1.15;
    return {
        box: { left: x - half, top: y - height / 2 - text_size / 2, right: x + half, bottom: y + height / 2 + text_size / 2 },
        paint(canvas) {
            canvas.font = style;
            canvas.textAlign = 'center';
            canvas.textBaseline = 'middle';
            lines.forEach((line, k) => canvas.fillText(line, x, y + (k - (lines.length - 1) / 2) * text_size * 1.15));
        },
    };
}

/**
 * Tools by name. `begin(base, removes, setting, point)` returns {mask, started, extend}: the mask so far, the rectangle
 * that has changed, and what takes the next point {x, y, pressure, constrained} and returns the next such rectangle.
 * `at_once`: the first point is the last.
 */
export const kTools = {
    brush: { name: 'Brush', key: 'b', sized: true, begin: tracing },
    eraser: { name: 'Eraser', key: 'e', sized: true, begin: (base, removes, setting, point) => tracing(base, !removes, setting, point) },
    line: {
        name: 'Line', key: 'l', sized: true,
        begin: (base, removes, { size }, point) => shaping(base, point, (mask, first, last) => {
            const end = snapped(first, last);
            return drawPiece(mask, { ...first, radius: size / 2 }, { ...end, radius: size / 2 }, removes);
        }),
    },
    rectangle: {
        name: 'Rectangle', key: 'r',
        begin: (base, removes, setting, point) => shaping(base, point, (mask, first, last) => {
            const box = boxOf(first, corner(first, last));
            return drawShape(mask, box, (canvas) => canvas.fillRect(box.left, box.top, box.right - box.left, box.bottom - box.top), removes);
        }),
    },
    ellipse: {
        name: 'Ellipse', key: 'o',
        begin: (base, removes, setting, point) => shaping(base, point, (mask, first, last) => {
            const box = boxOf(first, corner(first, last));
            return drawShape(mask, box, (canvas) => {
                canvas.ellipse((box.left + box.right) / 2, (box.top + box.bottom) / 2, (box.right - box.left) / 2,
                    (box.bottom - box.top) / 2, 0, 0, 2 * Math.PI);
                canvas.fill();
            }, removes);
        }),
    },
    lasso: {
        name: 'Outline', key: 'p',
        begin: (base, removes, setting, point) => {
            const points = [point];
            let box = boxOf(point, point);
            return shaping(base, point, (mask, first, last) => {
                points.push(last);
                box = boxOf({ x: Math.min(box.left, last.x), y: Math.min(box.top, last.y) },
                    { x: Math.max(box.right, last.x), y: Math.max(box.bottom, last.y) });
                return drawShape(mask, box, (canvas) => {
                    points.forEach(({ x, y }) => canvas.lineTo(x, y));
                    canvas.fill();
                }, removes);
            });
        },
    },
    text: {
        name: 'Text', key: 't', written: true,
        begin: (base, removes, setting, point) => shaping(base, point, (mask, first, last) => {
            const { box, paint } = textAt(setting, last);
            return drawShape(mask, box, paint, removes);
        }),
    },
    fill: {
        name: 'Fill', key: 'g', at_once: true,
        begin: (base, removes, setting, { x, y }) => {
            const mask = copyOf(base);
            return { mask, started: flood(mask, x, y, removes), extend: () => null };
        },
    },
    move: {
        name: 'Move', key: 'v',
        begin: (base, removes, setting, first) => {
            const mask = copyOf(base);
            return {
                mask,
                started: null,
                extend({ x, y }) {
                    mask.data = shifted(base, Math.round(x - first.x), Math.round(y - first.y)).data;
                    return whole(mask);
                },
            };
        },
    },
};
