// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the fonts that an SVG names among those of the system, as resvg has none in WebAssembly.
import fs from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';

const kFolders = {
    win32: [join(process.env.WINDIR ?? 'C:/Windows', 'Fonts'), join(process.env.LOCALAPPDATA ?? '', 'Microsoft/Windows/Fonts')],
    darwin: ['/System/Library/Fonts', '/Library/Fonts', join(homedir(), 'Library/Fonts')],
}[process.platform] ?? ['/usr/share/fonts', '/usr/local/share/fonts', join(homedir(), '.local/share/fonts'), join(homedir(), '.fonts')];

/** Families that stand for the generic ones, the first that a system has. */
const kGeneric = {
    serifFamily: ['Times New Roman', 'Liberation Serif', 'DejaVu Serif', 'Times'],
    sansSerifFamily: ['Arial', 'Liberation Sans', 'DejaVu Sans', 'Helvetica'],
    monospaceFamily: ['Courier New', 'Liberation Mono', 'DejaVu Sans Mono', 'Menlo'],
};
const kFileNames = { 'Times New Roman': 'times', 'Courier New': 'cour' };
const kMostBytes = 64 << 20;

const plain = (name) => name.toLowerCase().replace(/[^\p{L}\p{N}]/gu, '');

function filesOf(folder) {
    let entries = [];
    try {
        entries = fs.readdirSync(folder, { withFileTypes: true });
    } catch {
        // A system has some of the folders.
    }
    return entries.sort((a, b) => (a.name < b.name ? -1 : 1)).flatMap((entry) => {
        const path = join(folder, entry.name);
        return entry.isDirectory() ? filesOf(path) : /\.(ttf|otf|ttc)$/i.test(entry.name) ? [{ path, name: plain(entry.name.replace(/\.\w+$/, '')) }] : [];
    });
}

/** Families that the text of an SVG names. */
function familiesIn(svg) {
    const lists = [...svg.matchAll(/font-family\s*[:=]\s*(?:"([^"]*)"|'([^']*)'|([^;"'}>]*))/g), ...svg.matchAll(/font\s*:\s*[^;}]*?\d\S*\s+([^;"}]*)/g)];
    return [...new Set(lists.flatMap((found) => (found[1] ?? found[2] ?? found[3] ?? '').split(','))
        .map((name) => name.replace(/&quot;|["']/g, '').trim()).filter((name) => name !== ''))];
}

/**
 * Fonts for an SVG.
 * @returns {{buffers: Uint8Array[], names: object, lacking: string}}  files; families for the generic names; what is not drawn
 */
export function fontsFor(svg) {
    if (!/<([\w-]+:)?text[\s>]/.test(svg)) {
        return { buffers: [], names: {}, lacking: '' };
    }
    const files = kFolders.flatMap(filesOf);
    let left = kMostBytes;
    const taken = new Set();
    const buffers = [];
    const take = (family) => {
        const name = kFileNames[family] ?? plain(family);
        const found = name === '' ? [] : files.filter((file) => file.name.startsWith(name));
        for (const { path } of found) {
            const { size } = fs.statSync(path);
            if (!taken.has(path) && size <= left) {
                left -= size;
                taken.add(path);
                buffers.push(fs.readFileSync(path));
            }
        }
        return found.length > 0;
    };
    const missing = familiesIn(svg).filter((family) => !/^(serif|sans-serif|monospace|cursive|fantasy|system-ui|inherit)$/.test(family) && !take(family));
    const names = {};
    for (const [generic, families] of Object.entries(kGeneric)) {
        const family = families.find(take);
        if (family) {
            names[generic] = family;
        }
    }
    names.defaultFontFamily = names.sansSerifFamily ?? names.serifFamily;
    const lacking = buffers.length === 0 ? ['text, as no font was found'] : missing.map((family) => `the font ${family}`);
    return { buffers, names, lacking: lacking.join(', ') };
}
