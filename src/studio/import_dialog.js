// SPDX-License-Identifier: MIT
// The dialog about a picture: where its liquid is, and what it is for.
import { find } from '../html/controls.js';
import { say } from '../html/words.js';
import { coloursOf } from './colours.js';
import { Marking } from './marking.js';
import { MaskFinder } from './mask_finder.js';
import { levelsOf, maskOfLevels } from './pictures.js';
import { sentence } from './sentence.js';

/** Shows a mask in a colour. */
function showMask(canvas, { width, height, data }, [red, green, blue]) {
    Object.assign(canvas, { width, height });
    const image = new ImageData(width, height);
    for (let i = 0; i < data.length; ++i) {
        image.data.set([red, green, blue, data[i]], 4 * i);
    }
    canvas.getContext('2d').putImageData(image, 0, 0);
}

function showPicture(canvas, picture) {
    Object.assign(canvas, { width: picture.width, height: picture.height });
    canvas.getContext('2d').drawImage(picture, 0, 0);
}

const exchanged = ({ width, height, data }) => ({ width, height, data: data.map((coverage) => 255 - coverage) });

export class ImportDialog {
    /** @param parts  {worker_url, wasm} of the solver */
    constructor(parts) {
        this.parts = parts;
        this.marking = new Marking((strokes, is_draft) => this.#marked(strokes, is_draft));
        find('threshold').addEventListener('input', () => this.#show());
        find('invert').addEventListener('change', () => this.#show());
        for (const radio of find('finding').querySelectorAll('input')) {
            radio.addEventListener('change', () => this.#find(radio.value));
        }
    }

    /**
     * Asks what a picture shall be, and shows the footprint that it gives.
     * @param ink  colour of the footprint
     * @return {use, mask, photo, colours}; `use` is footprint, colours, underlay or empty; `colours` as coloursOf() gives them
     */
    async ask(canvas, ink) {
        const levels = levelsOf(canvas);
        const colours = coloursOf(levels.image);
        Object.assign(this, { canvas, ink, levels, automatic: undefined, refused: false });
        this.finder = new MaskFinder(this.parts, canvas, levels.image, (answer, is_draft) => this.#answered(answer, is_draft));
        find('divide').hidden = colours.length === 0;
        find('threshold').value = levels.threshold;
        find('invert').checked = levels.inverted;
        find('automatic').hidden = !levels.photo;
        const dialog = find('import');
        dialog.returnValue = '';
        dialog.showModal();
        this.marking.begin(canvas);
        this.#find(levels.photo ? 'automatic' : 'brightness');
        await new Promise((done) => { dialog.addEventListener('close', done, { once: true }); });
        this.finder.end();
        return { use: dialog.returnValue, mask: this.#mask, photo: levels.photo, colours };
    }

    /** Finds the liquid in a way: automatic, brightness or strokes. */
    #find(way) {
        this.way = way;
        this.trouble = undefined;
        find('finding').querySelector(`[value=${way}]`).checked = true;
        find('invert').checked = way === 'brightness' && this.levels.inverted;
        this.finder.stop();
        if (way === 'strokes') {
            this.marking.again();
        } else if (way === 'automatic' && !this.automatic) {
            this.finder.wantAutomatic();
        }
        this.#show();
    }

    #marked(strokes, is_draft) {
        this.trouble = undefined;
        if (this.marking.lacking.length > 0 || this.marking.mask) {
            this.finder.stop();
        } else {
            this.finder.wantMarked(strokes, is_draft);
        }
        this.#show();
    }

    #answered({ mask, error }, is_draft) {
        if (error?.code === 'InvalidInput' && this.way === 'automatic') {
            this.refused = true;
            this.#find('strokes');
            return;
        }
        if (error) {
            console.error(error);
            this.trouble = error;
        } else if (this.way === 'strokes') {
            this.marking.take(mask, is_draft);
        } else {
            this.automatic = mask;
        }
        this.#show();
    }

    /** The mask in the chosen way; undefined while there is none. */
    get #mask() {
        if (this.way === 'brightness') {
            return maskOfLevels(this.levels, Number(find('threshold').value), find('invert').checked);
        }
        if (this.way === 'strokes') {
            return this.marking.mask;
        }
        return this.automatic && find('invert').checked ? exchanged(this.automatic) : this.automatic;
    }

    #show() {
        const { way } = this;
        const mask = this.#mask;
        find('marks').hidden = way !== 'strokes';
        find('preview').hidden = way === 'strokes';
        find('thresholds').hidden = way !== 'brightness';
        find('inverting').hidden = way === 'strokes';
        find('take').disabled = !mask;
        find('advice').textContent = this.#advice(mask !== undefined);
        if (way === 'strokes') {
            return;
        }
        if (mask) {
            showMask(find('preview'), mask, this.ink);
        } else {
            showPicture(find('preview'), this.canvas);
        }
    }

    /** What to do, in the chosen way. */
    #advice(is_found) {
        if (this.trouble) {
            return sentence(this.trouble);
        }
        if (this.way !== 'strokes') {
            return is_found ? '' : say('Looking for liquid…');
        }
        const { lacking } = this.marking;
        if (lacking.length === 2) {
            const what = say('Draw over some liquid; a dot in each drop is enough.');
            return this.refused ? `${say('No clear edge of liquid was found.')} ${what}` : what;
        }
        if (lacking.length === 1) {
            return lacking[0] === 'dry' ? say('Now choose Dry, and draw over the ground around it. A shadow is dry.') :
                say('Now choose Liquid, and draw over some liquid.');
        }
        return is_found ? say('The line is the rim. More strokes mend it.') : say('Looking for the rim…');
    }
}
