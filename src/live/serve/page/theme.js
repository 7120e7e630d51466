// Light or dark: as the system, until somebody chooses.

const KEY = "dapple.theme";
const dark = matchMedia("(prefers-color-scheme: dark)");

/** Calls `changed` when the colours are others. */
export function theme(button, changed) {
    const root = document.documentElement;
    const kept = read();
    if (kept) {
        root.dataset.theme = kept;
    }
    button.addEventListener("click", () => {
        const now = root.dataset.theme ?? (dark.matches ? "dark" : "light");
        root.dataset.theme = now === "dark" ? "light" : "dark";
        keep(root.dataset.theme);
        changed();
    });
    dark.addEventListener("change", changed);
}

function read() {
    try {
        return localStorage.getItem(KEY);
    } catch {
        return null;
    }
}

function keep(value) {
    try {
        localStorage.setItem(KEY, value);
    } catch {
        // A browser that keeps nothing asks again
    }
}
