// SPDX-License-Identifier: MIT
// Saves pictures and videos of a canvas.

export function download(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** Call it in the task in which the canvas was drawn. */
export function savePicture(canvas, name) {
    canvas.toBlob((blob) => download(blob, `${name}.png`), 'image/png');
}

export class Recorder {
    #recorder;

    /** @param name  of the file, without its ending */
    constructor(canvas, name) {
        this.canvas = canvas;
        this.name = name;
    }

    /** Whether the browser can. */
    get works() {
        return typeof MediaRecorder === 'function' && typeof this.canvas.captureStream === 'function';
    }

    get runs() {
        return this.#recorder !== undefined;
    }

    start() {
        const type = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'].find((kind) => MediaRecorder.isTypeSupported(kind));
        const recorder = new MediaRecorder(this.canvas.captureStream(60), { mimeType: type, videoBitsPerSecond: 16e6 });
        const parts = [];
        recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
        recorder.addEventListener('stop', () => download(new Blob(parts, { type }), type.startsWith('video/mp4') ? `${this.name}.mp4` : `${this.name}.webm`));
        recorder.start(1000);
        this.#recorder = recorder;
    }

    stop() {
        this.#recorder?.stop();
        this.#recorder = undefined;
    }
}
