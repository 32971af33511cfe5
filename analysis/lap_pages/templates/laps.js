// Shows recorded laps. Nothing is computed again: every number is the record's, at its own step.
const data = JSON.parse(document.getElementById("data").textContent);
const laps = new Map(data.laps.map((lap) => [lap.key, lap]));
const $ = (id) => document.getElementById(id);
const SEGMENTS = 84 * Math.PI / 180; // bearing of the middle of the outermost of 15 segments
const LASER_AHEAD = 0.6; // m in front of the axle
const CURVES = [
  { title: "p(h = 1 | x); shaded: the demonstrator would help", low: 0, high: 1, shade: "h_would", lines: [["p_help", "#009e73"]] },
  { title: "predictive variance", low: 0, lines: [["variance", "#d55e00"]] },
  { title: "forward command / m/s: driver (grey), executed (black)", lines: [["intent_v", "#8a8a8a"], ["executed_v", "#111"]] },
  { title: "turn command / rad/s: driver (grey), executed (black)", lines: [["intent_w", "#8a8a8a"], ["executed_w", "#111"]] },
];
const VALUES = [["t", "t_s", "s"], ["in control", "control", ""], ["p(h)", "p_help", ""], ["variance", "variance", ""],
  ["h", "h", ""], ["would help", "h_would", ""], ["intent v", "intent_v", "m/s"], ["intent w", "intent_w", "rad/s"],
  ["limited v", "user_v", "m/s"], ["limited w", "user_w", "rad/s"], ["assistive v", "a_v", "m/s"], ["assistive w", "a_w", "rad/s"],
  ["model's mean v", "mean_v", "m/s"], ["model's mean w", "mean_w", "rad/s"], ["executed v", "executed_v", "m/s"],
  ["executed w", "executed_w", "rad/s"], ["x", "x_m", "m"], ["y", "y_m", "m"], ["heading", "heading_rad", "rad"], ["clearance", "clearance_m", "m"]];

function make(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

function unpack([resolution, text]) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), view = new DataView(bytes.buffer);
  return Float64Array.from({ length: bytes.length / 2 }, (_, i) => {
    const whole = view.getInt16(2 * i, true);
    return whole === -32768 ? NaN : whole * resolution;
  });
}

// A lap's streams, its step at a time, and who is in control.
function opened(lap) {
  if (lap.open) return lap.open;
  const streams = {};
  for (const [name, kept] of Object.entries(lap.streams)) streams[name] = unpack(kept);
  const nothing = new Float64Array(lap.steps).fill(NaN), of = (name) => streams[name] || nothing;
  let latest = -Infinity;
  const t = of("t_s").map((value) => (latest = value > latest ? value : latest));
  const at = (time) => { let low = 0, high = lap.steps - 1; while (low < high) { const mid = (low + high + 1) >> 1; if (t[mid] <= time + 1e-6) low = mid; else high = mid - 1; } return low; };
  const control = new Array(lap.steps);
  lap.control.forEach(([from, word], n) => control.fill(word, from, n + 1 < lap.control.length ? lap.control[n + 1][0] : lap.steps));
  const trail = Array.from({ length: lap.steps }, (_, i) => [of("x_m")[i], of("y_m")[i], control[i]]);
  lap.open = { of, at, control, trail, end: Number.isFinite(latest) ? latest : 0 };
  return lap.open;
}

const label = (lap) => `${lap.participant}, lap ${lap.lap}: ${lap.condition}` +
  (lap.time_s === null ? "" : `, ${lap.time_s.toFixed(1)} s`) + (lap.completed ? "" : ", not finished");

const gatesPassed = (lap, i) => lap.gates.filter((step) => step <= i).length;

let panels = [], time = 0, playing = false, before = 0, scheduled = false;

