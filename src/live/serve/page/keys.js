// The keys, and the list of them.

import { GESTURES } from "./pointer.js";

/**
 * Listens for keys. `keys`: a list of { keys: names as in KeyboardEvent, with "shift+" in front where that tells two apart;
 * shown: how the list has them; text; run }.
 */
export function listen(keys, dialog) {
    const runs = new Map(keys.flatMap((entry) => entry.keys.map((key) => [key, entry.run])));
    window.addEventListener("keydown", (event) => {
        const { target } = event;
        if (event.ctrlKey || event.metaKey || event.altKey || dialog.open || target instanceof HTMLSelectElement) {
            return;
        }
        // Sliders have their own use for these
        const taken = target.matches("input, [role=slider]") && /^(Arrow|Page|Home|End)/.test(event.key);
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        const run = runs.get(event.shiftKey ? `shift+${key}` : key) ?? runs.get(key);
        if (run && !taken && (key !== "Enter" || target.id === "picture")) {
            event.preventDefault();
            run();
        }
    });
    const body = dialog.querySelector("tbody");
    const rows = [...keys.filter((entry) => entry.text).map((entry) => [entry.shown, entry.text]), ...GESTURES];
    for (const [shown, text] of rows) {
        const row = body.insertRow();
        row.insertCell().textContent = shown;
        row.insertCell().textContent = text;
    }
}
