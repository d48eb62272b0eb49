// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what resvg does not tell of an SVG, and writes anew what it does not know: the encoding, the page's physical width, pages of
// which one side is missing, the shorthand `font`; and names what it does not draw.
//
// After: XML 1.0, appendix F; SVG 2, 8.2; CSS Values and Units 3, 5.2; CSS Fonts 4, 2.7.

const kInch = 0.0254;  // [m]
const kDotsPerInch = 96;
/** Lengths of the physical units [m]. */
const kPhysical = { in: kInch, cm: 0.01, mm: 0.001, q: 0.00025, pt: kInch / 72, pc: kInch / 6 };

/** The text of a file, by its byte order mark or as its declaration says. */
export function decoded(bytes) {
    const [a, b] = bytes;
    const begin = new TextDecoder('latin1').decode(bytes.subarray(0, 200));
    const named = /^<\?xml[^>]*\bencoding\s*=\s*["']([\w.-]+)["']/.exec(begin)?.[1];
    const encoding = (a === 0xff && b === 0xfe) || b === 0 ? 'utf-16le' : (a === 0xfe && b === 0xff) || a === 0 ? 'utf-16be' : named ?? 'utf-8';
    // A declared encoding has no meaning for text that is decoded.
    return new TextDecoder(encoding).decode(bytes).replace(/\0+$/, '').replace(/^(<\?xml[^>]*?)\s+encoding\s*=\s*["'][^"']*["']/, '$1');
}

/** The document's own tag: where it begins and ends, and its attributes. */
function rootOf(text) {
    const skipped = /^(?:\s|<\?[\s\S]*?\?>|<!--[\s\S]*?-->|<!DOCTYPE(?:[^[>]|\[[\s\S]*?\]\s*)*>)*/i.exec(text)[0].length;
    const tag = /^<(?:[\w.-]+:)?svg(?=[\s/>])((?:[^"'>]|"[^"]*"|'[^']*')*?)\/?>/.exec(text.slice(skipped));
    if (!tag) {
        return undefined;
    }
    const at = skipped + tag[0].indexOf(tag[1], 1);
    const attributes = new Map([...tag[1].matchAll(/([^\s=]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g)].map((found) => [found[1], found[2] ?? found[3]]));
    return { begin: at, end: at + tag[1].length, attributes };
}

/** A length that does not depend on anything else: in CSS pixels and, if its unit is physical, in metres. */
function lengthOf(text) {
    const found = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(px|in|cm|mm|q|pt|pc)?\s*$/i.exec(text ?? '');
    const metres = kPhysical[found?.[2]?.toLowerCase()];
    return found ? { pixels: metres ? (found[1] * metres / kInch) * kDotsPerInch : Number(found[1]), metres: metres && found[1] * metres } : undefined;
}

/**
 * A page: its text with both sides, these in CSS pixels if they can be known, and its physical width [m] if it has one.
 * @param {() => {x: number, y: number, width: number, height: number} | undefined} ink  bounds of what is drawn, for a page without any size
 */
export function withPage(text, ink) {
    const root = rootOf(text);
    if (!root) {
        return { text };
    }
    const [width, height] = ['width', 'height'].map((name) => lengthOf(root.attributes.get(name)));
    const sized = (sides) => {
        const kept = text.slice(root.begin, root.end).replace(/(^|\s)(width|height)\s*=\s*("[^"]*"|'[^']*')/g, '$1');
        const written = Object.entries(sides).map(([name, value]) => ` ${name}="${value}"`).join('');
        return text.slice(0, root.begin) + kept + written + text.slice(root.end);
    };
    const page = (pixels, metres) => ({ ...pixels, physicalWidth: metres, text: sized(pixels) });
    if (width && height) {
        return page({ width: width.pixels, height: height.pixels }, width.metres);
    }
    const box = root.attributes.get('viewBox')?.trim().split(/[\s,]+/).map(Number);
    if (box?.length === 4 && box[2] > 0 && box[3] > 0) {
        const aspect = box[2] / box[3];
        const pixels = width ? width.pixels : height ? height.pixels * aspect : box[2];
        return page({ width: pixels, height: pixels / aspect }, width ? width.metres : height?.metres && height.metres * aspect);
    }
    const bounds = ink();
    if (!bounds || !(bounds.width > 0 && bounds.height > 0)) {
        return { text };
    }
    const pixels = { width: bounds.width, height: bounds.height };
    return { ...pixels, text: sized({ ...pixels, viewBox: `${bounds.x} ${bounds.y} ${bounds.width} ${bounds.height}` }) };
}

/** A text without comments, with the quotes of attributes as they are in CSS. */
export const plainStyles = (text) => text.replace(/<!--[\s\S]*?-->/g, '').replace(/&quot;|&#34;|&#x22;/gi, "'");

/** A text whose shorthands `font` are written as their parts. */
export function withFontParts(text) {
    return text.replace(/([\s;{"'])font\s*:\s*([^;}"'<>]*?)\s*(\d*\.?\d+(?:px|pt|pc|mm|cm|in|em|rem|ex|%|q)|(?:xx?-)?(?:small|large)|medium)\s*(?:\/\s*[^\s;]+)?\s+([^;}<>]*?)(?=\s*(?:[;}<]|"\s*[\s/>]|$))/gi,
        (all, before, style, size, families) => {
            const weight = /\b(bold|bolder|lighter|\d00)\b/i.exec(style)?.[1];
            const slant = /\b(italic|oblique)\b/i.exec(style)?.[1];
            return `${before}${slant ? `font-style:${slant};` : ''}${weight ? `font-weight:${weight};` : ''}font-size:${size};font-family:${families}`;
        });
}

/** What is not drawn, as the native program names it. */
export function lackingIn(text) {
    const plain = plainStyles(text);
    const link = /\s(?:xlink:)?href\s*=\s*["']\s*(?!#|data:)[^"'\s]/;
    const has = (tag) => [...plain.matchAll(new RegExp(`<(?:[\\w.-]+:)?${tag}(?=[\\s/>])(?:[^"'>]|"[^"]*"|'[^']*')*>`, 'g'))].map(([all]) => all);
    return [
        ...has('foreignObject').length > 0 ? ['foreignObject'] : [],
        ...['animate', 'animateTransform', 'animateMotion', 'set'].some((tag) => has(tag).length > 0) ? ['animations'] : [],
        ...has('image').some((tag) => link.test(tag)) ? ['linked pictures (embed them)'] : [],
        ...has('use').some((tag) => link.test(tag)) ? ['linked drawings (embed them)'] : [],
        ...(/@import\b/.test(plain) ? ['imported style sheets'] : []),
        ...(/<\?xml-stylesheet\b/.test(plain) ? ['linked style sheets'] : []),
    ];
}