function panel(lap) {
  const open = opened(lap);
  const root = make("article", "lap"), views = make("div", "views");
  const view = make("canvas", "view"), plan = make("canvas", "plan"), sticks = make("canvas", "sticks");
  view.setAttribute("aria-label", "First-person view"); plan.setAttribute("aria-label", "Plan");
  sticks.setAttribute("aria-label", "Sticks: driver, assistance, executed");
  views.append(view, plan);
  root.append(make("h2", "", label(lap)), views, sticks);
  const curves = CURVES.filter((c) => c.lines.some(([name]) => lap.streams[name])).map((curve) => {
    const canvas = make("canvas", "curve");
    canvas.setAttribute("aria-label", curve.title);
    const scrub = (event) => { if (event.type === "pointermove" && event.pointerType !== "mouse" && !event.buttons) return; const box = canvas.getBoundingClientRect(); go(Math.max(0, Math.min(1, (event.clientX - box.left - 36) / (box.width - 44))) * open.end); };
    canvas.addEventListener("pointermove", scrub); canvas.addEventListener("pointerdown", scrub);
    root.append(canvas);
    return [curve, canvas];
  });
  const list = make("dl", "values"), cells = VALUES.filter(([, name]) => name === "control" || lap.streams[name]).map(([title, name, unit]) => {
    const row = make("div"), value = make("dd"); row.append(make("dt", "", title), value); list.append(row);
    return [name, unit, value];
  });
  root.append(list);
  let eyes = makeView(view, data.courses[lap.course]);
  if (!eyes) { view.remove(); views.style.gridTemplateColumns = "1fr"; }
  return {
    root, open,
    draw() {
      const i = open.at(time), pose = ["x_m", "y_m", "heading_rad"].map((name) => open.of(name)[i]);
      const seen = pose.every(Number.isFinite), helped = open.control[i] !== "driver", next = gatesPassed(lap, i);
      if (eyes && seen) { const scale = Math.min(window.devicePixelRatio || 1, 2); eyes.draw(pose, next, Math.round(view.clientWidth * scale), Math.round(view.clientHeight * scale)); }
      const ranges = Array.from({ length: 15 }, (_, k) => open.of(`segment_${String(k).padStart(2, "0")}`)[i]);
      drawPlan(plan, data.courses[lap.course], seen ? pose : null, { trail: open.trail.slice(0, i + 1), mine: helped, gates: next,
        ranges: ranges.every(Number.isFinite) ? ranges : null, fan: [-SEGMENTS, SEGMENTS, LASER_AHEAD] });
      drawSticks(sticks, open, i);
      for (const [curve, canvas] of curves) drawCurve(canvas, curve, open, i);
      for (const [name, unit, cell] of cells) {
        const value = name === "control" ? open.control[i] : open.of(name)[i];
        cell.textContent = typeof value === "string" ? value : Number.isFinite(value) ? `${value.toFixed(name === "h" || name === "h_would" ? 0 : 3)} ${unit}` : "–";
      }
    },
    close() { if (eyes) { const lost = view.getContext("webgl").getExtension("WEBGL_lose_context"); if (lost) lost.loseContext(); eyes = null; } },
  };
}

function drawSticks(canvas, open, i) {
  const [pen, w, h] = sized(canvas);
  pen.clearRect(0, 0, w, h);
  [["driver", "intent", "#6b6b6b"], ["assistance", "a", "#0072b2"], ["model's mean", "mean", "#009e73"], ["executed", "executed", "#111"]]
    .filter(([, name]) => open.of(`${name}_v`).some(Number.isFinite)).forEach(([title, name, colour], n) => {
      const pair = [open.of(`${name}_v`)[i], open.of(`${name}_w`)[i]], x = 38 + n * Math.min(96, (w - 70) / 3);
      drawStick(pen, x, 46, 26, pair.every(Number.isFinite) ? pair : [NaN, NaN], colour, title);
    });
}

function drawCurve(canvas, curve, open, i) {
  const [pen, w, h] = sized(canvas), left = 36, right = w - 8, top = 20, bottom = h - 16;
  pen.clearRect(0, 0, w, h);
  const t = open.of("t_s"), all = curve.lines.flatMap(([name]) => Array.from(open.of(name)).filter(Number.isFinite));
  let low = curve.low ?? Math.min(0, ...all), high = curve.high ?? Math.max(...all, low + 1e-3);
  const X = (s) => left + (right - left) * s / (open.end || 1), Y = (v) => bottom - (bottom - top) * (v - low) / (high - low);
  if (curve.shade) {
    pen.fillStyle = "rgba(0,114,178,.16)";
    open.of(curve.shade).forEach((value, k) => { if (value > 0) { const next = k + 1 < t.length ? t[k + 1] : open.end; pen.fillRect(X(t[k]), top, Math.max(X(next) - X(t[k]), 0.5), bottom - top); } });
  }
  pen.strokeStyle = "#d5d5d5"; pen.lineWidth = 1; pen.strokeRect(left, top, right - left, bottom - top);
  for (const [name, colour] of curve.lines) {
    pen.strokeStyle = colour; pen.lineWidth = 1.3; pen.beginPath();
    let on = false;
    open.of(name).forEach((value, k) => { if (!Number.isFinite(value)) { on = false; return; } const x = X(t[k]), y = Y(value); if (on) pen.lineTo(x, y); else pen.moveTo(x, y); on = true; });
    pen.stroke();
  }
  pen.strokeStyle = "#d55e00"; pen.beginPath(); pen.moveTo(X(t[i]), top); pen.lineTo(X(t[i]), bottom); pen.stroke();
  pen.fillStyle = "#333"; pen.font = "11px system-ui, sans-serif"; pen.textBaseline = "middle"; pen.textAlign = "left";
  const here = curve.lines.map(([name]) => open.of(name)[i]).map((v) => (Number.isFinite(v) ? v.toFixed(3) : "–")).join(", ");
  pen.fillText(w > 420 ? `${curve.title}: ${here}` : `${curve.title.split(/[;:]/)[0]}: ${here}`, left, 9);
  pen.textAlign = "right"; pen.fillText(high.toFixed(2), left - 4, top + 4); pen.fillText(low.toFixed(2), left - 4, bottom - 4);
  pen.textAlign = "left"; pen.fillText("0", left, h - 7); pen.textAlign = "right"; pen.fillText(`${open.end.toFixed(1)} s`, right, h - 7);
}

