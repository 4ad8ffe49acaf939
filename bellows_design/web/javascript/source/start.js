/* Viewers that stand in a page with their data beside them. */

import { Layers } from "./layers.js";
import { unpackLayers } from "./print.js";
import { bytesOfBase64, unpack } from "./unpack.js";
import { Viewer } from "./viewer.js";

const NEAR = "300px";
let watcher = null;

const KINDS = {
  scene: async (host, options, bytes) => {
    const viewer = new Viewer(host, options);
    viewer.show(await unpack(bytes));
    if (options.field) viewer.setField(options.field);
    if (options.frame !== undefined) viewer.setFrame(options.frame);
    if (options.section) viewer.setSection({ on: true, ...options.section });
    return viewer;
  },
  layers: async (host, options, bytes) => {
    const view = new Layers(host, options);
    view.show(await unpackLayers(bytes), { layer: options.layer });
    return view;
  },
};

/** The viewer in `host`, once it was started; a promise. */
export function of(host) {
  return host.bellowsView;
}

function begin(host) {
  if (host.bellowsView) return host.bellowsView; // also where another copy of this script began it
  const data = host.querySelector("script[type='application/octet-stream+base64']");
  const options = JSON.parse(host.dataset.options || "{}");
  const made = KINDS[host.dataset.kind || "scene"](host, options, bytesOfBase64(data.textContent));
  const ready = made.then((viewer) => {
    host.dataset.ready = "true";
    return viewer;
  });
  host.bellowsView = ready;
  ready.catch((error) => {
    const text = document.createElement("p");
    text.setAttribute("role", "alert");
    text.textContent = `This view cannot be shown: ${error.message}`;
    host.after(text);
  });
  return ready;
}

function hosts(root) {
  return [...root.querySelectorAll(".bellows-view")].filter((host) => !host.bellowsView);
}

/** Start the views below `root` as they come near the screen. */
export function start(root = document) {
  if (typeof IntersectionObserver === "undefined") return startAll(root);
  watcher ??= new IntersectionObserver(
    (entries) => entries.filter((entry) => entry.isIntersecting).forEach(({ target }) => {
      watcher.unobserve(target);
      begin(target);
    }),
    { rootMargin: NEAR },
  );
  hosts(root).forEach((host) => watcher.observe(host));
  return undefined;
}

/** Start all views below `root` at once, as for printing; resolves when all are shown. */
export function startAll(root = document) {
  hosts(root).forEach(begin);
  return Promise.all([...root.querySelectorAll(".bellows-view")].map(of));
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => start());
else queueMicrotask(() => start());
