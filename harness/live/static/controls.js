// The controls: a picture of each device, and a try of the one that is used.
import { el, prose, row, svg } from "./dom.js";

const DIRECTIONS = [["forward", (s) => s.f > 0.6], ["back", (s) => s.f < -0.6],
  ["left", (s) => s.l > 0.6], ["right", (s) => s.l < -0.6]];
const SHIPPED = "# How to drive\n\nYou sit in a wheelchair. Drive along the way, through the gates, as "
  + "quickly and safely as you can. The next gate is orange; arrows on the floor show the direction.";

export function instructionsPage(text, stick, done) {
  const knob = svg("circle", { cx: 60, cy: 60, r: 10, class: "dot" });
  const seen = new Map(DIRECTIONS.map(([name]) => [name, el("li", {}, `${name}: not yet`)]));
  const device = el("strong", { test: "input-device" }, "keyboard");
  const result = el("p", { role: "status", test: "input-tested" }, "Try all four directions.");
  const pad = el("div", { class: "pad here", "aria-hidden": "true" }, el("div", { class: "knob" }));
  const tried = new Set();
  const page = el("section", {}, prose(text || SHIPPED), pictures(),
    el("h2", {}, "Try it"),
    el("p", {}, "Press the arrow keys or W A S D, move a gamepad's stick, or touch the round pad. You use: ", device, "."),
    el("div", { class: "try" },
      svg("svg", { viewBox: "0 0 120 120", class: "stick", role: "img", "aria-label": "Where your stick stands" },
        svg("circle", { cx: 60, cy: 60, r: 55, class: "ring" }), knob),
      el("ul", {}, [...seen.values()]), pad),
    result,
    row(el("button", { test: "instructions-continue", onclick: () => { clearInterval(timer); stick.stop(); done(); } }, "Continue")));
  stick.bindPad(pad);
  stick.start(false);
  const timer = setInterval(() => {
    if (!page.isConnected) { clearInterval(timer); return; }
    const state = stick.state;
    device.textContent = state.device;
    knob.setAttribute("cx", 60 - 45 * state.l);
    knob.setAttribute("cy", 60 - 45 * state.f);
    for (const [name, reached] of DIRECTIONS) {
      if (tried.has(name) || !reached(state)) continue;
      tried.add(name);
      seen.get(name).textContent = `${name}: works`;
      seen.get(name).className = "works";
      if (tried.size === 4) result.textContent = `Your ${state.device} works.`;
    }
  }, 60);
  return page;
}

function pictures() {
  const picture = (label, caption, ...shapes) => el("figure", {},
    svg("svg", { viewBox: "0 0 160 110", role: "img", "aria-label": label }, shapes), el("figcaption", {}, caption));
  const key = (x, y, text) => [svg("rect", { x, y, width: 26, height: 26, rx: 5, class: "shape" }),
    svg("text", { x: x + 13, y: y + 18, class: "letter" }, text)];
  return el("div", { class: "pictures" },
    picture("Arrow keys, and W A S D: forward, left, back, right", "Keys: hold them; speed and turn rise while you hold.",
      key(30, 18, "W"), key(2, 48, "A"), key(30, 48, "S"), key(58, 48, "D"),
      key(106, 18, "↑"), key(78 + 14, 48, "←"), key(120, 48, "→"), key(106, 78, "↓")),
    picture("A gamepad's left stick", "Gamepad or joystick: the first stick. The further, the faster.",
      svg("rect", { x: 15, y: 25, width: 130, height: 60, rx: 30, class: "shape" }),
      svg("circle", { cx: 52, cy: 55, r: 19, class: "ring" }), svg("circle", { cx: 57, cy: 47, r: 10, class: "dot" }),
      svg("circle", { cx: 112, cy: 45, r: 5, class: "ring" }), svg("circle", { cx: 124, cy: 57, r: 5, class: "ring" })),
    picture("The round pad of a touch screen", "Touch: pull the knob of the round pad.",
      svg("rect", { x: 45, y: 2, width: 70, height: 106, rx: 8, class: "shape" }),
      svg("circle", { cx: 88, cy: 78, r: 20, class: "ring" }), svg("circle", { cx: 92, cy: 71, r: 9, class: "dot" })));
}
