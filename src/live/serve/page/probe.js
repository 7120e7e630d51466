// Asks for the values of the pixel under the pointer.

/** Least time between two questions, and how long an answer is waited for, in milliseconds. */
const PERIOD = 50;
const PATIENCE = 1000;

export class Prober {
    #send;
    #pixel = null;
    #asked = "";
    #at = -Infinity;
    #waits = false;
    #timer = null;

    constructor(send) {
        this.#send = send;
    }

    /** The pointer is on a pixel that is rendered, or on none: null. */
    hover(pixel) {
        this.#pixel = pixel;
        if (pixel === null || pixel.join() !== this.#asked) {
            this.#ask();
        }
    }

    /** The values may be others now. */
    again() {
        this.#asked = "";
        this.#ask();
    }

    /** An answer: what to show, null when the pointer is gone. */
    came(values) {
        this.#waits = false;
        if (this.#pixel?.join() !== this.#asked) {
            this.#ask();
        }
        return this.#pixel && values;
    }

    failed() {
        this.#waits = false;
    }

    #ask() {
        clearTimeout(this.#timer);
        if (this.#pixel === null) {
            return;
        }
        const wait = this.#at + (this.#waits ? PATIENCE : PERIOD) - performance.now();
        if (wait > 0) {
            this.#timer = setTimeout(() => this.#ask(), wait);
            return;
        }
        [this.#at, this.#waits, this.#asked] = [performance.now(), true, this.#pixel.join()];
        this.#send({ probe: this.#pixel });
    }
}
