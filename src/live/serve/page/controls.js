// The bar on top: what is chosen there, and how it is written there.

import { AOVS, CURVES } from "./shade.js";
import { stops as stopsText } from "./text.js";

const find = (id) => document.getElementById(id);
/** Stops to a key. */
const STEP = 0.5;

/** What is chosen. `changed` is called after each choice. */
export class Controls {
    aov = "color";
    stops = 0;
    /** Whether the next click focuses. */
    armed = false;
    #curve = "scene";
    #changed;

    constructor(changed) {
        this.#changed = changed;
        find("aov").addEventListener("change", (event) => this.show(event.target.value));
        find("curve").addEventListener("change", (event) => {
            this.#curve = event.target.value;
            changed();
        });
        find("stops").addEventListener("input", (event) => this.expose(Number(event.target.value)));
        find("aov").replaceChildren(...AOVS.map((name) => new Option(name)));
        find("curve").replaceChildren(...["scene", ...CURVES].map((name) => new Option(name, name)));
        this.#write();
    }

    show(aov) {
        this.aov = aov;
        find("aov").value = aov;
        this.#changed();
    }

    /** The plane so many places further in the list. */
    turn(by) {
        this.show(AOVS[(AOVS.indexOf(this.aov) + by + AOVS.length) % AOVS.length]);
    }

    expose(to) {
        const { min, max } = find("stops");
        this.stops = Math.min(Math.max(to, Number(min)), Number(max));
        this.#write();
        this.#changed();
    }

    #write() {
        find("stops").value = String(this.stops);
        find("stops").setAttribute("aria-valuetext", `${stopsText(this.stops)} stops`);
        find("stops-reset").textContent = stopsText(this.stops);
        find("stops-reset").setAttribute("aria-label", `${stopsText(this.stops)} stops: back to 0`);
    }

    /** Brighter or darker by one step. */
    brighten(sign) {
        this.expose((Math.round(this.stops / STEP) + sign) * STEP);
    }

    arm(armed) {
        this.armed = armed && !find("focus").disabled;
        find("focus").setAttribute("aria-pressed", String(this.armed));
    }

    /** The curve, where the scene asks for one. */
    curve(scene) {
        return this.#curve === "scene" ? scene : this.#curve;
    }

    /** Writes what the scene asks for, and what can be done. */
    know(state) {
        const scene = find("curve").options[0];
        const name = CURVES.includes(state.tone_curve) ? `scene (${state.tone_curve})` : "scene";
        if (scene.textContent !== name) {
            scene.textContent = name;
        }
        find("focus").disabled = !state.camera?.lens;
        find("focus").title = state.camera?.lens
            ? "Focus on what is clicked next (C, alt-click)" : "The camera has no lens that can be focused";
        find("look-reset").disabled = !state.camera?.moved;
        this.arm(this.armed);
    }

    /** Writes the zoom. */
    zoomed(zoom) {
        const text = `${zoom < 0.1 ? (100 * zoom).toFixed(1) : Math.round(100 * zoom)} %`;
        if (find("zoom-one").textContent !== text) {
            find("zoom-one").textContent = text;
            find("zoom-one").setAttribute("aria-label", `Zoom ${text}: to 100 %`);
        }
    }
}
