// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of languages, and where their English is from.
import { readdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const { SOURCES = resolve(import.meta.dirname, '../../src') } = process.env;
const module = (path) => import(pathToFileURL(resolve(SOURCES, path)).href);
const { kOptions } = await module('studio/options.js');

export const kTables = {
    de: (await module('studio/words/de.js')).kGerman, fr: (await module('studio/words/fr.js')).kFrench,
    ja: (await module('studio/words/ja.js')).kJapanese, zh: (await module('studio/words/zh.js')).kChinese,
};

const read = (path) => readFileSync(resolve(SOURCES, path), 'utf8');
const scripts = ['html', 'live', 'liquid', 'rain', 'studio'].flatMap((room) =>
    readdirSync(resolve(SOURCES, room)).filter((name) => name.endsWith('.js')).map((name) => read(join(room, name))));

/** Texts in quotes. */
const quoted = (text) => [...text.matchAll(/'((?:[^'\\\n]|\\.)*)'/g)].map(([, inner]) => inner.replace(/\\(.)/g, '$1'));

/** What stands before the first comma, or the bracket that ends it. */
function firstValue(text) {
    let depth = 0;
    let within = false;
    for (let i = 0; i < text.length; ++i) {
        within = (text[i] === '\'' && text[i - 1] !== '\\') !== within;
        if (!within) {
            depth += '([{'.includes(text[i]) - ')]}'.includes(text[i]);
            if (depth < 0 || depth === 0 && text[i] === ',') {
                return text.slice(0, i);
            }
        }
    }
    return text;
}

/** Texts that scripts say. */
export const wordsOfCalls = () => scripts.flatMap((script) => [...script.matchAll(/(?<![#.\w])say\(/g)]
    .flatMap(({ index }) => quoted(firstValue(script.slice(index + 'say('.length)))));

/** Texts and attributes in the markup of Studio, without those that are not translated. */
export function wordsOfMarkup() {
    const markup = ['studio/markup.html', 'studio/dew.html'].map(read).join('').replace(/<(\w+)[^>]*translate="no"[^>]*>[^<]*/g, '');
    return [...[...markup.matchAll(/>([^<]+)</g)].map(([, text]) => text), ...[...markup.matchAll(/ (?:aria-label|title|placeholder|alt)="([^"]+)"/g)].map(([, text]) => text)]
        .map((text) => text.trim().replace(/\s+/g, ' ')).filter((text) => /[a-z]/.test(text));
}

/** Texts anywhere in scripts and markup, of which some are said. */
export const wordsOfSources = () => new Set([...scripts.flatMap(quoted), ...wordsOfMarkup()]);

/** Words of reports that Studio shows. */
export function wordsOfReports() {
    const { model, ground } = JSON.parse(read('../docs/schema/report.json')).properties;
    const kinds = ground.properties.kind.enum.filter((kind) => kind !== 'flat');  // which is not shown
    return [...kOptions.liquid.words, ...kOptions.liquid.words.map((word) => word.replace(/^./, (letter) => letter.toUpperCase())),
        ...model.enum, ...kinds, ...kinds.filter((kind) => kind !== 'height map').map((kind) => `hollow ${kind}`)];
}
