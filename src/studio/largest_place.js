// SPDX-License-Identifier: MIT
// Where a drawing has most room.

const kPlaces = 96;  // steps along the longer side of a sheet

/** Bounds of what is liquid in any of the masks; undefined if all are dry. */
export function boundsOf(masks) {
    const bounds = { left: Infinity, top: Infinity, right: 0, bottom: 0 };
    for (const { width, data } of masks) {
        data.forEach((coverage, i) => {
            if (coverage > 0) {
                const [x, y] = [i % width, Math.floor(i / width)];
                bounds.left = Math.min(bounds.left, x);
                bounds.top = Math.min(bounds.top, y);
                bounds.right = Math.max(bounds.right, x + 1);
                bounds.bottom = Math.max(bounds.bottom, y + 1);
            }
        });
    }
    return bounds.right > 0 ? bounds : undefined;
}

/**
 * The rectangle of covered pixels in which a shape of that aspect is largest, in steps of a part of the sheet.
 * For every row, the covered height above each column is known; every run of columns is as high as its lowest.
 */
export function largestPlace({ width, height, data }, aspect) {
    const step = Math.ceil(Math.max(width, height) / kPlaces);
    const [columns, rows] = [Math.floor(width / step), Math.floor(height / step)];
    const isCovered = (column, row) => {
        for (let y = row * step; y < (row + 1) * step; ++y) {
            for (let x = column * step; x < (column + 1) * step; ++x) {
                if (data[y * width + x] < 128) {
                    return false;
                }
            }
        }
        return true;
    };
    const heights = new Array(columns).fill(0);
    let [best, area, place] = [0, 0, undefined];
    for (let row = 0; row < rows; ++row) {
        heights.forEach((above, column) => { heights[column] = isCovered(column, row) ? above + 1 : 0; });
        for (let first = 0; first < columns; ++first) {
            for (let last = first, lowest = heights[first]; last < columns && lowest > 0; lowest = Math.min(lowest, heights[++last] ?? 0)) {
                const size = Math.min((last - first + 1) / aspect, lowest);
                const room = (last - first + 1) * lowest;
                if (size > best || size === best && room > area) {
                    [best, area] = [size, room];
                    place = { left: first * step, top: (row + 1 - lowest) * step, right: (last + 1) * step, bottom: (row + 1) * step };
                }
            }
        }
    }
    return place;
}
