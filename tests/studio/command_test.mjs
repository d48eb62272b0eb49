// SPDX-License-Identifier: GPL-3.0-or-later
// The command `droplet-shape studio`, with an xdg-open of the test's own: DROPLET_SHAPE=… node --test command_test.mjs
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { chmodSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

const folder = mkdtempSync(join(tmpdir(), 'studio-command-'));
after(() => rmSync(folder, { recursive: true }));

/** Runs the command with these variables and no others, and this script as xdg-open. */
function run(variables, script, ...words) {
    rmSync(join(folder, 'xdg-open'), { force: true });
    if (script) {
        writeFileSync(join(folder, 'xdg-open'), `#!/bin/sh\n${script}\n`);
        chmodSync(join(folder, 'xdg-open'), 0o755);
    }
    const { status, stdout, stderr } = spawnSync(process.env.DROPLET_SHAPE, ['studio', ...words],
        { cwd: folder, encoding: 'utf8', env: { PATH: folder, ...variables } });
    return { status, stdout, words: stderr.replace(/^droplet-shape: /, '').trim() };
}

test('the page is opened where there is a display, and is what is written to a file', () => {
    for (const variable of ['DISPLAY', 'WAYLAND_DISPLAY', 'BROWSER']) {
        const { status, words } = run({ [variable]: ':0' }, 'echo "$1" > opened');
        assert.deepEqual([status, words], [0, '']);
        const page = readFileSync(join(folder, 'opened'), 'utf8').trim();
        assert.equal(run({}, '', 'studio.html').status, 0);
        assert.deepEqual(readFileSync(join(folder, 'studio.html')), readFileSync(page));
        rmSync(join(folder, 'opened'));
    }
});

test('where it cannot be opened, the message names the page', () => {
    const refused = (variables, script, text) => {
        const { status, words } = run(variables, script);
        assert.equal(status, 4);
        assert.match(words, text);
        assert.ok(existsSync(words.match(/; open (.*) in a browser$/)[1]), words);
        assert.ok(!existsSync(join(folder, 'opened')));
    };
    refused({}, 'echo "$1" > opened', /^there is no display;/);
    refused({ DISPLAY: ':0' }, '', /^xdg-open is missing;/);
    refused({ DISPLAY: ':0' }, 'echo no browser >&2; exit 3', /^xdg-open failed: no browser;/);
});
