// SPDX-License-Identifier: MIT
// What is behind the glass: the street, or a picture, panorama or video that is dropped on the page.
import { say } from '../html/words.js';

/** A picture twice as wide as it is high, to this part, is a panorama all around. */
const kPanorama = 0.01;
const kMost = 4096;  // [px] of a picture's longer side

async function videoOf(file) {
    const video = Object.assign(document.createElement('video'), { src: URL.createObjectURL(file), muted: true, loop: true, playsInline: true });
    try {
        await video.play();
    } catch (error) {
        URL.revokeObjectURL(video.src);
        throw error;
    }
    return video;
}

/** A file, or a picture by its URL, as the view shows it. */
async function pictureOf(what) {
    if (what instanceof Blob && what.type.startsWith('video/')) {
        return videoOf(what);
    }
    const picture = what instanceof Blob ? what : Object.assign(new Image(), { src: what });
    await picture.decode?.();
    const bitmap = await createImageBitmap(picture);
    const { width, height } = bitmap;
    const scale = Math.min(kMost / Math.max(width, height), 1);
    return scale < 1 ?
        createImageBitmap(bitmap, { resizeWidth: Math.round(scale * width), resizeHeight: Math.round(scale * height), resizeQuality: 'high' }) : bitmap;
}

export class Backdrop {
    /**
     * @param view   of view.js
     * @param root   element on which files are dropped
     * @param signal ends it
     * @param chose  called with a file that is dropped or pasted
     * @param shown  called with `street` or `own`, and why a file is not shown
     */
    constructor(view, root, signal, chose, shown) {
        this.view = view;
        this.shown = shown;
        const drop = document.createElement('div');
        drop.className = 'drop';
        drop.textContent = 'Drop a picture, a panorama or a video';
        drop.hidden = true;
        root.append(drop);
        root.addEventListener('dragover', (event) => {
            event.preventDefault();
            drop.hidden = false;
        });
        root.addEventListener('dragleave', (event) => {
            drop.hidden = root.contains(event.relatedTarget);
        });
        root.addEventListener('drop', (event) => {
            event.preventDefault();
            event.stopPropagation();
            drop.hidden = true;
            const [file] = event.dataTransfer.files;
            if (file) {
                chose(file);
            }
        });
        addEventListener('paste', (event) => {
            const [file] = event.clipboardData?.files ?? [];
            if (file) {
                chose(file);
            }
        }, { signal });
    }

    /** Whether it changes by itself. */
    get moves() {
        return Boolean(this.video);
    }

    /** Shows a file, a picture by its URL, which may be data, or the street if undefined. */
    async show(what) {
        this.wanted = what;
        try {
            const picture = what === undefined ? undefined : await pictureOf(what);
            if (this.wanted !== what) {
                return;  // another one was chosen meanwhile
            }
            this.#end();
            this.video = picture instanceof HTMLVideoElement ? picture : undefined;
            this.view.setPicture(picture, { panorama: !this.video && picture && Math.abs(picture.width / picture.height - 2) < kPanorama * 2 });
            this.shown(picture ? 'own' : 'street');
        } catch {
            if (this.wanted === what) {
                this.shown('own', say('{file} is not a picture or video that this browser reads', { file: what.name }));
            }
        }
    }

    #end() {
        this.video?.pause();
        if (this.video) {
            URL.revokeObjectURL(this.video.src);
        }
        this.video = undefined;
    }
}
