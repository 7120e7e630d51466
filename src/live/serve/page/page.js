// Wires the page together: what the server says goes to the parts, and what the parts ask goes to the server.
//
// For tests and the curious, `window.dapple` has
//   state    what the server said last, or null
//   shown    { generation, serial, spp, scale, aov, which } of the picture on the canvas, or null
//   before   the same of the picture left of the divider, or null
//   pixel    (x, y, which = "now") → [r, g, b] linear, of what is shown, at a pixel of the whole picture; null where none is rendered
//   place    (x, y) → where the middle of that pixel is in the window of the browser, in its units
//   idle     true when all that the server has is drawn at full size, and nothing that was asked for is under way

import { Asker } from "./ask.js";
import { Controls } from "./controls.js";
import { decode, headOf } from "./frame.js";
import * as keys from "./keys.js";
import { Look } from "./look.js";
import * as panel from "./panel.js";
import { listen as listenToPointer } from "./pointer.js";
import { Prober } from "./probe.js";
import { Sides } from "./sides.js";
import { Socket, tokenQuery } from "./socket.js";
import { table } from "./table.js";
import { theme } from "./theme.js";
import * as trouble from "./trouble.js";
import { View } from "./view.js";
import { Wipe } from "./wipe.js";
import { Zoom } from "./zoom.js";

const find = (id) => document.getElementById(id);
const canvas = find("picture");

let state = null;
let scheduled = false;
/** Counts connections: what came through an old one says nothing of the new one. */
let connection = 0;
/** Heads of the pictures that will have been drawn after the next drawing. */
let fresh = [];

const view = makeView();
const sides = new Sides();
const zoom = new Zoom();
const socket = new Socket({ open, closed, text: said, binary: received });
const send = (message) => socket.send(message);
const asker = new Asker(send, view?.longest ?? Infinity);
const look = new Look(send);
const prober = new Prober(send);
const controls = new Controls(choose);
const wipe = new Wipe(choose);

function makeView() {
    try {
        return new View(canvas, redraw);
    } catch (error) {
        find("empty").textContent = `The picture cannot be shown: ${error.message}`;
        return null;
    }
}

function open() {
    connection += 1;
    fresh = [];
    trouble.offline(false);
    asker.reset();
    sides.forget();
    look.forget();
}

function closed() {
    trouble.offline(true);
    look.forget();
}

function said(message) {
    if (message.state) {
        know(message.state);
    } else if (message.probe) {
        panel.probe(prober.came(message.probe));
    } else if (message.failed) {
        prober.failed();
        look.forget();
        trouble.notice(message.failed);
    }
}

function know(now) {
    state = now;
    [sides, asker, look, controls].forEach((part) => part.know(now));
    trouble.show(now);
    prober.again();
    asker.next();
    redraw();
}

async function received(message) {
    const head = headOf(message);
    asker.arrived(head, message.byteLength);
    const from = connection;
    let frame = null;
    try {
        frame = await decode(message);
    } catch (error) {
        trouble.notice(`a picture came that cannot be shown: ${error.message}`);
    }
    if (from !== connection) {
        return;
    }
    // What is no more wanted is dropped
    if (frame && head.aov === controls.aov && (head.which === "now" || wipe.on)) {
        sides.take(frame);
        view?.set(head.which, frame);
        fresh.push(head);
        redraw();
    } else {
        asker.drawn(null);
    }
}

/** Something else is wanted. */
function choose() {
    asker.want(controls.aov, wipe.on);
    find("wipe").setAttribute("aria-pressed", String(wipe.on));
    redraw();
}

function redraw() {
    if (!scheduled) {
        scheduled = true;
        requestAnimationFrame(draw);
    }
}

function draw() {
    scheduled = false;
    const size = [canvas.clientWidth, canvas.clientHeight].map((length) => Math.max(1, Math.round(length * devicePixelRatio)));
    if (canvas.width !== size[0] || canvas.height !== size[1]) {
        [canvas.width, canvas.height] = size;
    }
    const { now } = sides;
    if (now) {
        zoom.resize(size, sides.wish("now").size);
        controls.zoomed(zoom.zoom);
        find("empty").hidden = view !== null;
    }
    // Planes of two kinds cannot be drawn at once
    const before = wipe.on && sides.before?.head.aov === now?.head.aov ? sides.before : null;
    wipe.name(before?.head, now?.head);
    view?.draw({ now: exposed("now"), before: before && exposed("before") }, {
        zoom: zoom.zoom,
        pan: zoom.pan,
        aov: now?.head.aov ?? "color",
        range: now?.range ?? [0, 1],
        wipe: wipe.on ? wipe.place * size[0] : null,
        around: getComputedStyle(find("stage")).backgroundColor.match(/[\d.]+/g).slice(0, 3).map((v) => v / 255),
    });
    fresh.splice(0).forEach((head) => asker.drawn(head));
    panel.numbers(state, { shown: now?.head ?? null, rate: asker.pace.rate, online: socket.open });
    panel.links(state?.serial > 0, tokenQuery());
}

function exposed(which) {
    const wish = sides.wish(which);
    return wish && { ...wish, gain: wish.gain * 2 ** controls.stops, curve: controls.curve(wish.curve) };
}

/** A point of the canvas as a pixel that is rendered, or null. */
function pixelAt(point) {
    const pixel = point && zoom.pixel(point);
    return pixel && sides.has(pixel) ? pixel : null;
}

function hover(point) {
    const pixel = pixelAt(point);
    prober.hover(pixel);
    if (!pixel) {
        panel.probe(null);
    }
}

function focus(point) {
    const pixel = pixelAt(point);
    controls.arm(false);
    if (pixel && state?.camera?.lens) {
        look.focus(pixel);
    }
}

function place(x, y) {
    const box = canvas.getBoundingClientRect();
    const along = (axis, start) => start + (zoom.zoom * ([x, y][axis] + 0.5) + zoom.pan[axis]) / devicePixelRatio;
    return [along(0, box.left), along(1, box.top)];
}

theme(find("theme"), redraw);
panel.open();
keys.listen(table({ controls, wipe, zoom, look, redraw, focus, dialog: find("keys") }), find("keys"));
listenToPointer(canvas, { zoom, look, redraw, hover, focus, armed: () => controls.armed });
// Who clicks a button goes on with the picture
find("bar").addEventListener("click", ({ detail, target }) => {
    if (detail > 0 && target.closest("button")) {
        canvas.focus({ preventScroll: true });
    }
});
new ResizeObserver(redraw).observe(canvas);
choose();

window.dapple = {
    get state() { return state; },
    get shown() { return sides.now?.head ?? null; },
    get before() { return sides.before?.head ?? null; },
    get idle() { return socket.open && asker.idle && !scheduled && !look.waits; },
    pixel: (x, y, which) => sides.pixel(x, y, which),
    place,
};
