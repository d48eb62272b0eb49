// SPDX-License-Identifier: MIT
// A bottle of green glass on a table, to try: a curve that turns around an axis.

const kAround = 96;
// Radius and height of the outline's corners [mm], and how far each is rounded.
const kOutline = [[0, 0, 0], [31, 0, 3], [32, 92, 16], [13.5, 138, 18], [12.2, 182, 2], [14, 184, 1.5], [14, 192, 2], [0, 192, 0]];
const kSteps = 8;  // of a rounded corner
const kRise = 4;   // longest step along the outline [mm]

/** The outline with its corners rounded by parabolas. */
function rounded() {
    const points = [];
    const add = (x, y) => {
        const [from_x, from_y] = points.at(-1) ?? [x, y];
        const count = Math.max(1, Math.ceil(Math.hypot(x - from_x, y - from_y) / kRise));
        for (let k = points.length === 0 ? count : 1; k <= count; ++k) {
            points.push([from_x + (x - from_x) * k / count, from_y + (y - from_y) * k / count]);
        }
    };
    kOutline.forEach(([x, y, reach], i) => {
        if (reach === 0) {
            add(x, y);
            return;
        }
        const [before, after] = [kOutline[i - 1], kOutline[i + 1]].map(([to_x, to_y]) => {
            const share = reach / Math.hypot(to_x - x, to_y - y);
            return [x + (to_x - x) * share, y + (to_y - y) * share];
        });
        for (let k = 0; k <= kSteps; ++k) {
            const t = k / kSteps;
            const [a, b, c] = [(1 - t) ** 2, 2 * t * (1 - t), t ** 2];
            add(a * before[0] + b * x + c * after[0], a * before[1] + b * y + c * after[1]);
        }
    });
    return points;
}

/** The bottle as an object for the solver: an .obj with its material. */
export function bottle() {
    const outline = rounded();
    const lines = ['mtllib bottle.mtl', 'usemtl glass'];
    const inner = outline.slice(1, -1);
    for (const [radius, height] of inner) {
        for (let k = 0; k < kAround; ++k) {
            const angle = 2 * Math.PI * k / kAround;
            lines.push(`v ${(radius * Math.sin(angle)).toFixed(4)} ${height.toFixed(4)} ${(radius * Math.cos(angle)).toFixed(4)}`);
        }
    }
    const poles = [inner.length * kAround + 1, inner.length * kAround + 2];
    lines.push('v 0 0 0', `v 0 ${outline.at(-1)[1]} 0`);
    const at = (ring, k) => 1 + ring * kAround + k % kAround;
    for (let k = 0; k < kAround; ++k) {
        lines.push(`f ${poles[0]} ${at(0, k + 1)} ${at(0, k)}`, `f ${poles[1]} ${at(inner.length - 1, k)} ${at(inner.length - 1, k + 1)}`);
        for (let ring = 0; ring + 1 < inner.length; ++ring) {
            lines.push(`f ${at(ring, k)} ${at(ring, k + 1)} ${at(ring + 1, k + 1)}`, `f ${at(ring, k)} ${at(ring + 1, k + 1)} ${at(ring + 1, k)}`);
        }
    }
    const text = (all) => new TextEncoder().encode(`${all.join('\n')}\n`);
    return {
        name: 'bottle.obj', data: text(lines),
        beside: { 'bottle.mtl': text(['newmtl glass', 'Kd 0.03 0.16 0.09', 'Ks 0.5 0.5 0.5', 'Ns 500']) },
    };
}
