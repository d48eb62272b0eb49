// SPDX-License-Identifier: MIT
// The edge of a glass, which may have any outline: sides that one of its triangles has alone.

const kSame = 1e-5;  // corners nearer to each other are one [m]
const kVectors = ['point', 'normal', 'across', 'up'];

/** Part of the way from a corner to another. */
function between(from, to, share) {
    const mixed = (a, b) => a + share * (b - a);
    return {
        x: mixed(from.x, to.x), y: mixed(from.y, to.y),
        ...Object.fromEntries(kVectors.map((name) => [name, from[name].map((value, k) => mixed(value, to[name][k]))])),
    };
}

/** How far along a side, from 0 to 1, the place nearest to a position is, and its distance. */
function nearestOn({ from, to }, x, y) {
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const share = Math.min(Math.max(((x - from.x) * dx + (y - from.y) * dy) / (dx * dx + dy * dy), 0), 1);
    return { share, distance: Math.hypot(from.x + share * dx - x, from.y + share * dy - y) };
}

export class Edge {
    /** @param triangles  of the windshield */
    constructor(triangles) {
        const named = ({ x, y }) => `${Math.round(x / kSame)},${Math.round(y / kSame)}`;
        const sides = new Map();
        for (const corners of triangles) {
            corners.forEach((from, k) => {
                const to = corners[(k + 1) % 3];
                const name = [named(from), named(to)].sort().join(' ');
                sides.set(name, sides.has(name) || named(from) === named(to) ? undefined : { from, to });
            });
        }
        this.sides = [...sides.values()].filter((side) => side);
    }

    /** The corner of the edge, or the place on it, that is nearest to a position. */
    nearest(x, y) {
        let [best, share, distance] = [undefined, 0, Infinity];
        for (const side of this.sides) {
            const found = nearestOn(side, x, y);
            if (found.distance < distance) {
                [best, share, distance] = [side, found.share, found.distance];
            }
        }
        return between(best.from, best.to, share);
    }

    /**
     * Distances from the edge, as a map of the glass: row by row from the upper left [m].
     * @param glass   width and height of the glass [m]
     * @param size    of the map [px]
     * @param reach   larger distances are this one [m]
     */
    distances([glass_width, glass_height], [width, height], reach) {
        const map = new Float32Array(width * height).fill(reach);
        const [column, row] = [glass_width / width, glass_height / height];
        const pixels = (from, to, step, count) =>
            [Math.max(Math.floor((Math.min(from, to) - reach) / step), 0), Math.min(Math.ceil((Math.max(from, to) + reach) / step), count)];
        for (const side of this.sides) {
            const [left, right] = pixels(side.from.x, side.to.x, column, width);
            const [top, bottom] = pixels(glass_height - side.from.y, glass_height - side.to.y, row, height);
            for (let j = top; j < bottom; ++j) {
                for (let i = left; i < right; ++i) {
                    const { distance } = nearestOn(side, (i + 0.5) * column, glass_height - (j + 0.5) * row);
                    map[j * width + i] = Math.min(map[j * width + i], distance);
                }
            }
        }
        return map;
    }
}
