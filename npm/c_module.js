// SPDX-License-Identifier: GPL-3.0-or-later
// Loads a module with the C interface of include/droplet/c/droplet.h, and what calls to it need.
import { DropletError } from './droplet_error.js';
import { instantiate } from './droplet_shape.js';
import { pageSystem } from './page_system.js';

const kCodes = [undefined, 'Internal', 'InvalidArgument', 'InvalidInput', 'OutputFailed', 'NoSuchDroplet', 'OutOfMemory'];

/**
 * Loads a module.
 * @param wasm   its bytes, or the compiled module
 * @param bytes  of the room for structures
 * @param less   what needs less memory, for a message
 * @return       `calls`, its functions; `room`, the place of a room for structures; `check(code)` throws what a function
 *               returned; `allocated(bytes)` is a place; `withText(text, call)` calls with the place of a text, 0 for
 *               undefined; `view()` of the memory; `textAt(place)`; `numbers(count, place)`, `putNumbers(values)` in the
 *               room; `count64(place)`
 */
export async function loadModule(wasm, bytes, less) {
    const calls = await instantiate(wasm, (memory) => pageSystem(memory, new Map()));
    const view = () => new DataView(calls.memory.buffer);
    const textAt = (place) => {
        const bytes = new Uint8Array(calls.memory.buffer, place);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    };
    const allocated = (bytes) => calls.malloc(bytes) || (() => {
        throw new DropletError('OutOfMemory', `out of memory; ${less}`);
    })();
    const check = (code) => {
        if (code !== 0) {
            throw new DropletError(kCodes[code] ?? 'Internal', textAt(calls.droplet_message()));
        }
    };
    /** Calls with a text that ends with 0; an empty place for none. */
    const withText = (text, call) => {
        if (text === undefined) {
            return call(0);
        }
        const bytes = new TextEncoder().encode(`${text}\0`);
        const place = allocated(bytes.length);
        new Uint8Array(calls.memory.buffer, place, bytes.length).set(bytes);
        try {
            return call(place);
        } finally {
            calls.free(place);
        }
    };
    const room = allocated(bytes);
    const numbers = (count, from = room) => Array.from({ length: count }, (_, k) => view().getFloat64(from + 8 * k, true));
    const count64 = (place) => Number(view().getBigUint64(place, true));
    const putNumbers = (values) => values.forEach((value, k) => view().setFloat64(room + 8 * k, value, true));
    return { calls, room, check, allocated, withText, view, textAt, numbers, count64, putNumbers };
}
