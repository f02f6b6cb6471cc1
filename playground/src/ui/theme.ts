// Light or dark: as the system has it, until somebody chooses.

import type { Playground } from "../app/playground";
import type { Theme } from "../stage/palette";

const KEY = "tautline-theme";

/** The theme to begin with. */
export function initialTheme(): Theme {
  const chosen = stored();
  const theme = chosen ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  document.documentElement.dataset.theme = theme;
  return theme;
}

export function toggleTheme(playground: Playground): void {
  const theme = playground.stage.theme === "dark" ? "light" : "dark";
  document.documentElement.dataset.theme = theme;
  playground.setTheme(theme);
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Nothing may be kept here: then it is for this visit.
  }
}

function stored(): Theme | undefined {
  try {
    const value = localStorage.getItem(KEY);
    return value === "light" || value === "dark" ? value : undefined;
  } catch {
    return undefined;
  }
}
