// Curves over lap time on a small canvas.
import { sized } from "./plan.js";

const LEFT = 38, RIGHT = 10, TOP = 18, BOTTOM = 18, SHORTEST_S = 10;

// Draws curves of a trail: `of` gives a row's value or null; `top` is the axis's end. Without it a
// curve is drawn as a share of its largest value, or of the largest of all that are `shared`.
export function drawCurves(canvas, trail, curves, title) {
  const [pen, w, h] = sized(canvas);
  pen.clearRect(0, 0, w, h);
  pen.font = "11px system-ui, sans-serif";
  pen.fillStyle = "#5b6675";
  pen.fillText(title, LEFT, 12);
  if (trail.length < 2) return;
  const first = trail[0][3], last = Math.max(trail[trail.length - 1][3], first + SHORTEST_S);
  const x = (t) => LEFT + (w - LEFT - RIGHT) * (t - first) / (last - first);
  const largest = (some) => Math.max(1e-9, ...trail.flatMap((r) => some.map((c) => c.of(r) ?? 0)));
  const common = largest(curves.filter((c) => c.shared));
  const top = curves[0].top ?? common;
  pen.strokeStyle = "#cfd6df";
  for (const share of [0, 0.5, 1]) {
    const y = h - BOTTOM - (h - TOP - BOTTOM) * share;
    pen.beginPath(); pen.moveTo(LEFT, y); pen.lineTo(w - RIGHT, y); pen.stroke();
    pen.fillText(label(top * share), 4, y + 4);
  }
  pen.fillText(`${first.toFixed(0)} s`, LEFT, h - 4);
  pen.fillText(`${last.toFixed(0)} s`, w - RIGHT - 26, h - 4);
  for (const curve of curves) {
    const scale = 1 / (curve.top ?? (curve.shared ? common : largest([curve])));
    pen.strokeStyle = curve.colour;
    pen.setLineDash(curve.dash || []);
    pen.beginPath();
    let drawing = false;
    for (const point of trail) {
      const value = curve.of(point);
      if (value === null || value === undefined) { drawing = false; continue; }
      const y = h - BOTTOM - (h - TOP - BOTTOM) * Math.min(value * scale, 1);
      if (drawing) pen.lineTo(x(point[3]), y); else pen.moveTo(x(point[3]), y);
      drawing = true;
    }
    pen.stroke();
    pen.setLineDash([]);
  }
}

function label(value) { return value >= 10 ? value.toFixed(0) : value >= 1 ? value.toFixed(1) : value.toFixed(2).replace(/\.?0+$/, "") || "0"; }