function frame(now) {
  scheduled = false;
  if (playing) {
    time += Math.min((now - before) / 1000, 0.25) * Number($("speed").value);
    const end = Number($("time").max);
    if (time >= end) { time = end; toggle(false); }
  }
  before = now;
  $("time").value = String(time); $("clock").textContent = `${time.toFixed(1)} s`;
  document.body.dataset.time = time.toFixed(2);
  for (const one of panels) one.draw();
  if (playing) soon();
}
function soon() { if (!scheduled) { scheduled = true; requestAnimationFrame(frame); } }
function go(to) { time = to; soon(); }
function toggle(on) {
  playing = on; $("play").textContent = on ? "Pause" : "Play";
  if (on && time >= Number($("time").max)) time = 0;
  before = performance.now(); soon();
}

function show(keys) {
  const chosen = keys.filter((key) => laps.has(key)).slice(0, 2);
  if (!chosen.length) return false;
  for (const one of panels) one.close();
  panels = chosen.map((key) => panel(laps.get(key)));
  $("laps").replaceChildren(...panels.map((one) => one.root));
  $("laps").className = panels.length > 1 ? "two" : "";
  $("first").value = chosen[0]; $("second").value = chosen[1] || "";
  $("time").max = String(Math.max(...panels.map((one) => one.open.end)));
  document.querySelectorAll("#figure .point").forEach((point) => point.classList.toggle("on", chosen.includes(point.dataset.key)));
  document.body.dataset.shown = chosen.join(" ");
  go(0);
  return true;
}
const linked = () => decodeURIComponent(location.hash.slice(1)).split(",").filter(Boolean);

function figure() {
  const conditions = [...new Set(data.points.map((point) => point.condition))];
  const svg = (tag, attributes, text) => { const made = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const [k, v] of Object.entries(attributes)) made.setAttribute(k, v); if (text !== undefined) made.textContent = text; return made; };
  const width = Math.max(320, 60 + 120 * conditions.length), height = 300, top = 12, bottom = height - 34;
  const root = $("figure");
  root.setAttribute("viewBox", `0 0 ${width} ${height}`); root.setAttribute("width", width); root.setAttribute("height", height);
  const high = Math.max(1, ...data.points.map((point) => point.time_s || 0)), Y = (s) => bottom - (bottom - top) * s / (1.05 * high);
  const every = 10 ** Math.floor(Math.log10(high)) / (high / 10 ** Math.floor(Math.log10(high)) < 3 ? 2 : 1);
  for (let s = 0; s <= 1.05 * high; s += every) root.append(svg("line", { class: "axis", x1: 44, x2: width - 6, y1: Y(s), y2: Y(s) }), svg("text", { x: 38, y: Y(s) + 4, "text-anchor": "end" }, String(Math.round(s * 10) / 10)));
  root.append(svg("text", { x: 4, y: 10 }, "s"));
  conditions.forEach((condition, n) => {
    const here = data.points.filter((point) => point.condition === condition), middle = 104 + 120 * n;
    const name = svg("text", { x: middle, y: height - 14, "text-anchor": "middle" }, condition.length > 18 ? `${condition.slice(0, 17)}…` : condition);
    name.append(svg("title", {}, condition)); root.append(name);
    here.forEach((point, k) => {
      if (point.time_s === null) return;
      const x = middle + (here.length > 1 ? 80 * (k / (here.length - 1) - 0.5) : 0), y = Y(point.time_s), there = laps.has(point.key);
      const kind = `point${there ? "" : " without"}${point.completed ? "" : " cut"}`;
      const mark = point.completed ? svg("circle", { cx: x, cy: y, r: 5, class: kind }) : svg("path", { d: `M${x - 5} ${y - 5}l10 10m0 -10l-10 10`, class: kind });
      mark.append(svg("title", {}, label(point))); mark.dataset.key = point.key;
      mark.addEventListener("click", () => {
        if (there) { location.hash = point.key; $("said").textContent = `Shown: ${label(point)}`; }
        else $("said").textContent = `${label(point)}. This page does not hold it: lad-study replay DIR --participant ${point.participant} --lap ${point.lap} --out lap.html`;
      });
      root.append(mark);
    });
  });
}

for (const lap of data.laps) for (const id of ["first", "second"]) { const option = make("option", "", label(lap)); option.value = lap.key; $(id).append(option); }
const none = make("option", "", "no other lap"); none.value = ""; $("second").prepend(none);
const chosen = () => { location.hash = [$("first").value, $("second").value].filter(Boolean).join(","); };
$("first").addEventListener("change", chosen); $("second").addEventListener("change", chosen);
$("time").addEventListener("input", () => { if (playing) toggle(false); go(Number($("time").value)); });
$("play").addEventListener("click", () => toggle(!playing));
addEventListener("hashchange", () => show(linked()));
addEventListener("resize", soon);
if (data.points.length) figure();
show(linked()) || show(data.shown);
