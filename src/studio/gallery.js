// SPDX-License-Identifier: MIT
// Drawings to begin with, each in a look that suits it.
import { blank, drawShape, whole } from './coverage.js';

const kSide = 100;  // of the square that the paths are on

const disc = (x, y, r) => `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;

/** A point at an angle [°] and a distance from the middle. */
function polar(degrees, distance) {
    const angle = degrees * Math.PI / 180;
    return `${(50 + distance * Math.cos(angle)).toFixed(2)} ${(50 + distance * Math.sin(angle)).toFixed(2)}`;
}

const petal = (degrees) => `M${polar(degrees, 6)}A19 11 ${degrees} 1 0 ${polar(degrees, 44)}A19 11 ${degrees} 1 0 ${polar(degrees, 6)}z`;
const star = Array.from({ length: 10 }, (_, k) => polar(36 * k - 90, k % 2 ? 20 : 44)).join('L');

/** Paths; `stroke`: the width of a line instead of an area; `look`: of the droplet. The first is shown on an empty sheet. */
export const kDrawings = [
    {
        name: 'Splash', look: 'water',
        path: `M46 24c8-4 12 4 20 2s15 3 12 12-5 9-1 17 7 15-3 20-13-3-21 3-11 12-19 6-4-12-12-16-14-5-13-15 11-8 11-16 0-14 8-16 12 6 18 3z${
            disc(83, 18, 6)}${disc(92, 32, 3.2)}${disc(14, 24, 5)}${disc(16, 86, 6)}${disc(27, 93, 3)}${disc(87, 85, 5)}`,
    },
    { name: 'Drop', look: 'gel', path: 'M50 8C60 26 76 42 76 62A26 26 0 0 1 24 62C24 42 40 26 50 8z' },
    { name: 'Heart', look: 'blood', path: 'M50 88C18 64 8 48 8 33A22 22 0 0 1 50 26A22 22 0 0 1 92 33C92 48 82 64 50 88z' },
    { name: 'Ring', look: 'glass', path: `${disc(50, 50, 40)}${disc(50, 50, 22)}` },
    { name: 'Star', look: 'gold', path: `M${star}z` },
    { name: 'Flower', look: 'ink', path: `${[0, 60, 120, 180, 240, 300].map((degrees) => petal(degrees - 90)).join('')}${disc(50, 50, 13)}`, solid: true },
    { name: 'Cloud', look: 'milk', path: `${disc(30, 60, 17)}${disc(50, 44, 22)}${disc(72, 58, 18)}M30 48v28h42v-28z`, solid: true },
    {
        name: 'Paw', look: 'lacquer',
        path: `${disc(17, 46, 9)}${disc(38, 24, 11)}${disc(63, 24, 11)}${disc(84, 46, 9)}M50 44c14 0 28 18 28 31 0 14-16 11-28 11s-28 3-28-11c0-13 14-31 28-31z`,
    },
    { name: 'Moon', look: 'mercury', path: 'M62 8A43 43 0 1 0 92 66A36 36 0 0 1 62 8z' },
    { name: 'Swirl', look: 'honey', path: 'M52 52c4-10 18-4 16 8s-20 20-34 10-12-36 6-46 44-2 48 22', stroke: 13 },
];

/** A drawing's coverage of a sheet, in whose middle it stands. */
export function coverageOf({ path, stroke, solid }, width, height) {
    const mask = blank(width, height);
    const scale = Math.min(width, height) / kSide;
    drawShape(mask, whole(mask), (canvas) => {
        canvas.translate((width - scale * kSide) / 2, (height - scale * kSide) / 2);
        canvas.scale(scale, scale);
        if (stroke) {
            Object.assign(canvas, { lineWidth: stroke, lineCap: 'round', lineJoin: 'round' });
            canvas.stroke(new Path2D(path));
        } else {
            canvas.fill(new Path2D(path), solid ? 'nonzero' : 'evenodd');
        }
    }, false);
    return mask;
}

/**
 * Fills `host` with a button for every drawing.
 * @param chose  called with the drawing
 */
export function buildGallery(host, chose) {
    for (const drawing of kDrawings) {
        const { name, path, stroke, solid } = drawing;
        const button = Object.assign(document.createElement('button'), { type: 'button', title: name });
        button.setAttribute('aria-label', name);
        button.innerHTML = `<svg viewBox="0 0 ${kSide} ${kSide}" aria-hidden="true"><path d="${path}" ${
            stroke ? `class="line" stroke-width="${stroke}"` : `fill-rule="${solid ? 'nonzero' : 'evenodd'}"`}/></svg>`;
        button.addEventListener('click', () => chose(drawing));
        host.append(button);
    }
}
