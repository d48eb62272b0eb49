// SPDX-License-Identifier: MIT
// Looks as small pictures of a drop, from scripts/make-pictures, which has them in the order of kLooks.
import { kLooks } from './looks.js';
import picture from './looks.png';

const kPitch = 64;        // from drop to drop in the picture [pixels]
const kSize = [56, 70];   // of a drop in it

/**
 * Fills `host` with a button for every look.
 * @param field  whose choices name the looks
 * @param chose  called with the look
 * @return a function that marks a look as chosen
 */
export function buildTiles(host, { choices }, chose) {
    const tiles = Object.assign(document.createElement('div'), { className: 'tiles' });
    Object.keys(kLooks).forEach((look, index) => {
        const button = Object.assign(document.createElement('button'), { type: 'button', value: look, title: choices[look] });
        button.setAttribute('aria-label', choices[look]);
        button.addEventListener('click', () => button.ariaPressed === 'true' || chose(look));
        const drop = document.createElement('i');
        Object.assign(drop.style, {
            backgroundImage: `url(${picture})`, backgroundPosition: `${-kPitch / 2 * index}px 0`, backgroundSize: 'auto 100%',
            width: `${kSize[0] / 2}px`, height: `${kSize[1] / 2}px`,
        });
        button.append(drop);
        tiles.append(button);
    });
    host.append(tiles);
    return (chosen) => tiles.querySelectorAll('button').forEach((button) => button.setAttribute('aria-pressed', button.value === chosen));
}
