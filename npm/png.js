// SPDX-License-Identifier: GPL-3.0-or-later
// Packs pixels into a PNG without compressing them, so that the solver reads them by the rules of pictures.
import { joined } from './bytes.js';

const kTable = Uint32Array.from({ length: 256 }, (_, byte) => {
    let rest = byte;
    for (let bit = 0; bit < 8; ++bit) {
        rest = rest & 1 ? 0xedb88320 ^ (rest >>> 1) : rest >>> 1;
    }
    return rest;
});

export function crc32(bytes) {
    let crc = 0xffffffff;
    for (let i = 0; i < bytes.length; ++i) {
        crc = kTable[(crc ^ bytes[i]) & 0xff] ^ (crc >>> 8);
    }
    return ~crc >>> 0;
}

function adler32(bytes) {
    let a = 1;
    let b = 0;
    for (let i = 0; i < bytes.length;) {
        // No sum of so many bytes exceeds 32 bits.
        for (const end = Math.min(i + 3800, bytes.length); i < end; ++i) {
            a += bytes[i];
            b += a;
        }
        a %= 65521;
        b %= 65521;
    }
    return (b * 65536 + a) >>> 0;
}

const bigEndian = (number) => Uint8Array.of(number >>> 24, number >>> 16, number >>> 8, number);

function chunk(name, content) {
    const body = joined([Uint8Array.from(name, (letter) => letter.charCodeAt(0)), content]);
    return joined([bigEndian(content.length), body, bigEndian(crc32(body))]);
}

/** Data in zlib's format, in stored blocks. */
function stored(bytes) {
    const kLongest = 65535;
    const parts = [Uint8Array.of(0x78, 0x01)];
    for (let at = 0; at < bytes.length; at += kLongest) {
        const block = bytes.subarray(at, at + kLongest);
        const last = at + kLongest >= bytes.length ? 1 : 0;
        parts.push(Uint8Array.of(last, block.length, block.length >> 8, ~block.length, ~block.length >> 8), block);
    }
    parts.push(bigEndian(adler32(bytes)));
    return joined(parts);
}

/** PNG of an image like ImageData: {width, height, data} with four bytes per pixel, not premultiplied. */
export function pngOf({ width, height, data }) {
    const row = 4 * width;
    const lines = new Uint8Array((row + 1) * height);
    for (let y = 0; y < height; ++y) {
        lines.set(data.subarray(y * row, (y + 1) * row), y * (row + 1) + 1);
    }
    return joined([
        Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
        chunk('IHDR', joined([bigEndian(width), bigEndian(height), Uint8Array.of(8, 6, 0, 0, 0)])),
        chunk('IDAT', stored(lines)),
        chunk('IEND', new Uint8Array()),
    ]);
}
