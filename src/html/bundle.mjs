// SPDX-License-Identifier: MIT
// Bundles the sources beside this file and three.js into one page, as C++: node bundle.mjs SOURCES OUTPUT.cpp [WASM]
// With the solver as WebAssembly, the page holds Studio, too. Run it in the folder of `npm ci`.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { bundleScript, bundleStyle, fill, policyOf, solverElement, threeLicence, withWorker } from './bundling.mjs';

const [sources, output, wasm] = process.argv.slice(2);
const studio = join(sources, '../studio');
const script = await bundleScript(join(sources, 'page.js'), {
    ...wasm ? await withWorker(studio) : {},
    alias: { studio: wasm ? join(studio, 'from_page.js') : join(sources, 'no_studio.js') },
});
const styles = [join(studio, 'studio.css'), join(studio, 'dew.css'), join(studio, '../live/live.css'), join(studio, '../liquid/liquid.css')];
const style = await bundleStyle([join(sources, 'page.css'), ...wasm ? styles : []]);
const filled = {
    style,
    script,
    policy: policyOf(script, style, { compiles: wasm !== undefined, works: wasm !== undefined }),
    solver: wasm ? solverElement(wasm) : '',
    three_licence: threeLicence(),
};
// Fills every {{slot}} except those of the single page, which follow in this order.
const slots = ['title', 'content', 'model'];
const html = fill(readFileSync(join(sources, 'page.html'), 'utf8'), filled, slots);
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
writeFileSync(output, `// Made by src/html/bundle.mjs.
#include "io/page_parts.h"

namespace droplet {

const std::array<std::string_view, ${parts.length}> kPageParts = {
${parts.map(literal).join(',\n')}};

}  // namespace droplet
`);
