// Where the camera looks from: it turns about its target, goes nearer, and moves across the view.

/** Least angle between the view and up, where a camera would turn over. */
const POLE = 0.02;
/** When nothing came of the last step for so long, in milliseconds, the next one is sent all the same. */
const PATIENCE = 1000;

const add = (a, b, factor = 1) => a.map((value, i) => value + factor * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(...a);
const unit = (a) => a.map((value) => value / length(a));

/** A vector turned about an axis of length 1 (Rodrigues). */
function turned(v, axis, angle) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const along = dot(axis, v) * (1 - c);
    const side = cross(axis, v);
    return v.map((value, i) => value * c + side[i] * s + axis[i] * along);
}

/** Turns about the target, by angles to the right and upwards. */
export function orbit({ position, target, up }, right, above) {
    const axis = unit(up);
    const from = turned(add(position, target, -1), axis, right);
    const height = Math.acos(Math.min(Math.max(dot(unit(from), axis), -1), 1));
    const bounded = Math.min(Math.max(height - above, POLE), Math.PI - POLE);
    const side = unit(cross(axis, from));
    return { position: add(target, turned(from, side, bounded - height)), target, up };
}

/** Goes nearer: what is left of the distance is `factor`. */
export function dolly({ position, target, up }, factor) {
    return { position: add(target, add(position, target, -1), factor), target, up };
}

/** Moves camera and target across the view, in parts of their distance. */
export function slide({ position, target, up }, right, above) {
    const view = add(target, position, -1);
    const side = unit(cross(view, up));
    const over = unit(cross(side, view));
    const move = add(side.map((value) => value * right), over, above).map((value) => value * length(view));
    return { position: add(position, move), target: add(target, move), up };
}

/** Whether two places are one for the server, which has numbers of 32 bits. */
const same = (a, b) => a.every((value, i) => Math.fround(value) === Math.fround(b[i]));

/** Says where to look from and what to focus on, no faster than pictures come of it. */
export class Look {
    #send;
    #state = null;
    /** Where it shall be looked from, until a picture from there has come. */
    #wanted = null;
    #unsent = false;
    #sent = null;

    constructor(send) {
        this.#send = send;
    }

    /** Whether a step has not come back as a picture yet. */
    get waits() {
        return this.#wanted !== null || this.#sent !== null;
    }

    /** Steps on: `step` makes another stand of one. */
    step(step) {
        const from = this.#wanted ?? this.#state?.camera;
        if (from) {
            this.#wanted = step({ position: from.position, target: from.target, up: from.up });
            this.#unsent = true;
            this.#flush();
        }
    }

    /** Back to where the scene says. */
    reset() {
        this.forget();
        this.#say({ look: null });
    }

    /** Focuses on what is seen in a pixel. */
    focus(pixel) {
        this.forget();
        this.#say({ focus: pixel });
    }

    /** Steps that are not sent are dropped. */
    forget() {
        clearTimeout(this.#sent?.timer);
        [this.#wanted, this.#unsent, this.#sent] = [null, false, null];
    }

    know(state) {
        this.#state = state;
        const { generation, attempts } = this.#sent ?? {};
        if (this.#sent && (state.generation > generation || (state.error && state.attempts > attempts))) {
            this.#came();
        }
        const { camera } = state;
        const there = camera && this.#wanted && ["position", "target"].every((name) => same(camera[name], this.#wanted[name]));
        if (there && !this.#unsent) {
            this.#wanted = null;
        }
    }

    #came() {
        clearTimeout(this.#sent.timer);
        this.#sent = null;
        if (this.#unsent) {
            this.#flush();
        }
    }

    #flush() {
        if (this.#sent === null) {
            this.#unsent = false;
            this.#say({ look: this.#wanted });
        }
    }

    #say(message) {
        if (this.#state) {
            const timer = setTimeout(() => this.#came(), PATIENCE);
            this.#sent = { generation: this.#state.generation, attempts: this.#state.attempts, timer };
            this.#send(message);
        }
    }
}
