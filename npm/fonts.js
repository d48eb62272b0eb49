// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the fonts that an SVG names among those of the system, as resvg has none in WebAssembly.
import fs from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { plainStyles } from './svg_text.js';

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
/** Beginnings of the files of families whose files have other names. */
const kFileNames = { 'Times New Roman': 'times', 'Courier New': 'cour', 'Comic Sans MS': 'comic', 'Trebuchet MS': 'trebuc', 'Noto Sans CJK JP': 'notosanscjk' };
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

/** Families that the text of an SVG names, the first of each list. */
function familiesIn(svg) {
    return [...new Set([...plainStyles(svg).matchAll(/font-family\s*(?::\s*([^;}"<>]*)|=\s*(?:"([^"]*)"|'([^']*)'))/g)]
        .map((found) => (found[1] ?? found[2] ?? found[3]).split(',').map((name) => name.replace(/["']/g, '').trim())))];
}

/**
 * Fonts for an SVG.
 * @returns {{buffers: Uint8Array[], names: object, lacking: string[]}}  files; families for the generic names; what is not drawn
 */
export function fontsFor(svg) {
    if (!/<([\w-]+:)?text[\s>]/.test(svg)) {
        return { buffers: [], names: {}, lacking: [] };
    }
    const files = kFolders.flatMap(filesOf);
    let left = kMostBytes;
    const taken = new Set();
    const buffers = [];
    const take = (family) => {
        const name = kFileNames[family] ?? plain(family);
        const found = name === '' ? [] : files.filter((file) => file.name.startsWith(name));
        for (const { path } of found) {
            try {
                const { size } = fs.statSync(path);
                if (!taken.has(path) && size <= left) {
                    buffers.push(fs.readFileSync(path));
                    left -= size;
                    taken.add(path);
                }
            } catch {
                // A link that leads nowhere is no font.
            }
        }
        return found.length > 0;
    };
    const isGeneric = (family) => /^(serif|sans-serif|monospace|cursive|fantasy|system-ui|inherit)$/i.test(family);
    const missing = familiesIn(svg).map((families) => {
        let first = '';
        for (const family of families.filter((name) => name !== '')) {
            // Generic families after others are what is used instead, as the drawing asks.
            if (isGeneric(family) ? first === '' : take(family)) {
                return '';
            }
            first ||= isGeneric(family) ? '' : family;
        }
        return first;
    }).filter((first) => first !== '');
    const names = {};
    for (const [generic, families] of Object.entries(kGeneric)) {
        const family = families.find(take);
        if (family) {
            names[generic] = family;
        }
    }
    names.defaultFontFamily = names.sansSerifFamily ?? names.serifFamily;
    const lacking = buffers.length === 0 ? ['text, as no font was found']
        : [...new Set(missing)].map((family) => `the font '${family}', for which another is used (install it, or convert text to paths)`);
    return { buffers, names, lacking };
}
