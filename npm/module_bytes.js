// SPDX-License-Identifier: GPL-3.0-or-later

/** Bytes of a file of the package, in Node and in pages. */
export async function bytesOf(place) {
    // Node fetches no files; other systems have no node:fs, which bundlers must not look for.
    if (place.protocol === 'file:') {
        const files = 'node:fs/promises';
        const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ files);
        return readFile(place);
    }
    const answer = await fetch(place);
    if (!answer.ok) {
        throw new Error(`${place} was not found`);
    }
    return answer.arrayBuffer();
}
