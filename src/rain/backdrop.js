// SPDX-License-Identifier: MIT
// What is behind the glass: the street, or a picture, panorama or video that is dropped on the page.
import { say } from '../html/words.js';

/** A picture twice as wide as it is high, to this part, is a panorama all around. */
const kPanorama = 0.01;
const kMost = 4096;  // [px] of a picture's longer side

export class Backdrop {
    /**
     * @param view   of view.js
     * @param root   element on which files are dropped
     * @param signal ends it
     * @param shown  called with `street` or `own`, and why a file is not shown
     */
    constructor(view, root, signal, shown) {
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
                this.open(file);
            }
        });
        addEventListener('paste', (event) => {
            const [file] = event.clipboardData?.files ?? [];
            if (file) {
                this.open(file);
            }
        }, { signal });
    }

    /** Whether it changes by itself. */
    get moves() {
        return Boolean(this.video);
    }

    street() {
        this.#end();
        this.view.setPicture();
        this.shown('street');
    }

    /** Shows a file. */
    async open(file) {
        const url = URL.createObjectURL(file);
        try {
            await (file.type.startsWith('video/') ? this.#play(url) : this.#show(await createImageBitmap(file)));
            this.shown('own');
        } catch {
            this.shown('own', say('{file} is not a picture or video that this browser reads', { file: file.name }));
        } finally {
            if (!this.video) {
                URL.revokeObjectURL(url);
            }
        }
    }

    /** Shows a picture by its URL, which may be data. */
    async load(url) {
        const picture = new Image();
        picture.src = url;
        await picture.decode();
        this.#show(await createImageBitmap(picture));
        this.shown('own');
    }

    async #show(bitmap) {
        const { width, height } = bitmap;
        const scale = Math.min(kMost / Math.max(width, height), 1);
        const small = scale < 1
            ? await createImageBitmap(bitmap, { resizeWidth: Math.round(scale * width), resizeHeight: Math.round(scale * height), resizeQuality: 'high' })
            : bitmap;
        this.#end();
        this.view.setPicture(small, { panorama: Math.abs(width / height - 2) < kPanorama * 2 });
    }

    async #play(url) {
        const video = document.createElement('video');
        Object.assign(video, { src: url, muted: true, loop: true, playsInline: true });
        await video.play();
        this.#end();
        this.video = video;
        this.view.setPicture(video);
    }

    #end() {
        this.video?.pause();
        if (this.video) {
            URL.revokeObjectURL(this.video.src);
        }
        this.video = undefined;
    }
}
