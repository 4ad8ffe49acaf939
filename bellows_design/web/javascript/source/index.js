/*
 * Bellows: what pages of bellows-design show and move.
 *
 *   Bellows.unpack(buffer)          → Promise of a scene (packed by bellows_design.web.packing)
 *   new Bellows.Viewer(element, options)
 *     .show(scene, {keepView})      .setFrame(t)            .play(on)
 *     .setField(name | null, {low, high, limit, map})
 *     .setSection({axis, offset_mm, on, flip})              .setVisible(name, bool)
 *     .setColour(name, "#rrggbb")   .resetView(view)        .picture()   .state()   .dispose()
 *     events: "shown", "frame", "field", "section", "visible", "view", "playing"
 *   Bellows.unpackLayers(buffer)    → Promise of layers (packed by bellows_design.web.layers)
 *   new Bellows.Layers(element, options)
 *     .show(layers, {layer})        .setLayer(number)       .goTo(mark)  .resetView()  .state()
 *     events: "layer", "view"
 *   Bellows.start()                 → starts all <div class="bellows-view"> of the page when they
 *                                     come near the screen; Bellows.startAll() at once
 *   Bellows.of(element)             → the viewer that was started in an element
 */

export { Layers } from "./layers.js";
export { unpackLayers } from "./print.js";
export { unpack, bytesOfBase64 } from "./unpack.js";
export { Viewer } from "./viewer.js";
export { of, start, startAll } from "./start.js";
