// SPDX-License-Identifier: MIT
// Coverage of a sheet by liquid: {width, height, data}, a byte a pixel, 0 dry and 255 liquid. Drawing writes bytes here
// and not on a canvas, so that edges are exact and overlapping strokes do not thicken them.

export const blank = (width, height) => ({ width, height, data: new Uint8Array(width * height) });
export const copyOf = ({ width, height, data }) => ({ width, height, data: data.slice() });

/** Rectangle of pixels [left, right) × [top, bottom), cut to the sheet; null if it is empty. */
export function pixels(mask, left, top, right, bottom) {
    const rect = {
        left: Math.max(0, Math.floor(left)), top: Math.max(0, Math.floor(top)),
        right: Math.min(mask.width, Math.ceil(right)), bottom: Math.min(mask.height, Math.ceil(bottom)),
    };
    return rect.left < rect.right && rect.top < rect.bottom ? rect : null;
}

export const whole = ({ width, height }) => ({ left: 0, top: 0, right: width, bottom: height });

/** Smallest rectangle around both, of which either may be null. */
export function around(a, b) {
    return a && b ? {
        left: Math.min(a.left, b.left), top: Math.min(a.top, b.top),
        right: Math.max(a.right, b.right), bottom: Math.max(a.bottom, b.bottom),
    } : a ?? b;
}

export function isDry({ data }) {
    for (let i = 0; i < data.length; ++i) {
        if (data[i] > 0) {
            return false;
        }
    }
    return true;
}

/** Whether a pixel is liquid in both. */
export function overlap(a, b) {
    for (let i = 0; i < a.data.length; ++i) {
        if (a.data[i] >= 128 && b.data[i] >= 128) {
            return true;
        }
    }
    return false;
}

function put(data, at, coverage, removes) {
    data[at] = removes ? Math.min(data[at], 255 - coverage) : Math.max(data[at], coverage);
}

/** Copies the pixels of a rectangle. */
export function restore(mask, base, rect) {
    for (let y = rect.top; y < rect.bottom; ++y) {
        const at = y * mask.width;
        mask.data.set(base.data.subarray(at + rect.left, at + rect.right), at + rect.left);
    }
}

/**
 * Draws a piece of a stroke between two discs {x, y, radius} [pixels].
 * @return the rectangle that may have changed, or null
 */
export function drawPiece(mask, from, to, removes) {
    const most = Math.max(from.radius, to.radius) + 1;
    const rect = pixels(mask, Math.min(from.x, to.x) - most, Math.min(from.y, to.y) - most,
        Math.max(from.x, to.x) + most, Math.max(from.y, to.y) + most);
    if (!rect) {
        return null;
    }
    const [dx, dy, dr] = [to.x - from.x, to.y - from.y, to.radius - from.radius];
    const squared = dx * dx + dy * dy;
    for (let y = rect.top; y < rect.bottom; ++y) {
        for (let x = rect.left; x < rect.right; ++x) {
            const [px, py] = [x + 0.5 - from.x, y + 0.5 - from.y];
            const along = squared > 0 ? Math.min(1, Math.max(0, (px * dx + py * dy) / squared)) : 0;
            const inside = from.radius + along * dr + 0.5 - Math.hypot(px - along * dx, py - along * dy);
            if (inside > 0) {
                put(mask.data, y * mask.width + x, inside >= 1 ? 255 : Math.round(255 * inside), removes);
            }
        }
    }
    return rect;
}

/**
 * Draws what `paint` draws with a 2D canvas in opaque black.
 * @param box  {left, top, right, bottom} around it [pixels]
 * @return the rectangle that may have changed, or null
 */
export function drawShape(mask, box, paint, removes) {
    const rect = pixels(mask, box.left - 1, box.top - 1, box.right + 1, box.bottom + 1);
    if (!rect) {
        return null;
    }
    const [width, height] = [rect.right - rect.left, rect.bottom - rect.top];
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    context.translate(-rect.left, -rect.top);
    paint(context);
    const { data } = context.getImageData(0, 0, width, height);
    for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
            const coverage = data[4 * (y * width + x) + 3];
            if (coverage > 0) {
                put(mask.data, (rect.top + y) * mask.width + rect.left + x, coverage, removes);
            }
        }
    }
    return rect;
}

/** Shifts the liquid by whole pixels; what leaves the sheet is lost. */
export function shifted({ width, height, data }, dx, dy) {
    const result = blank(width, height);
    const [left, right] = [Math.max(0, -dx), Math.min(width, width - dx)];
    for (let y = Math.max(0, -dy); y < Math.min(height, height - dy) && left < right; ++y) {
        result.data.set(data.subarray(y * width + left, y * width + right), (y + dy) * width + left + dx);
    }
    return result;
}

/** Fills, or empties, the connected pixels that are less than half covered, or more. */
export function flood(mask, x, y, removes) {
    const { width, height, data } = mask;
    const inside = (at) => (data[at] >= 128) === removes;
    const start = Math.floor(y) * width + Math.floor(x);
    if (!pixels(mask, x, y, x + 1, y + 1) || !inside(start)) {
        return null;
    }
    const seen = new Uint8Array(width * height);
    const open = [start];
    seen[start] = 1;
    while (open.length > 0) {
        const at = open.pop();
        data[at] = removes ? 0 : 255;
        const column = at % width;
        // The edge's partly covered pixels become liquid, or dry, too; the flood does not go beyond them.
        for (const next of [column > 0 ? at - 1 : -1, column < width - 1 ? at + 1 : -1, at - width, at + width]) {
            if (next >= 0 && next < width * height && !seen[next]) {
                seen[next] = 1;
                if (inside(next)) {
                    open.push(next);
                } else {
                    data[next] = removes ? 0 : 255;
                }
            }
        }
    }
    return { left: 0, top: 0, right: width, bottom: height };
}
