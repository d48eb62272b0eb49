// SPDX-License-Identifier: MIT
// Records outlines as a Lottie animation, and saves it, as Recorder does videos.
import { download } from '../live/recorder.js';

const kWidth = 1280;  // [px]
const kRate = 24;     // frames a second of the liquid's time

export class LottieRecorder {
    #part;
    #liquid;
    #next;

    /** @param part  `liquid`, whose outlines are recorded, and `values.look` */
    constructor(part) {
        this.#part = part;
    }

    get works() {
        return true;
    }

    get runs() {
        return this.#liquid !== undefined;
    }

    start() {
        this.#liquid = this.#part.liquid;
        this.#liquid.record(this.#part.values.look, kWidth, kRate);
        this.#next = this.#liquid.figures().time;
        this.keep();
    }

    /** Takes the outlines of the last call if a frame is due. */
    keep() {
        if (this.runs && this.#liquid.figures().time > this.#next - 1e-9) {
            this.#liquid.keep();
            this.#next += 1 / kRate;
        }
    }

    stop() {
        if (this.runs) {
            download(new Blob([this.#liquid.lottie()], { type: 'application/json' }), 'splash.json');
        }
        this.#liquid = undefined;
    }
}
