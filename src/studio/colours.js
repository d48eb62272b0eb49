// SPDX-License-Identifier: MIT
// The flat colours of a picture, each with its coverage of the picture: logos become layers.
import { blank } from './coverage.js';
import { kLooks } from './looks.js';

const kBits = 4;          // of each channel, for finding colours
const kMost = 6;          // colours
const kLeast = 0.004;     // least share of the picture that a colour covers
const kPlain = 0.85;      // least share of pixels that have one of the colours; photographs have less
const kFlat = 12;         // most that neighbours of one colour differ by, in levels
const kApart = 40;        // least distance of two colours, in levels

const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Mean colours of the boxes that most opaque pixels are in: [{colour, count}], the most frequent first. `counts(i)`: whether pixel i does. */
function frequent(data, counts = () => true) {
    const boxes = new Map();
    for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 128 || !counts(i / 4)) {
            continue;
        }
        const key = ((data[i] >> (8 - kBits)) << (2 * kBits)) | ((data[i + 1] >> (8 - kBits)) << kBits) | (data[i + 2] >> (8 - kBits));
        const box = boxes.get(key) ?? { sum: [0, 0, 0], count: 0 };
        for (let k = 0; k < 3; ++k) {
            box.sum[k] += data[i + k];
        }
        ++box.count;
        boxes.set(key, box);
    }
    return [...boxes.values()].sort((a, b) => b.count - a.count).map(({ sum, count }) => ({ colour: sum.map((value) => value / count), count }));
}

/** The colour that most of the border has; undefined where the border is transparent. */
function backgroundOf({ width, height, data }) {
    const border = [];
    for (let x = 0; x < width; ++x) {
        border.push(x, (height - 1) * width + x);
    }
    for (let y = 1; y + 1 < height; ++y) {
        border.push(y * width, y * width + width - 1);
    }
    const pixels = border.flatMap((i) => [...data.subarray(4 * i, 4 * i + 4)]);
    const [first] = frequent(Uint8ClampedArray.from(pixels));
    return first && first.count > border.length / 2 ? first.colour : undefined;
}

/** The nearest colour, and the one after it: two of {k: its index, distance}. */
function twoNearest(colours, pixel) {
    let first;
    let second;
    for (let k = 0; k < colours.length; ++k) {
        const found = { k, distance: apart(colours[k], pixel) };
        if (!first || found.distance < first.distance) {
            [first, second] = [found, first];
        } else if (!second || found.distance < second.distance) {
            second = found;
        }
    }
    return [first, second];
}

/**
 * Divides a picture by its colours. Pixels at an edge between two have a share of both.
 * @param image  {width, height, data}: RGBA
 * @return [{colour, mask}], the one that covers most first; empty if the picture has no more than one, or is no drawing of flat colours
 */
export function coloursOf(image) {
    const { width, height, data } = image;
    const background = backgroundOf(image);
    const colours = background ? [background] : [];
    const dry = colours.length;
    // Pixels at edges have mixed colours.
    const alike = (i, k) => {
        for (let channel = 0; channel < 4; ++channel) {
            if (Math.abs(data[4 * i + channel] - data[4 * k + channel]) >= kFlat) {
                return false;
            }
        }
        return true;
    };
    const isFlat = (i) => i % width > 0 && i % width + 1 < width && i >= width && i + width < width * height &&
        alike(i, i - 1) && alike(i, i + 1) && alike(i, i - width) && alike(i, i + width);
    const least = kLeast * width * height;
    for (const { colour, count } of frequent(data, isFlat)) {
        if (count >= least && colours.length < kMost + dry && colours.every((other) => apart(colour, other) >= kApart)) {
            colours.push(colour);
        }
    }
    if (colours.length < dry + 2) {
        return [];
    }
    let [opaque, plain] = [0, 0];
    const masks = colours.map(() => blank(width, height));
    for (let i = 0; i < width * height; ++i) {
        const alpha = data[4 * i + 3];
        if (alpha === 0) {
            continue;
        }
        const [first, second] = twoNearest(colours, data.subarray(4 * i, 4 * i + 3));
        opaque += 1;
        plain += first.distance < kApart / 2 ? 1 : 0;
        const share = second.distance / (first.distance + second.distance);
        masks[first.k].data[i] = Math.round(alpha * share);
        masks[second.k].data[i] = Math.round(alpha * (1 - share));
    }
    return plain > kPlain * opaque ? colours.map((colour, k) => ({ colour, mask: masks[k] })).slice(dry) : [];
}

// Looks that have their own colour on every ground.
const kColoured = ['ink', 'mercury', 'honey', 'plain', 'gel', 'enamel', 'milk', 'lacquer', 'blood', 'gold'];

/** The look whose colour is nearest. */
export const lookNear = (colour) =>
    kColoured.reduce((best, name) => (apart(kLooks[name].ink, colour) < apart(kLooks[best].ink, colour) ? name : best));
