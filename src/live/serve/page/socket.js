// The connection with the server: it comes back by itself, and says when it is gone.

const FIRST_WAIT = 250;
const LONGEST_WAIT = 5000;

/** The token in the URL of the page, as it must be in each other URL; empty where there is none. */
export function tokenQuery() {
    const token = new URLSearchParams(location.search).get("token");
    return token === null ? "" : `?token=${encodeURIComponent(token)}`;
}

/** Calls `on.text(object)`, `on.binary(buffer)`, `on.open()` and `on.closed(seconds to the next try)`. */
export class Socket {
    #on;
    #socket = null;
    #wait = FIRST_WAIT;
    #timer = null;

    constructor(on) {
        this.#on = on;
        // Somebody looks again, or the network is back: no reason to wait
        const soon = () => document.visibilityState === "visible" && this.#timer !== null && this.#connect();
        document.addEventListener("visibilitychange", soon);
        window.addEventListener("online", soon);
        this.#connect();
    }

    get open() {
        return this.#socket?.readyState === WebSocket.OPEN;
    }

    /** Sends an object; what cannot be sent is dropped, as all is asked for again after a reconnect. */
    send(message) {
        if (this.open) {
            this.#socket.send(JSON.stringify(message));
        }
    }

    #connect() {
        clearTimeout(this.#timer);
        this.#timer = null;
        const scheme = location.protocol === "https:" ? "wss:" : "ws:";
        const socket = new WebSocket(`${scheme}//${location.host}/socket${tokenQuery()}`);
        socket.binaryType = "arraybuffer";
        socket.onopen = () => {
            this.#wait = FIRST_WAIT;
            this.#on.open();
        };
        socket.onmessage = ({ data }) => {
            if (typeof data === "string") {
                this.#on.text(JSON.parse(data));
            } else {
                this.#on.binary(data);
            }
        };
        socket.onclose = () => this.#closed();
        this.#socket = socket;
    }

    #closed() {
        // Pages that lost the same server do not all come back at once
        const wait = this.#wait * (0.75 + 0.5 * Math.random());
        this.#wait = Math.min(2 * this.#wait, LONGEST_WAIT);
        this.#timer = setTimeout(() => this.#connect(), wait);
        this.#on.closed(wait / 1000);
    }
}
