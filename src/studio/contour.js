// SPDX-License-Identifier: MIT
// The rim of a mask as a path: marching squares, W. Lorensen and H. Cline's "Marching cubes" (1987) in the plane.

const kHalf = 127.5;
// Edges of the square between four pixels.
const [kTop, kRight, kBottom, kLeft] = [0, 1, 2, 3];
// From edge to edge, with liquid on the right, by the corners that are liquid: 1 top left, 2 top right, 4 bottom right, 8 bottom left.
const kSegments = [
    [], [[kTop, kLeft]], [[kRight, kTop]], [[kRight, kLeft]], [[kBottom, kRight]], [[kTop, kLeft], [kBottom, kRight]], [[kBottom, kTop]],
    [[kBottom, kLeft]], [[kLeft, kBottom]], [[kTop, kBottom]], [[kRight, kTop], [kLeft, kBottom]], [[kRight, kBottom]], [[kLeft, kRight]],
    [[kTop, kRight]], [[kLeft, kTop]], [],
];

/** Edges of squares, from which the rim goes to the next: a Map of numbers. The sheet has a dry margin of one pixel. */
function stepsOf(level, width, height) {
    const row = 2 * (width + 2);
    const steps = new Map();
    for (let y = -1; y < height; ++y) {
        for (let x = -1; x < width; ++x) {
            const corners = (level(x, y) > kHalf) | (level(x + 1, y) > kHalf) << 1 | (level(x + 1, y + 1) > kHalf) << 2 | (level(x, y + 1) > kHalf) << 3;
            const top = (y + 1) * row + 2 * (x + 1);
            const edges = [top, top + 3, top + row, top + 1];
            for (const [from, to] of kSegments[corners]) {
                steps.set(edges[from], edges[to]);
            }
        }
    }
    return steps;
}

/** Loops around what is more than half liquid, as the path of an SVG in pixels. */
export function rimPath({ width, height, data }) {
    const level = (x, y) => (x < 0 || y < 0 || x >= width || y >= height ? 0 : data[y * width + x]);
    const point = (edge) => {
        const [x, y] = [Math.floor(edge % (2 * (width + 2)) / 2) - 1, Math.floor(edge / (2 * (width + 2))) - 1];
        const [dx, dy] = edge % 2 === 0 ? [1, 0] : [0, 1];
        const [from, to] = [level(x, y), level(x + dx, y + dy)];
        const part = (kHalf - from) / (to - from);
        const within = (value, size) => Math.min(size, Math.max(0, value + 0.5)).toFixed(1);
        return `${within(x + part * dx, width)} ${within(y + part * dy, height)}`;
    };
    const steps = stepsOf(level, width, height);
    const loops = [];
    for (const first of steps.keys()) {
        const loop = [];
        for (let edge = first, next; (next = steps.get(edge)) !== undefined; edge = next) {
            loop.push(point(edge));
            steps.delete(edge);
        }
        loops.push(`M${loop.join('L')}Z`);
    }
    return loops.join('');
}
