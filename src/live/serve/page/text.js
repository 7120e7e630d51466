// Numbers as people read them, and elements with text.

/** An element with a class and children; texts are texts, never markup. */
export function element(name, className, ...children) {
    const made = document.createElement(name);
    if (className) {
        made.className = className;
    }
    made.append(...children);
    return made;
}

/** Four digits that count. */
export function number(value) {
    if (value === null || !Number.isFinite(value)) {
        return "∞";
    }
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
        return value.toExponential(2);
    }
    return value.toFixed(size >= 1000 ? 1 : size >= 100 ? 2 : size >= 10 ? 3 : 4);
}

export function vector(values) {
    return values.map(number).join(" ");
}

/** Three digits that count, with k, M or G: a unit can follow. */
export function many(value) {
    const steps = [[1e9, "G"], [1e6, "M"], [1e3, "k"]];
    const [unit, name] = steps.find(([unit]) => value >= unit) ?? [1, ""];
    const scaled = value / unit;
    return `${scaled >= 100 || unit === 1 ? Math.round(scaled) : scaled.toPrecision(3)} ${name}`;
}

export function seconds(value) {
    if (value === null || value === undefined) {
        return "–";
    }
    return value < 0.9995 ? `${(value * 1000).toFixed(value < 0.01 ? 1 : 0)} ms` : `${value.toFixed(2)} s`;
}

/** Stops, with their sign. */
export function stops(value) {
    return `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(1)}`;
}
