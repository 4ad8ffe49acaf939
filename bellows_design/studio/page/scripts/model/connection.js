// The connection with the studio: text and binary messages, and coming back after it was lost.

const SHORTEST_WAIT_MS = 300;
const LONGEST_WAIT_MS = 5000;
const LENGTH_BYTES = 4;

/**
 * Events: `lost` with detail `{failures, code, reason}`, the last two as the studio gave them;
 * `message` with detail `{header, payload}`, where payload is an ArrayBuffer or null.
 */
export class Connection extends EventTarget {
  #address;
  #socket = null;
  #failures = 0;
  #timer = 0;

  constructor(address) {
    super();
    this.#address = address;
  }

  get isOpen() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Connects, now and whenever the connection is lost. */
  start() {
    clearTimeout(this.#timer);
    const socket = new WebSocket(this.#address);
    socket.binaryType = "arraybuffer";
    socket.addEventListener("message", (event) => this.#received(event.data));
    socket.addEventListener("close", (event) => this.#closed(socket, event));
    this.#socket = socket;
  }

  /** Sends a message; says whether there was a connection to send it by. */
  send(message) {
    if (!this.isOpen) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  #received(data) {
    this.#failures = 0; // not when it opens: a studio that turns pages away does so then
    const detail =
      typeof data === "string" ? { header: JSON.parse(data), payload: null } : split(data);
    this.dispatchEvent(new CustomEvent("message", { detail }));
  }

  #closed(socket, { code, reason }) {
    if (socket !== this.#socket) return;
    const wait = Math.min(LONGEST_WAIT_MS, SHORTEST_WAIT_MS * 2 ** this.#failures);
    this.#failures += 1;
    this.#timer = setTimeout(() => this.start(), wait);
    const detail = { failures: this.#failures, code, reason };
    this.dispatchEvent(new CustomEvent("lost", { detail }));
  }
}

/** Header and payload of a binary message: uint32 length, JSON, payload. */
export function split(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, LENGTH_BYTES, length));
  return { header: JSON.parse(text), payload: buffer.slice(LENGTH_BYTES + length) };
}

/** Address of the session on the server that sent the page. */
export function sessionAddress(location) {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  return `${scheme}//${location.host}/session${location.search}`;
}
