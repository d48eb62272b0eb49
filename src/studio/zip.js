// SPDX-License-Identifier: MIT
// Packs files into a ZIP without compressing them: pictures are compressed already.
// PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", sections 4.3.7, 4.3.12 and 4.3.16.
import { joined } from '../../npm/bytes.js';
import { crc32 } from '../../npm/png.js';

const kInUtf8 = 0x0800;
const kVersion = 20;       // the oldest that reads folders
const kDate = 0x0021;      // 1 January 1980: the same files are the same bytes

/** Numbers in little-endian: pairs of bytes and value. */
function numbers(...fields) {
    return Uint8Array.from(fields.flatMap(([bytes, value]) => Array.from({ length: bytes }, (_, k) => (value >>> (8 * k)) & 0xff)));
}

/** @param files  bytes by path, with `/` between folders */
export function zipOf(files) {
    const parts = [];
    const directory = [];
    let at = 0;
    for (const [path, bytes] of Object.entries(files)) {
        const name = new TextEncoder().encode(path);
        const common = numbers([2, kVersion], [2, kInUtf8], [2, 0], [2, 0], [2, kDate], [4, crc32(bytes)], [4, bytes.length], [4, bytes.length],
            [2, name.length], [2, 0]);
        const head = [numbers([4, 0x04034b50]), common, name];
        directory.push(numbers([4, 0x02014b50], [2, kVersion]), common, numbers([2, 0], [2, 0], [2, 0], [4, 0], [4, at]), name);
        parts.push(...head, bytes);
        at += head.reduce((sum, { length }) => sum + length, bytes.length);
    }
    const list = joined(directory);
    const count = Object.keys(files).length;
    return joined([...parts, list, numbers([4, 0x06054b50], [2, 0], [2, 0], [2, count], [2, count], [4, list.length], [4, at], [2, 0])]);
}
