// Where the picture is on the canvas, in pixels of the screen: a point p of the picture is at `zoom * p + pan`.

const LEAST = 1 / 32;
const MOST = 256;
const NEARLY_ONE = 1.1;
/** Pixels of the picture that stay on the canvas. */
const MARGIN = 40;

export class Zoom {
    zoom = 1;
    pan = [0, 0];
    #fits = true;
    #canvas = [1, 1];
    #size = [1, 1];

    /** The sizes of canvas and picture. The whole picture is shown until somebody zooms. */
    resize(canvas, size) {
        const same = this.#canvas.concat(this.#size).join() === canvas.concat(size).join();
        [this.#canvas, this.#size] = [canvas, size];
        if (!same) {
            this.#fits ? this.fit() : this.#keep();
        }
    }

    fit() {
        const fits = Math.min(this.#canvas[0] / this.#size[0], this.#canvas[1] / this.#size[1]);
        // A little more than 1 would double some rows and not others
        this.zoom = fits > 1 && fits < NEARLY_ONE ? 1 : fits;
        this.pan = [0, 1].map((axis) => (this.#canvas[axis] - this.zoom * this.#size[axis]) / 2);
        this.#fits = true;
    }

    /** Changes the zoom by a factor; the point at `center` stays. */
    by(factor, center = this.middle) {
        this.to(this.zoom * factor, center);
    }

    to(zoom, center = this.middle) {
        const bounded = Math.min(Math.max(zoom, LEAST), MOST);
        const factor = bounded / this.zoom;
        this.pan = [0, 1].map((axis) => center[axis] + factor * (this.pan[axis] - center[axis]));
        this.zoom = bounded;
        this.#fits = false;
        this.#keep();
    }

    move(x, y) {
        this.pan = [this.pan[0] + x, this.pan[1] + y];
        this.#fits = false;
        this.#keep();
    }

    /** Rows of the picture. */
    get height() {
        return this.#size[1];
    }

    get middle() {
        return this.#canvas.map((length) => length / 2);
    }

    /** The pixel of the picture at a point of the canvas; it may be outside of the picture. */
    pixel(point) {
        return [0, 1].map((axis) => Math.floor((point[axis] - this.pan[axis]) / this.zoom));
    }

    /** A picture that cannot be seen cannot be dragged back. */
    #keep() {
        this.pan = [0, 1].map((axis) => {
            const length = this.zoom * this.#size[axis];
            const margin = Math.min(MARGIN, length);
            return Math.min(Math.max(this.pan[axis], margin - length), this.#canvas[axis] - margin);
        });
    }
}
