// SPDX-License-Identifier: MIT
// Bundles the sources beside this file and three.js into one page, as C++: node bundle.mjs SOURCES OUTPUT.cpp
// Run it in the folder of `npm ci`.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [sources, output] = process.argv.slice(2);
const here = process.cwd();
const esbuild = createRequire(join(here, 'package.json'))('esbuild');

const target = ['es2022'];
const bundle = await esbuild.build({
    entryPoints: [join(sources, 'page.js')],
    absWorkingDir: here,
    nodePaths: [join(here, 'node_modules')],
    bundle: true,
    minify: true,
    format: 'iife',
    charset: 'ascii',
    legalComments: 'none',  // the page's top has three's whole licence
    logLevel: 'warning',
    target,
    write: false,
});
const script = bundle.outputFiles[0].text.trim();
const style = (await esbuild.transform(readFileSync(join(sources, 'page.css'), 'utf8'), { loader: 'css', minify: true, target }))
    .code.trim();
for (const [name, text] of Object.entries({ script, style })) {
    if (/<\/(script|style)|<!--|[^\x09\x0a\x20-\x7e]/i.test(text)) {
        throw new Error(`the page's ${name} must be ASCII without HTML end tags or comments`);
    }
}

// The policy allows only exactly these bytes to run, and no network requests.
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const policy = [
    "default-src 'none'",
    `script-src ${hash(script)}`,
    `style-src ${hash(style)}`,
    'img-src data: blob:',
    "base-uri 'none'",
    "form-action 'none'",
].join('; ');

const filled = {
    style,
    script,
    policy,
    three_licence: readFileSync(join(here, 'node_modules/three/LICENSE'), 'utf8').trim(),
};
// Fills every {{slot}} except those of the single page, which follow in this order.
const slots = ['title', 'content', 'model'];
const html = readFileSync(join(sources, 'page.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (slot, name) =>
    slots.includes(name) ? slot : filled[name] ?? (() => { throw new Error(`nothing for ${slot}`); })());
const parts = [];
let rest = html;
for (const slot of slots) {
    const at = rest.indexOf(`{{${slot}}}`);
    if (at < 0) {
        throw new Error(`{{${slot}}} is not in page.html, or not in its place`);
    }
    parts.push(rest.slice(0, at));
    rest = rest.slice(at + slot.length + 4);
}
parts.push(rest);

// Uses string literals, because compilers are far slower with lists of numbers.
const literal = (text) => {
    const escaped = [...Buffer.from(text)].map((byte) =>
        byte === 0x0a ? '\\n'
            // Two question marks might begin a trigraph.
            : byte === 0x22 || byte === 0x5c || byte === 0x3f ? `\\${String.fromCharCode(byte)}`
                : byte >= 0x20 && byte < 0x7f ? String.fromCharCode(byte)
                    : `\\${byte.toString(8).padStart(3, '0')}`);
    const lines = [];
    for (let i = 0; i < escaped.length; i += 4096) {
        lines.push(`    "${escaped.slice(i, i + 4096).join('')}"`);
    }
    return `std::string_view(\n${lines.join('\n')},\n    ${escaped.length})`;
};
writeFileSync(output, `// Made by src/page/bundle.mjs.
#include "io/page_parts.h"

namespace droplet {

const std::array<std::string_view, ${parts.length}> kPageParts = {
${parts.map(literal).join(',\n')}};

}  // namespace droplet
`);
