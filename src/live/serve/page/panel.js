// The line at the bottom and the details above it: what is rendered, how fast, and the pixel under the pointer.

import { element, many, number, seconds, vector } from "./text.js";

const find = (id) => document.getElementById(id);
let written = "";

/** Listens to the button of the details. */
export function open() {
    const [more, details] = [find("more"), find("details")];
    more.addEventListener("click", () => {
        details.hidden = !details.hidden;
        more.setAttribute("aria-expanded", String(!details.hidden));
    });
}

/** Shows the values of a pixel; null = no pixel. */
export function probe(values) {
    const line = find("probe");
    if (!values) {
        line.replaceChildren();
        return;
    }
    const { x, y, rgb, alpha, albedo, normal, depth, samples, object, material } = values;
    const parts = [
        ["x y", `${x} ${y}`], ["rgb", vector(rgb)], ["alpha", number(alpha)], ["albedo", vector(albedo)],
        ["normal", vector(normal)], ["depth", number(depth)], ["samples", String(samples)],
        ...(object === null ? [] : [["object", object]]), ...(material === null ? [] : [["material", material]]),
    ];
    line.replaceChildren(...parts.map(([name, text]) => element("span", "", element("b", "", `${name} `), text)));
    line.title = parts.map(([name, text]) => `${name} ${text}`).join("\n");
}

/** Shows the state; `transfer`: { shown (head of the picture or null), rate (bytes/s or null), online }. */
export function numbers(state, transfer) {
    // Texts that are built again cannot be selected
    const now = JSON.stringify([state, transfer]);
    if (now === written) {
        return;
    }
    written = now;
    const line = find("numbers");
    const parts = [];
    if (!transfer.online) {
        parts.push(element("span", "bad", "not connected"));
    }
    if (state) {
        if (state.error) {
            parts.push(element("span", "bad", "error in the scene"));
        }
        const words = state.generation === 0 ? ["no picture yet"] : [
            `${state.spp} of ${state.wanted_spp} samples a pixel`,
            `${many(state.rate)} samples/s`,
            `generation ${state.generation}`,
            ...(state.latency === null ? [] : [`${seconds(state.latency)} from edit to pixels`]),
        ];
        parts.push(...words, state.device);
        detail(state, transfer);
    }
    line.replaceChildren(...parts.flatMap((part, i) => (i === 0 ? [part] : [element("b", "", "  ·  "), part])));
    line.title = line.textContent;
}

/** The links to files of the picture, if there is one; `query` is what URLs need. */
export function links(there, query) {
    for (const name of ["png", "exr"]) {
        const link = find(name);
        link.setAttribute("aria-disabled", String(!there));
        there ? link.setAttribute("href", `picture.${name}${query}`) : link.removeAttribute("href");
    }
}

function detail(state, { shown, rate: bytes }) {
    const times = state.times ?? {};
    const rows = [
        ["device", state.device],
        ["generation", String(state.generation)],
        ["attempts", String(state.attempts)],
        ["picture", `${state.size.join(" × ")} pixels`],
        ["samples a pixel", `${state.spp} of ${state.wanted_spp}`],
        ["samples a second", many(state.rate)],
        ["edit to first pixels", seconds(state.latency)],
        ["read", seconds(times.read), "part"],
        ["prepare", seconds(times.prepare), "part"],
        ["compile", seconds(times.compile), "part"],
        ["of which the driver", seconds(times.driver), "part"],
        ["upload", seconds(times.upload), "part"],
        ["sent at", shown ? (shown.scale === 1 ? "full size" : `1 / ${shown.scale} of the size`) : "–"],
        ["transfer", bytes === null ? "–" : `${many(bytes)}B/s`],
    ];
    find("details").replaceChildren(...rows.flatMap(([name, text, part]) => [
        element("dt", part, name),
        element("dd", "", text),
    ]));
}
