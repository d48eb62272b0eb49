// SPDX-License-Identifier: GPL-3.0-or-later
// What the module needs of a system in a page: a clock, and files that are in memory and read alone.

const kSuccess = 0;
// Of WASI preview 1, and of Linux.
const kBadDescriptor = 8;
const kNoEntry = -44;
const kRegularFile = 0o100444;

/** Where emscripten puts the upper half of a result of 64 bits. */
export function highWords() {
    let high = 0;
    return {
        setTempRet0: (value) => {
            high = value;
        },
        getTempRet0: () => high,
    };
}

/**
 * The imports.
 * @param {() => WebAssembly.Memory} memory
 * @param {Map<string, Uint8Array>} files  contents by their paths; files are open while they are there
 */
export function pageSystem(memory, files) {
    const view = () => new DataView(memory().buffer);
    const pathAt = (place) => {
        const bytes = new Uint8Array(memory().buffer, place);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0))).replace(/^(\.\/)+/, '');
    };
    const opened = new Map();
    let next = 3;  // after the streams
    const status = (path, place) => {
        const file = files.get(pathAt(path));
        if (!file) {
            return kNoEntry;
        }
        new Uint8Array(memory().buffer, place, 88).fill(0);
        view().setUint32(place + 12, kRegularFile, true);
        view().setBigInt64(place + 40, BigInt(file.length), true);
        return kSuccess;
    };
    /** A call of WASI on an open file. */
    const onFile = (work) => (number, ...given) => {
        const file = opened.get(number);
        return file ? work(file, ...given) : kBadDescriptor;
    };
    return {
        wasi_snapshot_preview1: {
            clock_time_get: (clock, precision, place) => {
                view().setBigUint64(place, BigInt(Math.round(performance.now() * 1e6)), true);
                return kSuccess;
            },
            proc_exit: (code) => {
                throw new Error(`the solver ended with ${code}`);
            },
            environ_sizes_get: (count, size) => {
                view().setUint32(count, 0, true);
                view().setUint32(size, 0, true);
                return kSuccess;
            },
            environ_get: () => kSuccess,
            fd_read: onFile((file, list, count, sum) => {
                const before = file.at;
                for (let k = 0; k < count; ++k) {
                    const [place, length] = [0, 4].map((at) => view().getUint32(list + 8 * k + at, true));
                    const part = file.content.subarray(file.at, file.at + length);
                    new Uint8Array(memory().buffer, place, length).set(part);
                    file.at += part.length;
                }
                view().setUint32(sum, file.at - before, true);
                return kSuccess;
            }),
            fd_close: (number) => (opened.delete(number) ? kSuccess : kBadDescriptor),
        },
        env: { emscripten_notify_memory_growth: () => {}, ...highWords(), __syscall_stat64: status },
        droplet: {
            open: (path) => {
                const content = files.get(pathAt(path));
                if (!content) {
                    return kNoEntry;
                }
                opened.set(next, { content, at: 0 });
                return next++;
            },
            open_svg: (text, size, seconds, page) => {
                const problem = new TextEncoder().encode('must be drawn first; give its pixels as RGBA');
                new Uint8Array(memory().buffer, page + 28, problem.length).set(problem);
            },
        },
    };
}
