// SPDX-License-Identifier: MIT
// The dialog about a picture: where its liquid begins, and what it is for.
import { find } from '../html/controls.js';
import { coloursOf } from './colours.js';
import { levelsOf, maskOfLevels } from './pictures.js';

/** Shows a mask in a colour. */
function showMask(canvas, { width, height, data }, [red, green, blue]) {
    Object.assign(canvas, { width, height });
    const image = new ImageData(width, height);
    for (let i = 0; i < data.length; ++i) {
        image.data.set([red, green, blue, data[i]], 4 * i);
    }
    canvas.getContext('2d').putImageData(image, 0, 0);
}

/**
 * Asks what a picture shall be, and shows the footprint that it gives.
 * @param ink  colour of the footprint
 * @return {use, mask, photo, colours}; `use` is footprint, colours, underlay or empty; `colours` as coloursOf() gives them
 */
export async function askPicture(canvas, ink) {
    const levels = levelsOf(canvas);
    const colours = coloursOf(levels.image);
    find('divide').hidden = colours.length === 0;
    const dialog = find('import');
    find('threshold').value = levels.threshold;
    find('invert').checked = levels.inverted;
    let mask;
    const show = () => {
        mask = maskOfLevels(levels, Number(find('threshold').value), find('invert').checked);
        showMask(find('preview'), mask, ink);
    };
    show();
    find('threshold').oninput = find('invert').oninput = show;
    dialog.returnValue = '';
    dialog.showModal();
    await new Promise((done) => { dialog.addEventListener('close', done, { once: true }); });
    return { use: dialog.returnValue, mask, photo: levels.photo, colours };
}
