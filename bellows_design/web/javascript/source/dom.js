/* Elements of a page, made without markup: no text is read as HTML. */

const SVG = "http://www.w3.org/2000/svg";

/** An element with attributes, properties that begin with "on", and children or text. */
export function element(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

export function svgElement(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

function filled(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/** Shadow root of `host` with the given style; the page's own style does not reach into it. */
export function shadowOf(host, css) {
  const root = host.shadowRoot || host.attachShadow({ mode: "open" });
  root.replaceChildren();
  try {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
    root.adoptedStyleSheets = [sheet];
  } catch {
    root.append(element("style", {}, css));
  }
  return root;
}

export function reducedMotion() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** "dark" or "light" where the page chose one (its own, Furo's and Jupyter's attributes); else "". */
function chosenTheme() {
  for (const { dataset } of [document.documentElement, document.body]) {
    if (dataset.theme === "dark" || dataset.theme === "light") return dataset.theme;
    if (dataset.jpThemeLight) return dataset.jpThemeLight === "true" ? "light" : "dark";
  }
  return "";
}

/** Give `host` the theme that the page chose. */
function takeTheme(host) {
  const theme = chosenTheme();
  if (theme) host.dataset.theme = theme;
  else delete host.dataset.theme;
}

/** Keep the theme of `host` that of the page and call `told` when it changes. Returns what ends that. */
export function onThemeChange(host, told) {
  const changed = () => {
    takeTheme(host);
    told();
  };
  takeTheme(host);
  const query = matchMedia("(prefers-color-scheme: dark)");
  const observer = new MutationObserver(changed);
  const attributeFilter = ["data-theme", "data-jp-theme-light", "class", "style"];
  for (const watched of [document.documentElement, document.body]) observer.observe(watched, { attributeFilter });
  query.addEventListener("change", changed);
  return () => {
    observer.disconnect();
    query.removeEventListener("change", changed);
  };
}
