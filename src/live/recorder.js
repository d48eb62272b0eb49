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

const kTypes = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];

export class Recorder {
    #recorder;
    #type = typeof MediaRecorder === 'function' ? kTypes.find((type) => MediaRecorder.isTypeSupported(type)) : undefined;

    /**
     * @param name   of the file, without its ending
     * @param empty  called when the browser has recorded nothing
     */
    constructor(canvas, name, empty) {
        Object.assign(this, { canvas, name, empty });
    }

    /** Whether the browser says that it can; WebKit for GTK with an older GStreamer says so and records nothing. */
    get works() {
        return this.#type !== undefined && typeof this.canvas.captureStream === 'function';
    }

    get runs() {
        return this.#recorder !== undefined;
    }

    start() {
        const type = this.#type;
        const recorder = new MediaRecorder(this.canvas.captureStream(60), { mimeType: type, videoBitsPerSecond: 16e6 });
        const parts = [];
        recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
        recorder.addEventListener('stop', () => {
            const video = new Blob(parts, { type });
            video.size > 0 ? download(video, `${this.name}.${type.startsWith('video/mp4') ? 'mp4' : 'webm'}`) : this.empty();
        });
        recorder.start(1000);
        this.#recorder = recorder;
    }

    stop() {
        this.#recorder?.stop();
        this.#recorder = undefined;
    }
}
