// Light, dark, or as the system has it.

import { byId, setText } from "../parts/elements.js";

const KEY = "bellows-theme";
const NEXT = { auto: "light", light: "dark", dark: "auto" };
const WORDS = { auto: "as the system", light: "light", dark: "dark" };

export class Theme {
  constructor() {
    byId("theme").addEventListener("click", () => this.#set(NEXT[this.#current()]));
    this.#set(this.#current());
  }

  #current() {
    const kept = localStorage.getItem(KEY);
    return kept in NEXT ? kept : "auto";
  }

  #set(theme) {
    localStorage.setItem(KEY, theme);
    if (theme === "auto") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    setText(byId("theme-name"), WORDS[theme]);
    byId("theme").setAttribute("aria-label", `Colours: ${WORDS[theme]}`);
    byId("theme").dataset.theme = theme;
  }
}
