// Puts the page together.

import { byId, setText } from "./parts/elements.js";
import { Connection, sessionAddress } from "./model/connection.js";
import { Session } from "./model/session.js";
import { Sliders } from "./parameters/sliders.js";
import { Figures } from "./results/figures.js";
import { Lights } from "./results/lights.js";
import { Compare } from "./results/compare.js";
import { Scenes } from "./results/scenes.js";
import { View } from "./stage/view.js";
import { ViewControls } from "./stage/view_controls.js";
import { Banner } from "./actions/banner.js";
import { bindDialogs } from "./actions/dialogs.js";
import { Exporting } from "./actions/exporting.js";
import { Opening } from "./actions/opening.js";
import { Saving } from "./actions/saving.js";
import { bindShortcuts } from "./actions/shortcuts.js";
import { bindTabs } from "./actions/tabs.js";
import { Theme } from "./actions/theme.js";
import { Toolbar } from "./actions/toolbar.js";

// Frames have a slider of their own, which knows the pressure.
const VIEWER = {
  height: null,
  label: "The actuator",
  controls: ["fields", "section", "surfaces", "reset", "picture"],
};

const connection = new Connection(sessionAddress(location));
const session = new Session(connection);

new Theme();
new Banner(session);
new Toolbar(session);
new Sliders(byId("sliders"), session);
const figures = new Figures(byId("figures"), session);
new Lights(byId("printable"), session);
new Scenes(session);
new Exporting(session);
const saving = new Saving(session);
const opening = new Opening(session);
const showTab = bindTabs(byId("tabs"));
bindDialogs();
byId("show-help").addEventListener("click", () => byId("help-dialog").showModal());

const view = newView();
const controls = view && new ViewControls(view, session);
const compare = view && new Compare(session, view, figures);

bindShortcuts([
  { keys: ["Ctrl+Z"], what: "undo", act: () => session.undo() },
  { keys: ["Ctrl+Y", "Ctrl+Shift+Z"], what: "redo", act: () => session.redo() },
  { keys: ["Ctrl+S"], what: "save as TOML", act: () => saving.save() },
  { keys: ["Ctrl+O"], what: "open a design", act: () => opening.show() },
  { keys: ["P"], what: "pin this design, to compare", act: () => compare?.pin() },
  { keys: ["D"], what: "as printed, or under pressure", act: () => controls?.toggleMode() },
  { keys: ["S"], what: "section on or off", act: () => view?.toggleSection() },
  { keys: ["R"], what: "the whole view", act: () => view?.resetView() },
  { keys: ["1"], what: "the shape", act: () => showTab(0) },
  { keys: ["2"], what: "the forces", act: () => showTab(1) },
  { keys: ["?"], what: "this list", act: () => byId("help-dialog").showModal() },
]);

// A page that is loaded anew begins with the design of the command: changes are not lost unasked.
addEventListener("beforeunload", (event) => session.isChanged && event.preventDefault());

connection.start();

/** The 3D view, or null where the browser has no WebGL 2; all else works without. */
function newView() {
  const note = byId("view-note");
  try {
    const viewer = new globalThis.Bellows.Viewer(byId("canvas"), VIEWER);
    return new View(byId("stage-view"), session, {
      viewer,
      unpack: globalThis.Bellows.unpack,
      note,
    });
  } catch (error) {
    setText(note, `There is no 3D view here: ${error.message}`);
    return null;
  }
}
