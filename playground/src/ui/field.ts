// Fields of a form: a label, what can be entered, and a line that says what it is.

import { el } from "./dom";

export interface NumberField {
  label: string;
  description: string;
  value: number;
  min: number;
  max: number;
  integer: boolean;
  /** Called when a value has been chosen; it is within its range. */
  change(value: number): void;
}

/** More steps than this cannot be told apart on a slider. */
const MOST_STEPS = 100_000;

/** Of the whole page: fields are made anew with each scene, and the focus returns to the one that had it. */
const idOf = (label: string) => `field-${label.replaceAll(/[^a-z0-9]+/gi, "-")}`;

/** A number, with a slider where its range allows for one. */
export function numberField(field: NumberField): HTMLElement {
  const { min, max, integer } = field;
  const id = idOf(field.label);
  const step = integer ? "1" : "any";
  const common = { min: String(min), max: String(max), value: String(rounded(field.value)) };
  const number = el("input", { id, type: "number", step, ...common });
  const fits = !integer || max - min <= MOST_STEPS;
  const slider = fits
    ? el("input", { id: `${id}-slider`, type: "range", ...common, step: integer ? "1" : String((max - min) / 200), attributes: { "aria-label": field.label } })
    : undefined;
  const choose = (text: string) => {
    const value = Math.min(max, Math.max(min, integer ? Math.round(Number(text)) : Number(text)));
    if (text.trim() === "" || !Number.isFinite(value)) return;
    number.value = String(rounded(value));
    if (slider) slider.value = number.value;
    field.change(value);
  };
  number.addEventListener("change", () => choose(number.value));
  slider?.addEventListener("input", () => (number.value = String(rounded(Number(slider.value)))));
  slider?.addEventListener("change", () => choose(slider.value));
  return frame(id, field.label, field.description, el("span", { className: "entry" }, slider, number));
}

/** A choice between a few words. */
export function choiceField<T extends string>(
  label: string,
  description: string,
  options: readonly T[],
  value: T,
  change: (value: T) => void,
): HTMLElement {
  const id = idOf(label);
  const select = el("select", { id }, ...options.map((option) => el("option", { value: option }, option)));
  select.value = value;
  select.addEventListener("change", () => change(select.value as T));
  return frame(id, label, description, select);
}

function frame(id: string, label: string, description: string, entry: HTMLElement): HTMLElement {
  return el(
    "div",
    { className: "field", title: description },
    el("label", { htmlFor: id }, label.replaceAll("_", " ")),
    entry,
    el("small", {}, description),
  );
}

function rounded(value: number): number {
  return Number(value.toPrecision(6));
}
