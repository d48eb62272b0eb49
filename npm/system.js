// SPDX-License-Identifier: GPL-3.0-or-later
// The system that the module's C library asks for files, streams, time and the environment: node's, with POSIX paths on every
// system. Error numbers and layouts are those of WASI preview 1 and of emscripten's musl for 32 bits.
import fs from 'node:fs';
import { isatty } from 'node:tty';
import { highWords } from './page_system.js';

const kError = {
    EACCES: 2, EAGAIN: 6, EBADF: 8, EBUSY: 10, EEXIST: 20, EFBIG: 22, EINVAL: 28, EIO: 29, EISDIR: 31, ELOOP: 32, EMFILE: 33,
    ENAMETOOLONG: 37, ENFILE: 41, ENOENT: 44, ENOMEM: 48, ENOSPC: 51, ENOSYS: 52, ENOTDIR: 54, ENOTEMPTY: 55, EPERM: 63, EPIPE: 64,
    EROFS: 69, ESPIPE: 70, EXDEV: 75, EDQUOT: 19, ENOTSUP: 58, ENXIO: 60, ETIMEDOUT: 73, ETXTBSY: 74,
};
const kKind = { fifo: 0o010000, character: 0o020000, folder: 0o040000, file: 0o100000, link: 0o120000 };
const kFlags = { access: 0o3, write: 0o1, both: 0o2, create: 0o100, exclusive: 0o200, truncate: 0o1000, append: 0o2000, folder: 0o200000 };
const kTemporary = 0o20000000;  // of O_TMPFILE, which only Linux has
/** Files that every system has here, in place of links of Linux. */
const kStreams = ['/dev/stdin', '/dev/stdout', '/dev/stderr'];
const kWait = new Int32Array(new SharedArrayBuffer(4));

/** Waits without running anything else [ms]. */
export const pause = (milliseconds) => void Atomics.wait(kWait, 0, 0, milliseconds);

const failed = (error) => (kError[error?.code] ?? kError.EIO);

/** A path as this system has it. `/C:/folder` and `/here/C:/folder` are `C:/folder`, as POSIX takes a drive for a name. */
const here = process.platform === 'win32' ? (path) => path.replace(/^.*\/(?=[A-Za-z]:(\/|$))/, '') : (path) => path;

/** A path with the slashes that the module knows. */
export const posixPath = process.platform === 'win32' ? (path) => path.replace(/\\/g, '/') : (path) => path;

/**
 * The imports.
 * @param {() => WebAssembly.Memory} memory
 * @param {Map<string, () => Uint8Array>} made  contents of files that are made when they are read, by their paths
 * @param {(path: string, exists: boolean) => void} temporary  told when a temporary file is made, and when it is gone
 */
