// SPDX-License-Identifier: MIT
// Pictures as footprints: which channel shows the liquid, and where it begins.
import { blank } from './coverage.js';

/**
 * The levels of a picture, 0 to 255: its transparency if it has transparent parts, else its brightness.
 * `inverted`: whether dark is liquid, since the border is bright. `photo`: whether most edges are soft. `image`: the pixels.
 */
export function levelsOf(canvas) {
    const { width, height } = canvas;
    const image = canvas.getContext('2d').getImageData(0, 0, width, height);
    const { data } = image;
    const levels = new Uint8Array(width * height);
    let transparent = 0;
    for (let i = 3; i < data.length; i += 4) {
        transparent += data[i] < 255;
    }
    const histogram = new Uint32Array(256);
    for (let i = 0; i < levels.length; ++i) {
        levels[i] = transparent > 0 ? data[4 * i + 3] :
            Math.round(0.2126 * data[4 * i] + 0.7152 * data[4 * i + 1] + 0.0722 * data[4 * i + 2]);
        ++histogram[levels[i]];
    }
    let border = 0;
    for (let x = 0; x < width; ++x) {
        border += levels[x] + levels[(height - 1) * width + x];
    }
    for (let y = 0; y < height; ++y) {
        border += levels[y * width] + levels[y * width + width - 1];
    }
    const inverted = transparent === 0 && border / (2 * width + 2 * height) > 127;
    spreadTwo(levels, histogram);
    const middle = histogram.subarray(48, 208).reduce((sum, count) => sum + count, 0);
    const photo = transparent === 0 && middle > 0.15 * levels.length;
    return {
        width, height, levels, photo, inverted, image,
        threshold: photo ? otsu(histogram) : 0.5,
    };
}

/** Spreads the levels of a picture that has just two, such as a mask of 0 and 1, over the whole range. */
function spreadTwo(levels, histogram) {
    const used = [...histogram.keys()].filter((level) => histogram[level] > 0);
    if (used.length === 2) {
        levels.forEach((level, i) => { levels[i] = level === used[1] ? 255 : 0; });
        [histogram[0], histogram[255]] = used.map((level) => histogram[level]);
        histogram.fill(0, 1, 255);
    }
}

/** N. Otsu, "A threshold selection method from gray-level histograms" (1979): the classes' means are farthest apart. */
function otsu(histogram) {
    const total = histogram.reduce((sum, count) => sum + count, 0);
    const all = histogram.reduce((sum, count, level) => sum + count * level, 0);
    let [best, at, below, moment] = [-1, 0.5, 0, 0];
    histogram.forEach((count, level) => {
        below += count;
        moment += count * level;
        if (below > 0 && below < total) {
            const apart = below * (total - below) * (moment / below - (all - moment) / (total - below)) ** 2;
            if (apart > best) {
                [best, at] = [apart, (level + 0.5) / 255];
            }
        }
    });
    return at;
}

/** The mask of a picture's levels. A drawing keeps its soft edges; a photo's are made steeper. */
export function maskOfLevels({ width, height, levels, photo }, threshold, inverted) {
    const mask = blank(width, height);
    const steep = photo ? 8 : 1;
    const table = Uint8Array.from({ length: 256 }, (_, level) => {
        const value = inverted ? 255 - level : level;
        const bound = inverted ? 1 - threshold : threshold;
        return Math.round(Math.min(255, Math.max(0, steep * (value - 255 * bound) + 127.5)));
    });
    for (let i = 0; i < levels.length; ++i) {
        mask.data[i] = table[levels[i]];
    }
    return mask;
}

/** The mask scaled, with its top left corner somewhere on a sheet of another size. */
export function placed(mask, width, height, { left, top, scale }) {
    const image = new ImageData(mask.width, mask.height);
    mask.data.forEach((coverage, i) => { image.data[4 * i + 3] = coverage; });
    const from = new OffscreenCanvas(mask.width, mask.height);
    from.getContext('2d').putImageData(image, 0, 0);
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    context.imageSmoothingQuality = 'high';
    context.drawImage(from, left, top, scale * mask.width, scale * mask.height);
    const { data } = context.getImageData(0, 0, width, height);
    const result = blank(width, height);
    for (let i = 0; i < result.data.length; ++i) {
        result.data[i] = data[4 * i + 3];
    }
    return result;
}

/** The mask scaled to fit into the middle of another size; unchanged if it has this size. */
export function fitted(mask, width, height) {
    if (mask.width === width && mask.height === height) {
        return mask;
    }
    const scale = Math.min(width / mask.width, height / mask.height);
    return placed(mask, width, height, { left: (width - scale * mask.width) / 2, top: (height - scale * mask.height) / 2, scale });
}
