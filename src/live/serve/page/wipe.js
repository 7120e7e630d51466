// The divider between the generation before and the one now.

const STEP = 0.02;

/** A divider that is dragged, or moved with the arrow keys; `changed` is called when it is elsewhere. */
export class Wipe {
    on = false;
    /** Part of the canvas that shows the generation before. */
    place = 0.5;
    #divider = document.getElementById("divider");
    #changed;

    constructor(changed) {
        this.#changed = changed;
        const divider = this.#divider;
        divider.addEventListener("pointerdown", (event) => {
            event.preventDefault();
            divider.focus();
            divider.setPointerCapture(event.pointerId);
        });
        divider.addEventListener("pointermove", (event) => {
            if (divider.hasPointerCapture(event.pointerId)) {
                const box = divider.parentElement.getBoundingClientRect();
                this.#move((event.clientX - box.left) / box.width);
            }
        });
        divider.addEventListener("keydown", (event) => {
            const to = {
                ArrowLeft: this.place - STEP, ArrowRight: this.place + STEP, Home: 0, End: 1,
            }[event.key];
            if (to !== undefined) {
                event.preventDefault();
                this.#move(to);
            }
        });
        this.#write();
    }

    toggle() {
        this.on = !this.on;
        this.#divider.hidden = !this.on;
        this.#changed();
    }

    /** Names the sides: heads of pictures, or null. */
    name(before, now) {
        const text = (head, else_) => (head ? `generation ${head.generation}` : else_);
        this.#divider.querySelector("#side-before").textContent = text(before, "no generation before");
        this.#divider.querySelector("#side-now").textContent = text(now, "now");
    }

    #move(to) {
        this.place = Math.min(Math.max(to, 0), 1);
        this.#write();
        this.#changed();
    }

    #write() {
        this.#divider.style.left = `${100 * this.place}%`;
        this.#divider.setAttribute("aria-valuenow", String(Math.round(100 * this.place)));
    }
}
