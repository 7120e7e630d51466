// Which picture is asked for next: one at a time, and the next one only when the last one is drawn.

import { Pace, SCALES } from "./pace.js";

/** A picture that was not followed by another for so long, in milliseconds, has stopped to change … */
const STILL = 1500;
/** … and for so many times what it takes to fetch the whole, which keeps others waiting. */
const PATIENCE = 3;

/** Knows what the server has and what the page has, and asks for the difference. */
export class Asker {
    pace = new Pace();
    /** What the page has of each side: the heads. */
    have = { now: null, before: null };
    #send;
    #state = null;
    #pending = null;
    #last = null;
    #busy = false;
    #changed = 0;
    #timer = null;
    #longest;
    /** The least scale at which the picture can be drawn. */
    #finest = 1;

    /** `longest`: pixels of the longest side that can be drawn. */
    constructor(send, longest) {
        this.#send = send;
        this.#longest = longest;
    }

    /** A new connection: numbers of another server may begin again. */
    reset() {
        this.have = { now: null, before: null };
        this.#pending = this.#state = null;
        this.#busy = false;
    }

    /** What the server says that it has. */
    know(state) {
        if (state.serial !== this.#state?.serial) {
            this.#changed = performance.now();
        }
        const [x0, y0, x1, y1] = state.window;
        if (state.serial > 0) {
            this.pace.begin((x1 - x0) * (y1 - y0));
            this.#finest = SCALES.find((scale) => Math.max(x1 - x0, y1 - y0) <= scale * this.#longest) ?? 8;
        }
        this.#state = state;
    }

    /** What the page wants to show. */
    want(aov, wipe) {
        this.wanted = { aov, wipe };
        this.next();
    }

    /** A message came, and is being decoded. Nothing is asked for until `drawn`. */
    arrived(head, bytes) {
        const asked = this.#pending;
        this.#busy = true;
        const answers = asked && ["aov", "which", "scale"].every((name) => asked[name] === head[name]);
        if (!answers || head.serial <= asked.after) {
            return;
        }
        this.#pending = null;
        // Time in which the server had nothing to send does not count
        if (head.which === "before" || head.serial <= this.#state.serial) {
            const begun = head.which === "now" && head.serial === this.#state.serial ? this.#changed : 0;
            this.pace.took(head.scale, (performance.now() - Math.max(asked.at, begun)) / 1000, bytes);
        }
    }

    /** It is drawn, or was not worth it: `head` is null then. */
    drawn(head) {
        this.#busy = false;
        if (head) {
            this.have[head.which] = head;
            this.#last = head.which;
        }
        this.next();
    }

    /** Whether the page has all that the server has, as fine as it is. */
    get idle() {
        const { now } = this.have;
        return this.#state !== null && !this.#busy && now !== null && now.serial === this.#state.serial
            && now.aov === this.wanted.aov && now.scale <= this.#finest && !this.#needsBefore(this.#finest);
    }

    /** Asks for what is missing, if it is not on its way. */
    next() {
        if (this.#busy || !this.#state || this.pace.scale === null) {
            return;
        }
        const { which, after, scale } = this.#choose();
        const asked = { aov: this.wanted.aov, which, after, scale };
        const pending = this.#pending;
        if (!pending || Object.keys(asked).some((name) => asked[name] !== pending[name])) {
            this.#pending = { ...asked, at: performance.now() };
            this.#send({ frame: asked });
        }
        clearTimeout(this.#timer);
        if (this.#stillIn > 0) {
            this.#timer = setTimeout(() => this.next(), this.#stillIn + 10);
        }
    }

    /** Milliseconds after which the picture has stopped to change. */
    get #stillIn() {
        return this.#changed + Math.max(STILL, PATIENCE * 1000 * this.pace.whole) - performance.now();
    }

    #choose() {
        const { now } = this.have;
        const rests = now?.serial === this.#state.serial
            && (this.#state.spp >= this.#state.wanted_spp || this.#stillIn <= 0);
        const scale = Math.max(rests ? 1 : this.pace.scale, this.#finest);
        const whole = now?.aov === this.wanted.aov && now.scale <= scale;
        const newest = whole && now.serial === this.#state.serial;
        if (this.#needsBefore(scale) && (newest || this.#last === "now")) {
            return { which: "before", after: 0, scale };
        }
        // One that is newer is asked for before there is one: it comes without a further round trip
        return { which: "now", after: whole || (now?.aov === this.wanted.aov && !rests) ? now.serial : 0, scale };
    }

    #needsBefore(scale) {
        const { before } = this.have;
        return this.wanted.wipe && this.#state.serial_before > 0
            && (before?.aov !== this.wanted.aov || before.serial !== this.#state.serial_before || before.scale > scale);
    }
}
