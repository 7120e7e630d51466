// Draws pictures on the canvas, with WebGL 2.

import { AOVS, CURVES, FRAGMENT, VERTEX } from "./shade.js";

const SIDES = ["now", "before"];

export class View {
    #canvas;
    #gl;
    #program = null;
    #places = new Map();
    #textures = {};
    #frames = { now: null, before: null };

    /** `lost` is called when all has to be drawn again. Throws where the browser cannot do it. */
    constructor(canvas, lost) {
        this.#canvas = canvas;
        this.#gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false });
        if (!this.#gl) {
            throw new Error("this browser has no WebGL 2, or it is turned off");
        }
        canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
        canvas.addEventListener("webglcontextrestored", () => {
            this.#build();
            SIDES.forEach((which) => this.#frames[which] && this.#upload(which));
            lost();
        });
        this.#build();
    }

    /** Pixels of the longest side of a picture that can be drawn. */
    get longest() {
        return this.#gl.getParameter(this.#gl.MAX_TEXTURE_SIZE);
    }

    /** Takes a decoded picture of one side. */
    set(which, frame) {
        this.#frames[which] = frame;
        this.#upload(which);
    }

    /**
     * Draws both sides. `sides`: for "now" and "before" { window: [x0, y0, x1, y1], size, gain, curve } or null; `look`: { zoom, pan,
     * aov, range, wipe (pixels from the left, or null), around ([r, g, b]) }.
     */
    draw(sides, look) {
        const gl = this.#gl;
        if (gl.isContextLost()) {
            return;
        }
        gl.viewport(0, 0, this.#canvas.width, this.#canvas.height);
        SIDES.forEach((which, i) => this.#side(`u_side[${i}]`, sides[which], this.#frames[which], sides.now));
        gl.uniform1i(this.#at("u_aov"), AOVS.indexOf(look.aov));
        gl.uniform2f(this.#at("u_range"), ...look.range);
        gl.uniform3f(this.#at("u_place"), ...look.pan, look.zoom);
        gl.uniform1f(this.#at("u_height"), this.#canvas.height);
        gl.uniform1f(this.#at("u_wipe"), look.wipe ?? -1);
        gl.uniform3f(this.#at("u_around"), ...look.around);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    #side(name, side, frame, now) {
        const gl = this.#gl;
        gl.uniform1i(this.#at(`${name}.there`), side && frame ? 1 : 0);
        if (!side || !frame) {
            return;
        }
        const [x0, y0, x1, y1] = side.window;
        gl.uniform4f(this.#at(`${name}.window`), x0, y0, x1 - x0, y1 - y0);
        gl.uniform2f(this.#at(`${name}.size`), ...side.size);
        // A picture of another size is as large on the screen
        gl.uniform2f(this.#at(`${name}.stretch`), side.size[0] / now.size[0], side.size[1] / now.size[1]);
        gl.uniform1f(this.#at(`${name}.texel`), frame.head.scale);
        gl.uniform1f(this.#at(`${name}.gain`), side.gain);
        gl.uniform1i(this.#at(`${name}.curve`), CURVES.indexOf(side.curve));
    }

    #at(name) {
        if (!this.#places.has(name)) {
            this.#places.set(name, this.#gl.getUniformLocation(this.#program, name));
        }
        return this.#places.get(name);
    }

    #build() {
        const gl = this.#gl;
        this.#places.clear();
        this.#textures = {};
        this.#program = gl.createProgram();
        for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(this.#program, shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
                throw new Error(gl.getShaderInfoLog(shader));
            }
        }
        gl.linkProgram(this.#program);
        gl.useProgram(this.#program);
        SIDES.forEach((which, unit) => gl.uniform1i(this.#at(`u_${which}`), unit));
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    }

    /** A plane is a layer. */
    #upload(which) {
        const gl = this.#gl;
        const { head, planes } = this.#frames[which];
        const [format, type] = head.bytes === 2 ? [gl.R16F, gl.HALF_FLOAT] : [gl.R32F, gl.FLOAT];
        const shape = [format, head.width, head.height, planes.length];
        gl.activeTexture(gl.TEXTURE0 + SIDES.indexOf(which));
        if (this.#textures[which]?.shape.join() !== shape.join()) {
            gl.deleteTexture(this.#textures[which]?.texture ?? null);
            const texture = gl.createTexture();
            gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
            gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, ...shape);
            gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
            gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
            this.#textures[which] = { texture, shape };
        }
        planes.forEach((plane, layer) => {
            gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, layer, head.width, head.height, 1, gl.RED, type, plane);
        });
    }
}
