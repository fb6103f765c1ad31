// Lines over steps.
import { make, shown } from "./server.js";

const height = 110, right = 8, top = 10, bottom = 16;
const font = "11px system-ui, sans-serif";
const dashes = [[], [6, 3], [2, 3]];

export class Chart {
  // `onPick` is called with the x that was pointed at.
  constructor(title, onPick) {
    this.title = title;
    this.canvas = make("canvas");
    this.canvas.setAttribute("role", "img");
    this.key = make("p", { className: "key", textContent: title });
    this.root = make("div", { className: "chart" }, this.key, this.canvas);
    const pick = (event) => {
      const box = this.canvas.getBoundingClientRect();
      const part = (event.clientX - box.left - this.left) / (box.width - this.left - right);
      if (this.limits) onPick(this.limits.x[0] + part * (this.limits.x[1] - this.limits.x[0]));
    };
    if (!onPick) return;
    this.canvas.addEventListener("pointerdown", (event) => { this.canvas.setPointerCapture(event.pointerId); pick(event); });
    this.canvas.addEventListener("pointermove", (event) => event.buttons && pick(event));
  }

  // `lines`: [{name, color, points: [[x, y], ...], dash}], colours by the names of variables; a y that
  // is not finite is a gap. `at`: the x that is marked, or null.
  draw(lines, at = null, { xTitle = "", least = null, most = null } = {}) {
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(name).trim();
    const width = this.canvas.clientWidth || 300, ratio = devicePixelRatio || 1;
    this.canvas.width = width * ratio;
    this.canvas.height = height * ratio;
    const pen = this.canvas.getContext("2d");
    pen.scale(ratio, ratio);
    pen.font = font;
    const points = lines.flatMap((line) => line.points).filter(([, y]) => Number.isFinite(y));
    const x = limitsOf([...points.map(([value]) => value), ...(most === null ? [] : [least ?? 0, most])]);
    const y = limitsOf(points.map(([, value]) => value));
    this.limits = { x, y };
    const names = y.map(shown);
    this.left = Math.min(Math.max(20, ...names.map((name) => pen.measureText(name).width)) + 8, width / 3);
    const toX = (value) => this.left + ((width - this.left - right) * (value - x[0])) / (x[1] - x[0]);
    const toY = (value) => height - bottom - ((height - top - bottom) * (value - y[0])) / (y[1] - y[0]);
    pen.strokeStyle = color("--rule");
    pen.fillStyle = color("--muted");
    y.forEach((limit, k) => {
      pen.beginPath();
      pen.moveTo(this.left, toY(limit));
      pen.lineTo(width - right, toY(limit));
      pen.stroke();
      pen.fillText(names[k], 0, toY(limit) + 4, this.left - 4);
    });
    pen.fillText(shown(x[0]), this.left, height - 3);
    pen.textAlign = "right";
    pen.fillText(`${shown(x[1])}${xTitle && ` ${xTitle}`}`, width - right, height - 3);
    pen.textAlign = "left";
    for (const line of lines) {
      pen.strokeStyle = color(line.color);
      pen.lineWidth = line.faint ? 1 : 1.8;
      pen.setLineDash(dashes[line.dash ?? 0]);
      pen.beginPath();
      let isDrawn = false;
      for (const [px, py] of line.points) {
        if (!Number.isFinite(py)) { isDrawn = false; continue; }
        isDrawn ? pen.lineTo(toX(px), toY(py)) : pen.moveTo(toX(px), toY(py));
        isDrawn = true;
      }
      pen.stroke();
      if (line.points.length === 1 && isDrawn) pen.fillRect(toX(line.points[0][0]) - 2, toY(line.points[0][1]) - 2, 4, 4);
    }
    pen.setLineDash([]);
    if (at !== null) {
      pen.strokeStyle = color("--ink");
      pen.lineWidth = 1;
      pen.beginPath();
      pen.moveTo(toX(at), 4);
      pen.lineTo(toX(at), height - bottom + 3);
      pen.stroke();
    }
    const now = lines.filter((line) => !line.faint).map((line) => {
      const found = at === null ? line.points.at(-1) : line.points.find(([value]) => value === at);
      return `${line.name ? `${line.name} ` : ""}${found && Number.isFinite(found[1]) ? shown(found[1]) : "–"}`;
    });
    this.key.textContent = `${this.title}: ${now.join(", ")}`;
    this.canvas.setAttribute("aria-label", this.key.textContent);
  }
}

function limitsOf(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  return low === high ? [low - 0.5, high + 0.5] : [low, high];
}
