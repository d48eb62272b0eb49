#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// The command: it runs in a thread of its own, so that this one hears signals.
import fs from 'node:fs';
import { constants } from 'node:os';
import { Worker } from 'node:worker_threads';

/** As exit codes of the command: an internal error. */
const kInternalError = 1;

/** A number that the command's thread sees, too. */
const shared = () => new Int32Array(new SharedArrayBuffer(4));
/** The first signal that was received, or 0. */
const received = shared();
/** Whether a first signal does not end the command, which then asks for it. */
const isAwaited = shared();
/** Temporary files that exist. */
const unfinished = new Set();

function removeUnfinished() {
    for (const path of unfinished) {
        fs.rmSync(path, { force: true });
    }
}

function endBy(name) {
    removeUnfinished();
    process.removeAllListeners(name);
    process.kill(process.pid, name);
}

for (const name of ['SIGINT', 'SIGTERM', 'SIGHUP']) {
    process.on(name, () => {
        const is_first = Atomics.compareExchange(received, 0, 0, constants.signals[name]) === 0;
        if (!is_first || Atomics.load(isAwaited, 0) === 0) {
            endBy(name);
        }
    });
}

const kStack = 64;  // [MB]: deep recursion of the solver has that of the module, of JavaScript little
const command = new Worker(new URL('./command_worker.js', import.meta.url), {
    workerData: { words: process.argv.slice(2), received, isAwaited },
    // The thread writes to the process's own streams by itself.
    stdout: true,
    stderr: true,
    resourceLimits: { stackSizeMb: kStack },
});
command.on('message', ({ path, exists }) => void (exists ? unfinished.add(path) : unfinished.delete(path)));
command.on('error', (error) => {
    fs.writeSync(2, `droplet-shape: internal error: ${error.message}\n`);
    removeUnfinished();
    process.exitCode = kInternalError;
});
command.on('exit', (code) => {
    // A batch ends its items first.
    const signal = Atomics.load(received, 0);
    const name = Object.keys(constants.signals).find((each) => constants.signals[each] === signal);
    if (name) {
        endBy(name);
    }
    process.exitCode ??= code;
});