export function nodeSystem({ memory, made = new Map(), temporary = () => {} }) {
    const view = () => new DataView(memory().buffer);
    const bytesAt = (place, length) => new Uint8Array(memory().buffer, place, length);
    const decoder = new TextDecoder('utf-8', { ignoreBOM: true });
    const textAt = (place) => {
        const bytes = new Uint8Array(memory().buffer, place);
        return decoder.decode(bytes.slice(0, bytes.indexOf(0)));
    };
    const pathAt = (place) => here(textAt(place));
    const put = (text, place, size) => {
        const bytes = new TextEncoder().encode(text);
        bytesAt(place, size).set(bytes.subarray(0, size));
        return bytes.length;
    };
    /** Open files by their numbers: those of node, folders, files in memory and streams. Those without a place `at` are pipes. */
    const opened = new Map([0, 1, 2].map((file) => [file, { file, is_stream: true }]));
    let next = 3;
    const open = (file) => {
        opened.set(next, file);
        return next++;
    };

    /** A system call: 0 or more, or a negative error number. */
    const call = (work) => (...given) => {
        try {
            return work(...given) ?? 0;
        } catch (error) {
            return -failed(error);
        }
    };
    /** A call of WASI: an error number, or 0. */
    const wasi = (work) => (...given) => {
        try {
            return work(...given) ?? 0;
        } catch (error) {
            return failed(error);
        }
    };
    const isTemporary = (path) => /(^|\/)\.droplet-shape-\d+-\d+\.tmp$/.test(path);

    function putStatus(status, place) {
        const to = view();
        const time = (at, milliseconds) => {
            to.setInt32(place + at, Math.floor(milliseconds / 1000), true);
            to.setInt32(place + at + 4, Math.floor((milliseconds % 1000) * 1e6), true);
        };
        to.setUint32(place, Number(status.dev & 0xffffffffn), true);
        to.setUint32(place + 8, Number(status.ino & 0xffffffffn), true);
        to.setUint32(place + 12, Number(status.mode), true);
        to.setUint32(place + 16, Number(status.nlink), true);
        to.setUint32(place + 20, Number(status.uid), true);
        to.setUint32(place + 24, Number(status.gid), true);
        to.setUint32(place + 28, 0, true);
        to.setBigInt64(place + 40, status.size, true);
        to.setInt32(place + 48, 4096, true);
        to.setInt32(place + 52, Number(status.size / 512n), true);
        time(56, Number(status.atimeNs) / 1e6);
        time(64, Number(status.mtimeNs) / 1e6);
        time(72, Number(status.ctimeNs) / 1e6);
        to.setBigUint64(place + 80, BigInt.asUintN(64, status.ino), true);
    }
    const nothing = { dev: 0n, ino: 0n, nlink: 1n, uid: 0n, gid: 0n, size: 0n, atimeNs: 0n, mtimeNs: 0n, ctimeNs: 0n };
    /** Status of a file that only exists here. */
    function ownStatus(path) {
        const stream = kStreams.indexOf(path);
        if (stream >= 0) {
            return { ...nothing, ino: BigInt(stream + 1), mode: BigInt(kKind.character | 0o666) };
        }
        return made.has(path) ? { ...nothing, mode: BigInt(kKind.file | 0o444), size: BigInt(made.get(path)().length) } : undefined;
    }
    const status = (read) => call((path, place) => {
        const name = pathAt(path);
        putStatus(ownStatus(name) ?? read(name, { bigint: true }), place);
    });

    function openPath(path, flags, mode) {
        const name = pathAt(path);
        const stream = kStreams.indexOf(name);
        if (stream >= 0) {
            return open({ file: stream, is_stream: true });
        }
        if (made.has(name)) {
            return open({ content: made.get(name)(), at: 0 });
        }
        if ((flags & kTemporary) !== 0) {
            return -kError.EINVAL;
        }
        if ((flags & kFlags.folder) !== 0) {
            return open({ folder: name, names: ['.', '..', ...fs.readdirSync(name)], at: 0 });
        }
        const { constants } = fs;
        const does_write = (flags & kFlags.access) !== 0;
        let native = (flags & kFlags.both) !== 0 ? constants.O_RDWR : does_write ? constants.O_WRONLY : constants.O_RDONLY;
        for (const [flag, own] of [['create', constants.O_CREAT], ['exclusive', constants.O_EXCL], ['truncate', constants.O_TRUNC],
            ['append', constants.O_APPEND]]) {
            native |= (flags & kFlags[flag]) !== 0 ? own : 0;
        }
        const file = fs.openSync(name, native, mode);
        if ((flags & kFlags.create) !== 0 && isTemporary(name)) {
            temporary(name, true);
        }
        // Node has no call for places in files, so they are kept here.
        return open({ file, at: fs.fstatSync(file).isFile() ? 0 : undefined });
    }

    /** Writes all bytes, as another program may have made a pipe that does not wait. */
    function writeAll(entry, bytes) {
        for (let done = 0; done < bytes.length;) {
            try {
                const count = fs.writeSync(entry.file, bytes, done, bytes.length - done, entry.at ?? null);
                done += count;
                entry.at = entry.at === undefined ? undefined : entry.at + count;
            } catch (error) {
                if (error.code !== 'EAGAIN') {
                    throw error;
                }
                pause(1);
            }
        }
        return bytes.length;
    }
    function readSome(entry, bytes) {
        if (entry.content) {
            const part = entry.content.subarray(entry.at, entry.at + bytes.length);
            bytes.set(part);
            entry.at += part.length;
            return part.length;
        }
        for (;;) {
            try {
                const count = fs.readSync(entry.file, bytes, 0, bytes.length, entry.at ?? null);
                entry.at = entry.at === undefined ? undefined : entry.at + count;
                return count;
            } catch (error) {
                if (error.code === 'EOF') {
                    return 0;
                }
                if (error.code !== 'EAGAIN') {
                    throw error;
                }
                pause(1);
            }
        }
    }
    const entryOf = (number) => opened.get(number) ?? (() => {
        throw Object.assign(new Error('not open'), { code: 'EBADF' });
    })();
    /** Calls a function with each part of memory of a list; returns the sum. */
    function eachPart(list, count, sum, work) {
        let total = 0;
        for (let k = 0; k < count; ++k) {
            const from = view();
            const length = from.getUint32(list + 8 * k + 4, true);
            const done = length > 0 ? work(bytesAt(from.getUint32(list + 8 * k, true), length)) : 0;
            total += done;
            if (done < length) {
                break;
            }
        }
        view().setUint32(sum, total, true);
    }

    const time = (clock) => (clock === 0 ? BigInt(Date.now()) * 1000000n : process.hrtime.bigint());
    const environment = () => Object.entries(process.env).map(([name, value]) => `${name}=${value}\0`);

    const preview1 = {
        clock_time_get: (clock, precision, place) => {
            view().setBigUint64(place, time(clock), true);
            return 0;
        },
        clock_res_get: (clock, place) => {
            view().setBigUint64(place, 1n, true);
            return 0;
        },
        environ_sizes_get: (count, size) => {
            const list = environment();
            view().setUint32(count, list.length, true);
            view().setUint32(size, list.reduce((sum, text) => sum + new TextEncoder().encode(text).length, 0), true);
            return 0;
        },
        environ_get: (places, texts) => {
            environment().forEach((text, k) => {
                view().setUint32(places + 4 * k, texts, true);
                texts += put(text, texts, memory().buffer.byteLength - texts);
            });
            return 0;
        },
        fd_close: wasi((number) => {
            const entry = entryOf(number);
            opened.delete(number);
            if (entry.file !== undefined && !entry.is_stream) {
                fs.closeSync(entry.file);
            }
        }),
        fd_fdstat_get: wasi((number, place) => {
            const entry = entryOf(number);
            bytesAt(place, 24).fill(0);
            view().setUint8(place, entry.is_stream && isatty(entry.file) ? 2 : entry.folder ? 3 : 4);
        }),
        fd_read: wasi((number, list, count, sum) => eachPart(list, count, sum, (bytes) => readSome(entryOf(number), bytes))),
        fd_write: wasi((number, list, count, sum) => eachPart(list, count, sum, (bytes) => writeAll(entryOf(number), bytes))),
        fd_seek: wasi((number, offset, from, place) => {
            const entry = entryOf(number);
            if (entry.at === undefined) {
                return kError.ESPIPE;
            }
            const end = () => entry.content?.length ?? entry.names?.length ?? fs.fstatSync(entry.file).size;
            const start = from === 2 ? end() : from === 1 ? entry.at : 0;
            entry.at = start + Number(offset);
            view().setBigInt64(place, BigInt(entry.at), true);
            return 0;
        }),
        fd_sync: wasi((number) => {
            try {
                fs.fsyncSync(entryOf(number).file);
            } catch (error) {
                // Pipes and some network drives cannot.
                if (error.code !== 'EINVAL' && error.code !== 'EPERM') {
                    throw error;
                }
            }
        }),
        proc_exit: (code) => {
            process.exit(code);
        },
    };

    const env = {
        emscripten_notify_memory_growth: () => {},
        ...highWords(),
        __syscall_stat64: status(fs.statSync),
        __syscall_lstat64: status(fs.lstatSync),
        __syscall_fstat64: call((number, place) => {
            const entry = entryOf(number);
            const own = entry.content ? { ...nothing, mode: BigInt(kKind.file | 0o444), size: BigInt(entry.content.length) } : undefined;
            putStatus(own ?? (entry.folder ? fs.statSync(entry.folder, { bigint: true }) : fs.fstatSync(entry.file, { bigint: true })), place);
        }),
        __syscall_fstatat64: call((folder, path, place, flags) => {
            const kNoFollow = 0x100;
            return env[(flags & kNoFollow) !== 0 ? '__syscall_lstat64' : '__syscall_stat64'](path, place);
        }),
        __syscall_access: call((path, mode) => {
            const name = pathAt(path);
            if (!ownStatus(name)) {
                fs.accessSync(name, mode);
            }
        }),
        __syscall_faccessat: call((folder, path, mode) => env.__syscall_access(path, mode)),
        __syscall_mkdir: call((path, mode) => fs.mkdirSync(pathAt(path), mode)),
        __syscall_rmdir: call((path) => fs.rmdirSync(pathAt(path))),
        __syscall_unlink: call((path) => {
            const name = pathAt(path);
            fs.unlinkSync(name);
            temporary(name, false);
        }),
        __syscall_unlinkat: call((folder, path, flags) => {
            const kRemoveFolder = 0x200;
            return env[(flags & kRemoveFolder) !== 0 ? '__syscall_rmdir' : '__syscall_unlink'](path);
        }),
        __syscall_rename: call((from, to) => {
            const name = pathAt(from);
            fs.renameSync(name, pathAt(to));
            temporary(name, false);
        }),
        __syscall_readlink: call((path, place, size) => {
            const name = pathAt(path);
            if (ownStatus(name)) {
                return -kError.EINVAL;
            }
            return Math.min(put(posixPath(fs.readlinkSync(name)), place, size), size);
        }),
        __syscall_fchmod: call((number, mode) => {
            const { file } = entryOf(number);
            if (file !== undefined) {
                fs.fchmodSync(file, mode);
            }
        }),
        __syscall_chmod: call((path, mode) => fs.chmodSync(pathAt(path), mode)),
        __syscall_fchown32: call((number, owner, group) => {
            if (process.platform !== 'win32') {
                fs.fchownSync(entryOf(number).file, owner, group);
            }
        }),
        __syscall_getcwd: call((place, size) => {
            const folder = posixPath(process.cwd());
            const text = `${folder.startsWith('/') ? '' : '/'}${folder}\0`;
            const length = put(text, place, size);
            return length > size ? -68 : length;  // ERANGE
        }),
        __syscall_getdents64: call((number, place, size) => {
            const kSize = 280;
            const entry = entryOf(number);
            let at = 0;
            for (; entry.at < entry.names.length && at + kSize <= size; ++entry.at, at += kSize) {
                const to = view();
                to.setBigUint64(place + at, BigInt(entry.at + 1), true);
                to.setBigInt64(place + at + 8, BigInt(entry.at + 1), true);
                to.setUint16(place + at + 16, kSize, true);
                to.setUint8(place + at + 18, 0);  // what it is, its status says
                bytesAt(place + at + 19, 256).fill(0);
                put(entry.names[entry.at], place + at + 19, 255);
            }
            return at;
        }),
        __syscall_getrusage: call((who, place) => {
            bytesAt(place, 72).fill(0);
            view().setInt32(place + 16, process.resourceUsage().maxRSS, true);
        }),
    };

    return {
        wasi_snapshot_preview1: preview1,
        env,
        droplet: {
            open: call(openPath),
            /** Gives a file a name that no file has. */
            rename_to_free: call((from, to) => {
                const name = pathAt(from);
                const free = pathAt(to);
                try {
                    fs.linkSync(name, free);
                } catch (error) {
                    if (error.code === 'EEXIST') {
                        throw error;
                    }
                    // Some file systems lack links.
                    fs.copyFileSync(name, free, fs.constants.COPYFILE_EXCL);
                }
                fs.unlinkSync(name);
                temporary(name, false);
            }),
            sleep: pause,
        },
    };
}
