// A line chart of the last seconds.

import { el } from "./dom";

/** Points kept: about ten seconds. */
const LENGTH = 600;

export interface Line {
  name: string;
  /** A colour of the style sheet, such as `--line-1`. */
  color: string;
}

export class Chart {
  readonly element: HTMLElement;
  private readonly canvas: HTMLCanvasElement;
  private readonly values: HTMLElement[];
  private readonly lines: readonly Line[];
  private readonly unit: string;
  private points: number[][] = [];

  constructor(title: string, unit: string, lines: readonly Line[]) {
    this.lines = lines;
    this.unit = unit;
    this.canvas = el("canvas", { attributes: { role: "img", "aria-label": `${title} over the last seconds` } });
    this.values = lines.map(() => el("output"));
    const legend = lines.map((line, index) => {
      const mark = el("i");
      mark.style.background = `var(${line.color})`;
      return el("li", {}, mark, line.name, this.values[index]);
    });
    this.element = el("figure", { className: "chart" }, el("figcaption", {}, `${title}, ${unit}`), this.canvas, el("ul", {}, ...legend));
  }

  add(values: number[]): void {
    this.points.push(values);
    if (this.points.length > LENGTH) this.points.shift();
  }

  clear(): void {
    this.points = [];
  }

  draw(): void {
    const { canvas } = this;
    const scale = Math.min(devicePixelRatio, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0) return;
    canvas.width = width * scale;
    canvas.height = height * scale;
    const context = canvas.getContext("2d");
    if (!context) return;
    context.scale(scale, scale);
    const style = getComputedStyle(canvas);
    const most = niceAbove(this.points.reduce((most, point) => Math.max(most, ...point), 1e-9));
    const least = Math.min(0, -niceAbove(this.points.reduce((most, point) => Math.max(most, ...point.map((value) => -value)), 0)));
    const y = (value: number) => 4 + (height - 8) * (1 - (value - least) / (most - least));
    this.drawAxis(context, style, width, y, most);
    this.lines.forEach((line, index) => {
      context.strokeStyle = style.getPropertyValue(line.color);
      context.lineWidth = 1.5;
      context.beginPath();
      this.points.forEach((point, at) => context.lineTo((at / (LENGTH - 1)) * width, y(point[index] ?? 0)));
      context.stroke();
      const last = this.points.at(-1)?.[index];
      this.values[index]!.textContent = last === undefined ? "–" : format(last);
    });
  }

  private drawAxis(
    context: CanvasRenderingContext2D,
    style: CSSStyleDeclaration,
    width: number,
    y: (value: number) => number,
    most: number,
  ): void {
    context.strokeStyle = style.getPropertyValue("--rule");
    context.fillStyle = style.getPropertyValue("--quiet");
    context.font = "11px system-ui, sans-serif";
    for (const value of [0, most]) {
      context.beginPath();
      context.moveTo(0, y(value));
      context.lineTo(width, y(value));
      context.stroke();
    }
    context.fillText(`${format(most)} ${this.unit}`, 4, y(most) + 13);
  }
}

/** 1, 2 or 5 times a power of ten. */
function niceAbove(value: number): number {
  if (value <= 0) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= value) ?? value;
}

function format(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size >= 1e5 || size < 1e-3) return value.toExponential(1);
  return Number(value.toPrecision(3)).toString();
}
