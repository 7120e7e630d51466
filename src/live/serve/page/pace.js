// How coarse a picture may be so that it arrives in time.

const LONGEST = 0.5;
/** Numbers that are fetched before any time is known. */
const FIRST_PIXELS = 5e5;
/** Bytes that take hardly longer than one. */
const SMALL = 5e4;
export const SCALES = [1, 2, 4, 8];

/** Times of pictures, and what follows from them. */
export class Pace {
    scale = null;
    /** Bytes a second of the last picture. */
    rate = null;
    /** Seconds of the whole picture, as far as it is known. */
    whole = 0;
    /** The shortest answer to a small picture, in seconds: what it takes before the first byte comes. */
    #base = 0;

    /** The scale to begin with, for so many pixels. */
    begin(pixels) {
        this.scale ??= SCALES.find((scale) => pixels / scale ** 2 <= FIRST_PIXELS) ?? 8;
    }

    /** A picture of some scale took so many seconds for its bytes. */
    took(scale, seconds, bytes) {
        this.rate = bytes / Math.max(seconds, 1e-3);
        if (bytes <= SMALL) {
            this.#base = Math.min(this.#base || seconds, seconds);
        }
        const base = Math.min(this.#base, seconds);
        const estimate = (other) => base + (seconds - base) * (scale / other) ** 2;
        this.whole = estimate(1);
        // From a small picture little is known of large ones
        this.scale = Math.max(SCALES.find((other) => estimate(other) <= LONGEST) ?? 8, scale / 2);
    }
}
