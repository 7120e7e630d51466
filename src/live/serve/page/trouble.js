// What is wrong: the error of the last edit, warnings, and short notices.

import { element } from "./text.js";

const find = (id) => document.getElementById(id);
/** How long a notice stays, in milliseconds. */
const NOTICE = 4000;

let shown = "";
let hiddenError = "";
let noticeTimer = null;

/** Shows the error and the warnings of a state. */
export function show(state) {
    // A list that is built again loses focus, selection and scroll
    const now = JSON.stringify([state.error, state.warnings]);
    if (now !== shown) {
        shown = now;
        warnings(state.warnings);
        error(state.error);
    }
}

/** Says something for a while; "" = nothing more. */
export function notice(text) {
    const line = find("notice");
    clearTimeout(noticeTimer);
    line.textContent = text;
    line.hidden = text === "";
    noticeTimer = setTimeout(() => notice(""), NOTICE);
}

/** Whether nobody answers. */
export function offline(is) {
    find("offline").hidden = !is;
}

function warnings(list) {
    const panel = find("warnings");
    panel.hidden = list.length === 0;
    panel.querySelector("summary").textContent = list.length === 1 ? "1 warning" : `${list.length} warnings`;
    panel.querySelector("ul").replaceChildren(...list.map(({ place, message }) => (
        element("li", "", element("span", "place", place), place ? ": " : "", message)
    )));
}

function error(wrong) {
    const panel = find("error");
    const text = JSON.stringify(wrong);
    panel.hidden = wrong === null || text === hiddenError;
    if (wrong === null) {
        hiddenError = "";
        panel.replaceChildren();
        return;
    }
    const hide = element("button", "", "Hide");
    hide.addEventListener("click", () => {
        hiddenError = text;
        panel.hidden = true;
    });
    const head = element("header", "", element("h2", "", wrong.message), hide);
    const parts = [head];
    if (wrong.file) {
        parts.push(element("p", "place", placeOf(wrong)));
    }
    if (wrong.help) {
        parts.push(element("p", "help", wrong.help));
    }
    if (wrong.excerpt.length > 0) {
        parts.push(excerpt(wrong));
    }
    panel.replaceChildren(...parts);
}

function placeOf({ file, line, column }) {
    return [file, line, column].filter((part) => part !== 0).join(":");
}

/** The lines around, the one that is meant marked, with a caret under the column. */
function excerpt({ line, column, excerpt: lines }) {
    const digits = String(lines.at(-1)[0]).length;
    const row = (className, gutter, text) => (
        element("span", className, element("span", "gutter", `${gutter} │ `), text)
    );
    return element("pre", "", ...lines.flatMap(([number, text]) => {
        if (number !== line) {
            return [row("line", `  ${String(number).padStart(digits)}`, text)];
        }
        const marked = row("line marked", `▸ ${String(number).padStart(digits)}`, text);
        if (column === 0) {
            return [marked];
        }
        // Tabs stay, so that the caret is below its letter
        const before = Array.from(text).slice(0, column - 1).join("").replace(/[^\t]/gu, " ");
        return [marked, row("line caret", " ".repeat(digits + 2), `${before}^`)];
    }));
}
