// The floor plan: walls, gates, chair, laser, trail. Heading up around the chair, or north up.
export const CHAIR = { front: 0.62, rear: 0.23, width: 0.55 };
export const COLOURS = { driver: "#1f5fa8", demonstrator: "#b3541e", model: "#2b7a4b" };

export function sized(canvas) {
  const scale = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
  if (canvas.width !== Math.round(w * scale) || canvas.height !== Math.round(h * scale)) {
    canvas.width = Math.round(w * scale); canvas.height = Math.round(h * scale);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  return [pen, w, h];
}

export function bounds(course) {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [cx, cy, , length, width] of course.boxes) {
    const r = Math.hypot(length, width) / 2;
    x0 = Math.min(x0, cx - r); x1 = Math.max(x1, cx + r); y0 = Math.min(y0, cy - r); y1 = Math.max(y1, cy + r);
  }
  return [x0, y0, x1, y1];
}

export function drawPlan(canvas, course, pose, options = {}) {
  const [pen, w, h] = sized(canvas);
  pen.clearRect(0, 0, w, h);
  pen.save();
  if (options.headingUp && pose) {
    const scale = Math.min(w, h) / (options.metres || 9);
    pen.translate(w / 2, h * 0.62); pen.scale(scale, -scale);
    pen.rotate(Math.PI / 2 - pose[2]); pen.translate(-pose[0], -pose[1]);
  } else {
    const [x0, y0, x1, y1] = bounds(course);
    const scale = Math.min(w / (x1 - x0 + 0.6), h / (y1 - y0 + 0.6));
    pen.translate(w / 2, h / 2); pen.scale(scale, -scale); pen.translate(-(x0 + x1) / 2, -(y0 + y1) / 2);
  }
  pen.fillStyle = "#8d99a8";
  for (const [cx, cy, heading, length, width] of course.boxes) {
    pen.save(); pen.translate(cx, cy); pen.rotate(heading); pen.fillRect(-length / 2, -width / 2, length, width); pen.restore();
  }
  course.gates.forEach(([name, left, right], i) => {
    pen.strokeStyle = pose && options.gates === i ? "#d07a00" : "#9bb59f"; pen.lineWidth = 0.06;
    pen.setLineDash([0.15, 0.1]); pen.beginPath(); pen.moveTo(...left); pen.lineTo(...right); pen.stroke(); pen.setLineDash([]);
  });
  if (options.trail) {
    pen.lineWidth = 0.09; pen.lineCap = "round";
    for (let i = 1; i < options.trail.length; i++) {
      pen.strokeStyle = COLOURS[options.trail[i][2]] || "#555"; pen.beginPath();
      pen.moveTo(options.trail[i - 1][0], options.trail[i - 1][1]); pen.lineTo(options.trail[i][0], options.trail[i][1]); pen.stroke();
    }
  }
  if (pose) {
    if (options.ranges) {
      const n = options.ranges.length, [right, left, ahead] = options.fan;
      pen.fillStyle = "rgba(31,95,168,.12)"; pen.beginPath();
      const lx = pose[0] + ahead * Math.cos(pose[2]), ly = pose[1] + ahead * Math.sin(pose[2]);
      pen.moveTo(lx, ly);
      options.ranges.forEach((range, i) => {
        const angle = pose[2] + right + (left - right) * i / (n - 1);
        pen.lineTo(lx + range * Math.cos(angle), ly + range * Math.sin(angle));
      });
      pen.closePath(); pen.fill();
    }
    pen.save(); pen.translate(pose[0], pose[1]); pen.rotate(pose[2]);
    pen.fillStyle = options.mine ? "#b3541e" : "#1f5fa8";
    pen.fillRect(-CHAIR.rear, -CHAIR.width / 2, CHAIR.front + CHAIR.rear, CHAIR.width);
    pen.fillStyle = "#fff"; pen.beginPath(); pen.moveTo(CHAIR.front - 0.05, 0); pen.lineTo(CHAIR.front - 0.3, 0.15); pen.lineTo(CHAIR.front - 0.3, -0.15); pen.fill();
    pen.restore();
  }
  pen.restore();
}

// A stick's square: `pair` is the command in m/s and rad/s, full deflection 0.7 and 0.5.
export function drawStick(pen, x, y, size, pair, colour, name) {
  pen.fillStyle = "rgba(255,255,255,.85)"; pen.fillRect(x - size, y - size, 2 * size, 2 * size);
  pen.strokeStyle = "#8d99a8"; pen.lineWidth = 1; pen.strokeRect(x - size, y - size, 2 * size, 2 * size);
  pen.beginPath(); pen.moveTo(x - size, y); pen.lineTo(x + size, y); pen.moveTo(x, y - size); pen.lineTo(x, y + size); pen.stroke();
  pen.fillStyle = colour; pen.beginPath();
  pen.arc(x - size * (pair[1] / 0.5), y - size * (pair[0] / 0.7), 5, 0, 7); pen.fill();
  pen.fillStyle = "#1d2530"; pen.font = "11px system-ui, sans-serif"; pen.textAlign = "center";
  pen.fillText(name, x, y - size - 4); pen.textAlign = "start";
}
