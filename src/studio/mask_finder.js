// SPDX-License-Identifier: MIT
// Finds the liquid on a photograph by the solver's segmentation: by itself, or by strokes that say what is liquid and what
// is dry. Two workers: one is quick, on a small picture, while the hand draws; the other takes the picture as it is.
import { Servant } from './solver.js';

const kDraftSide = 240;  // longer side of the small picture [pixels]; takes a fifth of a second

/** Pixels of the picture on a small canvas. */
function shrunk(canvas) {
    const scale = Math.min(1, kDraftSide / Math.max(canvas.width, canvas.height));
    const [width, height] = [canvas.width, canvas.height].map((side) => Math.max(1, Math.round(scale * side)));
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.imageSmoothingQuality = 'high';
    context.drawImage(canvas, 0, 0, width, height);
    return context.getImageData(0, 0, width, height);
}

/** Strokes as the solver reads them, in a size in which none gets lost: white is liquid, black is dry, the rest transparent. */
export function seedsOf({ liquid, dry }, width, height) {
    const data = new Uint8ClampedArray(4 * width * height);
    for (const [strokes, grey] of [[dry, 0], [liquid, 255]]) {
        for (let y = 0, at = 0; y < strokes.height; ++y) {
            const row = Math.floor(y * height / strokes.height) * width;
            for (let x = 0; x < strokes.width; ++x, ++at) {
                if (strokes.data[at] >= 128) {
                    const pixel = 4 * (row + Math.floor(x * width / strokes.width));
                    data[pixel] = data[pixel + 1] = data[pixel + 2] = grey;
                    data[pixel + 3] = 255;
                }
            }
        }
    }
    return { width, height, data };
}

/** A worker that knows a picture, and of several wishes fulfils the newest. */
class Seeker {
    constructor(parts, picture, answered) {
        Object.assign(this, { parts, picture, answered });
    }

    /** @param strokes  {liquid, dry}; undefined: the solver decides by itself */
    want(strokes) {
        this.wish = { strokes };
        this.#next();
    }

    async #next() {
        if (this.busy || !this.wish) {
            return;
        }
        const { strokes } = this.wish;
        const { width, height, data } = this.picture;
        const servant = this.servant ??= new Servant(this.parts);
        this.wish = undefined;
        this.busy = true;
        const seeds = strokes && seedsOf(strokes, width, height);
        const answer = await servant.ask('mask', { picture: { width, height, data }, seeds }).catch((error) => ({ error }));
        if (servant === this.servant) {
            this.busy = false;
            this.answered(answer);
            this.#next();
        }
    }

    /** Drops what is wanted, and breaks off what is looked for. */
    stop() {
        this.wish = undefined;
        if (this.busy) {
            this.servant.stop();
            this.servant = undefined;
            this.busy = false;
        }
    }

    end() {
        this.servant?.stop();
        this.servant = this.wish = undefined;
    }
}

export class MaskFinder {
    /**
     * @param parts     {worker_url, wasm} of the solver
     * @param canvas    the photograph
     * @param image     its pixels
     * @param answered  called with ({mask} or {error}, is_draft)
     */
    constructor(parts, canvas, image, answered) {
        this.drafter = new Seeker(parts, shrunk(canvas), (answer) => answered(answer, true));
        this.finisher = new Seeker(parts, image, (answer) => answered(answer, false));
    }

    /** Wants a mask by the solver itself. */
    wantAutomatic() {
        this.finisher.want(undefined);
    }

    /** Wants a small mask by strokes under the hand; once it has left, also the whole one. */
    wantMarked(strokes, is_draft) {
        this.finisher.stop();
        this.drafter.want(strokes);
        if (!is_draft) {
            this.finisher.want(strokes);
        }
    }

    /** Drops what is wanted. */
    stop() {
        this.drafter.stop();
        this.finisher.stop();
    }

    /** Ends the workers. */
    end() {
        this.drafter.end();
        this.finisher.end();
    }
}
