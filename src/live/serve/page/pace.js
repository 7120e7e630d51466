// How coarse a picture may be so that it arrives in time.

const LONGEST = 0.5;
/** Numbers that are fetched before any time is known. */
const FIRST_PIXELS = 5e5;
const SCALES = [1, 2, 4, 8];

/** Times of pictures, and what follows from them. */
export class Pace {
    scale = null;
    /** Bytes a second of the last picture. */
    rate = null;
    /** The shortest answer so far, in seconds: what even the smallest picture takes. */
    #base = Infinity;

    /** The scale to begin with, for so many pixels. */
    begin(pixels) {
        this.scale ??= SCALES.find((scale) => pixels / scale ** 2 <= FIRST_PIXELS) ?? 8;
    }

    /** A picture of some scale took so many seconds for its bytes. */
    took(scale, seconds, bytes) {
        this.rate = bytes / Math.max(seconds, 1e-3);
        this.#base = Math.min(this.#base, seconds);
        const estimate = (other) => this.#base + (seconds - this.#base) * (scale / other) ** 2;
        const best = SCALES.find((other) => estimate(other) <= LONGEST) ?? 8;
        // From a small picture little is known of large ones
        this.scale = Math.max(best, scale / 2);
    }
}
