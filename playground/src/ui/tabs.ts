// Panels behind tabs; arrow keys lead from one tab to the next.

import { el } from "./dom";

export interface Tab {
  name: string;
  label: string;
  panel: HTMLElement;
  /** Called when it is chosen. */
  shown?(): void;
}

export function tabs(list: readonly Tab[], changed: (name: string) => void): { bar: HTMLElement; show(name: string): void } {
  const buttons = list.map(({ name, label, panel }) => {
    panel.id = `panel-${name}`;
    panel.setAttribute("role", "tabpanel");
    panel.setAttribute("aria-labelledby", `tab-${name}`);
    return el(
      "button",
      { id: `tab-${name}`, type: "button", onclick: () => show(name), attributes: { role: "tab", "aria-controls": panel.id } },
      label,
    );
  });
  const show = (name: string) => {
    list.forEach((tab, index) => {
      const selected = tab.name === name;
      const button = buttons[index]!;
      button.setAttribute("aria-selected", String(selected));
      button.tabIndex = selected ? 0 : -1;
      tab.panel.classList.toggle("shown", selected);
      if (selected) tab.shown?.();
    });
    changed(name);
  };
  const bar = el("div", { className: "tabs", attributes: { role: "tablist" } }, ...buttons);
  bar.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (move === undefined) return;
    const visible = buttons.filter((button) => button.offsetParent !== null);
    const at = visible.findIndex((button) => button === document.activeElement);
    const next = visible[(at + move + visible.length) % visible.length];
    next?.focus();
    next?.click();
  });
  return { bar, show };
}
