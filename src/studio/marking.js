// SPDX-License-Identifier: MIT
// Strokes on a photograph that say what is liquid and what is dry, and the rim that follows from them.
import { find } from '../html/controls.js';
import { History } from '../live/history.js';
import { rimPath } from './contour.js';
import { blank, copyOf, isDry } from './coverage.js';
import { Sheet } from './sheet.js';

const kInks = { liquid: [30, 136, 255], dry: [255, 136, 0] };
const kOther = { liquid: 'dry', dry: 'liquid' };
const kUsualSize = 1 / 50;  // of a stroke, as a part of the longer side
const kLargestSize = 1 / 6;

/** The strokes without those that newer ones cover. */
function without(older, newer) {
    const left = copyOf(older);
    newer.data.forEach((coverage, i) => { left.data[i] = Math.min(left.data[i], 255 - coverage); });
    return left;
}

const stateOf = (strokes) => ({ layers: Object.entries(strokes).map(([kind, mask]) => ({ kind, mask })) });

export class Marking {
    /** @param changed  called with ({liquid, dry}, is_draft) when the strokes have changed; drafts are under the hand */
    constructor(changed) {
        this.changed = changed;
        this.sheet = new Sheet(
            { table: find('mark-table'), paper: find('mark-paper'), sheet: find('mark-sheet'), cursor: find('mark-cursor'), fit: find('mark-fit') },
            {
                layers: () => this.#layers(),
                base: () => this.#strokes[this.#kind],
                tool: () => ({ name: 'brush', removes: false, setting: { size: Number(find('mark-size').value) } }),
            },
            {
                began: () => {},
                drew: (mask, rect) => this.#drew(mask, rect),
                ended: (mask) => this.#ended(mask),
                gaveUp: () => this.#show(),
                moved: () => {},
            });
        find('mark-undo').addEventListener('click', () => this.#undo('undo'));
        find('mark-redo').addEventListener('click', () => this.#undo('redo'));
        find('mark-clear').addEventListener('click', () => this.#add({ liquid: this.#blank(), dry: this.#blank() }));
        find('marks').addEventListener('change', () => this.sheet.paint());
        find('import').addEventListener('keydown', (event) => this.#key(event));
    }

    /** Begins with a photograph, and without strokes. */
    begin(canvas) {
        const { width, height } = canvas;
        const longer = Math.max(width, height);
        this.history = new History(stateOf({ liquid: blank(width, height), dry: blank(width, height) }));
        Object.assign(find('mark-size'), { min: 3, max: Math.round(kLargestSize * longer), value: Math.round(kUsualSize * longer) });
        find('marks').querySelector('[value=liquid]').checked = true;
        const photo = find('mark-photo');
        Object.assign(photo, { width, height });
        photo.getContext('2d').drawImage(canvas, 0, 0);
        this.sheet.resize(width, height, 1);
        this.sheet.whole();
        this.#showRim(undefined);
        this.#paint();
    }

    /** Tells the strokes again. */
    again() {
        if (this.mask || this.lacking.length > 0) {
            this.#showRim(this.mask);  // else, the one before stays until there is another
        }
        this.changed(this.#strokes, false);
    }

    /** Takes the mask that has been found for the strokes; drafts are smaller. */
    take(mask, is_draft) {
        if (is_draft && this.mask) {
            return;  // the whole one came first
        }
        if (!is_draft) {
            this.found = { mask, state: this.history.state };
        }
        this.#showRim(mask);
    }

    /** The whole mask for the strokes as they are; undefined while there is none. */
    get mask() {
        return !this.stroke && this.found?.state === this.history.state ? this.found.mask : undefined;
    }

    #showRim(mask) {
        const rim = find('mark-rim');
        rim.setAttribute('viewBox', mask ? `0 0 ${mask.width} ${mask.height}` : '0 0 1 1');
        const path = mask ? rimPath(mask) : '';
        rim.querySelectorAll('path').forEach((each) => each.setAttribute('d', path));
    }

    /** Names of the strokes that are still to be made. */
    get lacking() {
        return Object.entries(this.#strokes).filter(([, mask]) => isDry(mask)).map(([kind]) => kind);
    }

    get #kind() {
        return find('marks').querySelector('[name=stroke]:checked').value;
    }

    get #strokes() {
        return Object.fromEntries(this.history.state.layers.map(({ kind, mask }) => [kind, mask]));
    }

    #blank() {
        const { width, height } = this.#strokes.liquid;
        return blank(width, height);
    }

    /** The strokes that are under the hand lie over the others. */
    #layers() {
        const kind = this.#kind;
        const strokes = { ...this.#strokes, ...this.stroke && { [kind]: this.stroke } };
        return [kOther[kind], kind].map((each) => ({ data: strokes[each].data, ink: kInks[each], selected: true }));
    }

    #drew(mask, rect) {
        this.stroke = mask;
        this.sheet.paint(rect);
        this.changed({ ...this.#strokes, [this.#kind]: mask }, true);
    }

    #ended(mask) {
        const [kind, strokes] = [this.#kind, this.#strokes];
        this.#add({ ...strokes, [kind]: mask, [kOther[kind]]: without(strokes[kOther[kind]], mask) });
    }

    #add({ liquid, dry }) {
        this.history.add(stateOf({ liquid, dry }));
        this.#show();
    }

    #undo(step) {
        if (this.stroke) {
            this.sheet.cancel();
            return;
        }
        this.history[step]();
        this.#show();
    }

    #show() {
        this.#paint();
        this.again();
    }

    #paint() {
        this.stroke = undefined;
        this.sheet.paint();
        find('mark-undo').disabled = !this.history.can_undo;
        find('mark-redo').disabled = !this.history.can_redo;
        find('mark-clear').disabled = this.lacking.length === 2;
    }

    #key(event) {
        const key = event.key.toLowerCase();
        const step = { z: event.shiftKey ? 'redo' : 'undo', y: 'redo' }[key];
        if (find('marks').hidden) {
            return;
        }
        if ((event.ctrlKey || event.metaKey) && step) {
            event.preventDefault();
            this.#undo(step);
        } else if (key === 'x') {
            find('marks').querySelector('[name=stroke]:not(:checked)').click();
        }
    }
}
