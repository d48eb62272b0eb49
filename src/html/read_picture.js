// SPDX-License-Identifier: MIT
// Pictures' files on a canvas.

/**
 * Drawing in which strokes that do not scale are so many times as wide. A browser makes them as wide as on the canvas; they
 * shall be as wide as on the drawing's own page. Only what the browser knows of styles without a layout is used.
 */
export function withWiderStrokes(text, factor) {
    const drawing = new DOMParser().parseFromString(text, 'image/svg+xml');
    const rules = [...drawing.querySelectorAll('style')].flatMap((style) => {
        const sheet = new CSSStyleSheet();
        sheet.replaceSync(style.textContent.replace(/@import[^;]*;/g, ''));
        return [...sheet.cssRules];
    });
    const own = (element, name) => element.style?.getPropertyValue(name) ||
        rules.findLast((rule) => rule.selectorText && rule.style.getPropertyValue(name) && element.matches(rule.selectorText))?.style
            .getPropertyValue(name) || element.getAttribute(name);
    const inherited = (element, name) => (element ? own(element, name) || inherited(element.parentElement, name) : '');
    const stiff = [...drawing.querySelectorAll('*')].filter((element) => own(element, 'vector-effect') === 'non-scaling-stroke');
    const widths = stiff.map((element) => ['stroke-width', 'stroke-dasharray', 'stroke-dashoffset'].map((name) => [name,
        (inherited(element, name) || (name === 'stroke-width' ? '1' : '')).replace(/[\d.]+/g, (number) => factor * Number(number))]));
    stiff.forEach((element, k) => {
        for (const [name, value] of widths[k].filter(([, value]) => value !== '')) {
            element.style.setProperty(name, value, 'important');
        }
    });
    return new XMLSerializer().serializeToString(drawing);
}

/**
 * Draws a picture's file on a canvas, which is shrunk if it is too large.
 * @param svg_side  longer side of a picture that is SVG [pixels]; undefined: its own
 */
export async function readPicture(file, svg_side) {
    const kLargestPicture = 2048;
    const image = new Image();
    const show = async (picture) => {
        URL.revokeObjectURL(image.src);
        image.src = URL.createObjectURL(picture);
        await image.decode();
    };
    try {
        await show(file);
        const longer = Math.max(image.naturalWidth, image.naturalHeight);
        const is_drawing = file.type === 'image/svg+xml';
        const scale = svg_side && is_drawing ? svg_side / longer : Math.min(1, kLargestPicture / longer);
        const canvas = document.createElement('canvas');
        canvas.width = Math.max(1, Math.round(scale * image.naturalWidth));
        canvas.height = Math.max(1, Math.round(scale * image.naturalHeight));
        const text = is_drawing ? await file.text() : '';
        if (text.includes('non-scaling-stroke')) {
            await show(new Blob([withWiderStrokes(text, scale)], { type: file.type }));
        }
        canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
        return canvas;
    } finally {
        URL.revokeObjectURL(image.src);
    }
}

