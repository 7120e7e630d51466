// What the pointer does on the canvas.

import { dolly, orbit, slide } from "./look.js";

/** Radians to a pixel. */
const TURN = 0.006;
/** How much nearer to a pixel, and to a notch of a wheel. */
const NEARER = 0.004;
const WHEEL = 0.002;

/** For the list of keys. */
export const GESTURES = [
    ["wheel", "zoom at the pointer"],
    ["middle drag, space + drag", "move the picture"],
    ["left drag", "turn the camera about its target"],
    ["right drag, ctrl + wheel", "go nearer or farther"],
    ["shift + left drag", "move the camera across the view"],
    ["alt + click", "focus the lens on what is clicked"],
];

/**
 * Listens on the canvas. `on`: `zoom` (a Zoom), `look` (a Look), `redraw()`, `hover(point or null)`, `focus(point)`, and
 * `armed()`, whether the next click focuses. Points are in pixels of the canvas.
 */
export function listen(canvas, on) {
    let drag = null;
    let space = false;
    const ratio = () => canvas.width / canvas.clientWidth;
    const point = (event) => {
        const box = canvas.getBoundingClientRect();
        return [(event.clientX - box.left) * ratio(), (event.clientY - box.top) * ratio()];
    };
    const mark = () => {
        canvas.classList.toggle("pan", space || drag?.kind === "pan");
        canvas.classList.toggle("held", drag !== null);
    };
    const kind = (event) => {
        if (event.button === 1 || (event.button === 0 && space)) {
            return "pan";
        }
        if (event.button === 2) {
            return "dolly";
        }
        return event.shiftKey ? "slide" : "orbit";
    };
    const moves = {
        pan: (x, y) => {
            on.zoom.move(x * ratio(), y * ratio());
            on.redraw();
        },
        // The scene follows the pointer
        orbit: (x, y) => on.look.step((stand) => orbit(stand, -x * TURN, y * TURN)),
        slide: (x, y) => {
            const height = on.zoom.zoom * on.zoom.height / ratio();
            on.look.step((stand) => slide(stand, -x / height, y / height));
        },
        dolly: (x, y) => on.look.step((stand) => dolly(stand, Math.exp((y - x) * NEARER))),
    };

    canvas.addEventListener("pointerdown", (event) => {
        if (drag) {
            return;
        }
        if (event.button === 0 && !space && (event.altKey || on.armed())) {
            on.focus(point(event));
            return;
        }
        drag = { kind: kind(event), id: event.pointerId, at: [event.clientX, event.clientY] };
        canvas.setPointerCapture(event.pointerId);
        mark();
    });
    canvas.addEventListener("pointermove", (event) => {
        on.hover(point(event));
        if (drag?.id === event.pointerId) {
            const [x, y] = [event.clientX - drag.at[0], event.clientY - drag.at[1]];
            drag.at = [event.clientX, event.clientY];
            if (x !== 0 || y !== 0) {
                moves[drag.kind](x, y);
            }
        }
    });
    const release = (event) => {
        if (drag?.id === event.pointerId) {
            drag = null;
            mark();
        }
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => on.hover(null));
    // The middle button would scroll by itself
    canvas.addEventListener("mousedown", (event) => event.button === 1 && event.preventDefault());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        // Lines and pages as pixels
        const notches = event.deltaY * [1, 16, 400][event.deltaMode];
        if (event.ctrlKey) {
            on.look.step((stand) => dolly(stand, Math.exp(notches * WHEEL)));
        } else {
            on.zoom.by(Math.exp(-notches * WHEEL), point(event));
            on.redraw();
        }
    }, { passive: false });

    const holds = (event, down) => {
        const free = event.target === canvas || event.target === document.body;
        if (event.code === "Space" && (free || !down)) {
            space = down;
            mark();
            if (free) {
                event.preventDefault();
            }
        }
    };
    window.addEventListener("keydown", (event) => holds(event, true));
    window.addEventListener("keyup", (event) => holds(event, false));
    window.addEventListener("blur", () => {
        space = false;
        mark();
    });
}
