// What each key and button does.

import { dolly, orbit, slide } from "./look.js";

/** Radians, parts of the distance, and factors to a key. */
const TURN = 0.1;
const STEP = 0.05;
const NEARER = 0.9;
const ZOOM = Math.SQRT2;

/** The keys, as `keys.js` wants them. Buttons of the bar that do the same are wired too. */
export function table({ controls, wipe, zoom, look, redraw, focus, dialog }) {
    const zoomed = (change) => () => {
        change();
        redraw();
    };
    const turn = (right, above) => () => look.step((stand) => orbit(stand, right * TURN, above * TURN));
    const move = (right, above) => () => look.step((stand) => slide(stand, right * STEP, above * STEP));
    const nearer = (factor) => () => look.step((stand) => dolly(stand, factor));
    const entry = (keys, shown, text, run, button) => ({ keys, shown, text, run, button });
    const entries = [
        entry(["f"], "F", "the whole picture", zoomed(() => zoom.fit()), "zoom-fit"),
        entry(["1"], "1", "one pixel to one of the screen", zoomed(() => zoom.to(1)), "zoom-one"),
        entry(["+", "="], "+", "zoom in", zoomed(() => zoom.by(ZOOM)), "zoom-in"),
        entry(["-"], "-", "zoom out", zoomed(() => zoom.by(1 / ZOOM)), "zoom-out"),
        entry(["e"], "E", "brighter by half a stop", () => controls.brighten(1)),
        entry(["shift+e"], "shift + E", "darker by half a stop", () => controls.brighten(-1)),
        entry(["0"], "0", "exposure back to 0", () => controls.expose(0), "stops-reset"),
        entry(["a"], "A", "the next plane", () => controls.turn(1)),
        entry(["shift+a"], "shift + A", "the plane before", () => controls.turn(-1)),
        entry(["w"], "W", "beside the generation before, or not", () => wipe.toggle(), "wipe"),
        entry(["r"], "R", "look from where the scene says", () => look.reset(), "look-reset"),
        entry(["ArrowLeft"], "arrows", "turn the camera about its target", turn(-1, 0)),
        entry(["ArrowRight"], "", "", turn(1, 0)),
        entry(["ArrowUp"], "", "", turn(0, 1)),
        entry(["ArrowDown"], "", "", turn(0, -1)),
        entry(["shift+ArrowLeft"], "shift + arrows", "move the camera across the view", move(-1, 0)),
        entry(["shift+ArrowRight"], "", "", move(1, 0)),
        entry(["shift+ArrowUp"], "", "", move(0, 1)),
        entry(["shift+ArrowDown"], "", "", move(0, -1)),
        entry(["PageUp"], "page up, page down", "nearer, farther", nearer(NEARER)),
        entry(["PageDown"], "", "", nearer(1 / NEARER)),
        entry(["c"], "C", "the next click focuses; enter: on what is in the middle", () => controls.arm(!controls.armed), "focus"),
        entry(["Enter"], "", "", () => controls.armed && focus(zoom.middle)),
        entry(["Escape"], "", "", () => controls.arm(false)),
        entry(["?"], "?", "this list", () => dialog.showModal(), "help"),
    ];
    for (const { button, run } of entries.filter((one) => one.button)) {
        document.getElementById(button).addEventListener("click", run);
    }
    return entries;
}
