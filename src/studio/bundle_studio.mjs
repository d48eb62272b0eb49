// SPDX-License-Identifier: MIT
// Bundles Studio into one HTML file: node bundle_studio.mjs SOURCES WASM OUTPUT.html
// SOURCES is this folder, WASM the solver. Run it in the folder of `npm ci` for src/page.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { deflateRawSync } from 'node:zlib';

const [sources, wasm, output] = process.argv.slice(2);
const here = process.cwd();
const esbuild = createRequire(join(here, 'package.json'))('esbuild');

const options = {
    absWorkingDir: here,
    nodePaths: [join(here, 'node_modules')],
    bundle: true,
    minify: true,
    format: 'iife',
    charset: 'ascii',
    legalComments: 'none',  // the page's top has three's whole licence
    logLevel: 'warning',
    target: ['es2022'],
    loader: { '.html': 'text' },
    write: false,
};
const bundle = async (entry, define = {}) =>
    (await esbuild.build({ ...options, define, entryPoints: [join(sources, entry)] })).outputFiles[0].text.trim();
const worker = await bundle('solver_worker.js');
const script = (await bundle('alone.js', { WORKER: JSON.stringify(worker) })).replaceAll('</script', '<\\/script');
const css = ['../page/page.css', 'studio.css'].map((file) => readFileSync(join(sources, file), 'utf8')).join('\n');
const style = (await esbuild.transform(css, { loader: 'css', minify: true, charset: 'ascii', target: ['chrome111', 'firefox114', 'safari16.4'] })).code.trim();
for (const [name, text] of Object.entries({ script, style })) {
    if (/<\/(script|style)|<!--|[^\x09\x0a\x20-\x7e]/i.test(text)) {
        throw new Error(`Studio's ${name} must be ASCII without HTML end tags or comments`);
    }
}

// The policy allows only exactly these bytes to run, the solver in workers, and no network requests.
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const policy = [
    "default-src 'none'",
    `script-src ${hash(script)} 'wasm-unsafe-eval'`,
    'worker-src blob:',
    `style-src ${hash(style)}`,
    'img-src data: blob:',
    "base-uri 'none'",
    "form-action 'none'",
].join('; ');

const filled = {
    style,
    script,
    policy,
    solver: deflateRawSync(readFileSync(wasm), { level: 9 }).toString('base64'),
    three_licence: readFileSync(join(here, 'node_modules/three/LICENSE'), 'utf8').trim(),
};
writeFileSync(output, readFileSync(join(sources, 'studio.html'), 'utf8').replace(/\{\{(\w+)\}\}/g,
    (slot, name) => filled[name] ?? (() => { throw new Error(`nothing for ${slot}`); })()));
