// Binary messages: a head in JSON, and planes of numbers, taken apart by their bytes and deflated.

/** The head of a message, and where the planes begin. */
function open(message) {
    const length = new DataView(message).getUint32(0, true);
    return [JSON.parse(new TextDecoder().decode(new Uint8Array(message, 4, length))), 4 + length];
}

/** What a message says of its picture. */
export function headOf(message) {
    return open(message)[0];
}

/** The head of a message and its planes: halves as the bits that they are, or 32-bit floats; row by row from the top. */
export async function decode(message) {
    const [head, start] = open(message);
    const packed = new Blob([new Uint8Array(message, start)]);
    const unpacked = packed.stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(unpacked).arrayBuffer());
    const pixels = head.width * head.height;
    if (bytes.length !== pixels * head.channels * head.bytes) {
        throw new Error(`a picture of ${bytes.length} bytes where ${pixels * head.channels * head.bytes} are right`);
    }
    const planes = [];
    for (let channel = 0; channel < head.channels; channel++) {
        const at = channel * pixels * head.bytes;
        planes.push(joined(bytes.subarray(at, at + pixels * head.bytes), pixels, head.bytes));
    }
    return { head, planes };
}

/** Numbers of which all lowest bytes come first, then the next ones. */
function joined(bytes, count, size) {
    if (size === 2) {
        const halves = new Uint16Array(count);
        for (let i = 0; i < count; i++) {
            halves[i] = bytes[i] | (bytes[count + i] << 8);
        }
        return halves;
    }
    const words = new Uint32Array(count);
    for (let i = 0; i < count; i++) {
        words[i] = bytes[i] | (bytes[count + i] << 8) | (bytes[2 * count + i] << 16) | (bytes[3 * count + i] << 24);
    }
    return new Float32Array(words.buffer);
}

/** The number that 16 bits are. */
export function half(bits) {
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 1023;
    if (exponent === 0) {
        return sign * fraction * 2 ** -24;
    }
    if (exponent === 31) {
        return fraction ? NaN : sign * Infinity;
    }
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** Red, green and blue at a texel; a plane alone counts three times. */
export function texel({ head, planes }, column, row) {
    const i = row * head.width + column;
    const value = (plane) => (head.bytes === 2 ? half(plane[i]) : plane[i]);
    return [0, 1, 2].map((channel) => value(planes[Math.min(channel, planes.length - 1)]));
}

/** The least and the largest finite number of the first plane, of floats. */
export function range({ planes }) {
    let [least, largest] = [Infinity, -Infinity];
    for (const value of planes[0]) {
        if (Number.isFinite(value)) {
            least = Math.min(least, value);
            largest = Math.max(largest, value);
        }
    }
    return least <= largest ? [least, largest] : [0, 1];
}
