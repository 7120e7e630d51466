// The pictures that are shown, now and before, and how their generations want them shown.

import { range, texel } from "./frame.js";

/** Generations of which it is known how they want to be shown. */
const MOST_KEPT = 8;

export class Sides {
    now = null;
    before = null;
    /** Gain, curve, window and size of generations, by their numbers. */
    #wishes = new Map();

    /** Learns how the newest generation wants to be shown. */
    know({ serial, generation, gain, tone_curve: curve, window, size }) {
        if (serial > 0) {
            this.#wishes.set(generation, { gain, curve, window, size });
            [...this.#wishes.keys()].slice(0, -MOST_KEPT).forEach((old) => this.#wishes.delete(old));
        }
    }

    /** A server that is another one counts anew. */
    forget() {
        this.#wishes.clear();
    }

    /** Takes a decoded picture. */
    take(frame) {
        const { head } = frame;
        const size = [head.width * head.scale, head.height * head.scale];
        this[head.which] = {
            ...frame,
            range: head.aov === "depth" ? range(frame) : [0, 1],
            wish: { gain: 1, curve: "srgb", window: [0, 0, ...size], size },
        };
    }

    /** How a side is to be shown, null where there is no picture. */
    wish(which) {
        const side = this[which];
        if (side) {
            side.wish = this.#wishes.get(side.head.generation) ?? side.wish;
        }
        return side?.wish ?? null;
    }

    /** Whether a pixel of the whole picture is rendered. */
    has([x, y], which = "now") {
        const [x0, y0, x1, y1] = this.wish(which)?.window ?? [0, 0, 0, 0];
        return x >= x0 && x < x1 && y >= y0 && y < y1;
    }

    /** Red, green and blue at a pixel of the whole picture; null where none is rendered. */
    pixel(x, y, which = "now") {
        if (!this.has([x, y], which)) {
            return null;
        }
        const { head } = this[which];
        const [x0, y0] = this.wish(which).window;
        return texel(this[which], Math.floor((x - x0) / head.scale), Math.floor((y - y0) / head.scale));
    }
}
