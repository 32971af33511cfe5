// The demonstrator's page: a lobby, then the chair from above or the participant's own view.
import { announce, el, row, sheet, show } from "./dom.js";
import { link } from "./link.js";
import { makeMotion, makeStick } from "./stick.js";
import { drawPlan, drawStick, sized } from "./plan.js";
import { openView } from "./view.js";

const STAYS_MS = 700;
let welcome = null, stage = null, motion = null, stick = null;
const net = link("demonstrator", {
  welcome: (message) => {
    welcome = message;
    motion = makeMotion(message.period_s);
    stick = stick || makeStick((sent) => net.send(sent), { clutch: message.live.clutch });
    lobby();
  },
  lobby,
  course: (message) => { leave(); welcome.course = message.course; },
  driving: () => {},
  page: (message) => net.send({ type: "answer", request: message.request, entered: {} }),
  picture: (picture) => { if (!stage) enter(); motion.put(picture); stage.last = performance.now(); },
  lost: () => note("The connection was lost. You have let go; trying to connect again."),
  gone: note,
});

function note(text) { leave(); show(sheet(el("p", { role: "status" }, text))); }

function lobby() {
  if (stage && performance.now() - stage.last < STAYS_MS) return;
  leave();
  if (document.querySelector("[data-testid=lobby]")) return;
  const { clutch, view } = welcome.live;
  const how = clutch === "toggle"
    ? "Press the space bar, or the button, to take over; press it again to hand back."
    : "Hold the space bar, or the button, to take over; let go to hand back.";
  const what = view === "participant" ? "what the participant sees, and the plan" : "the chair from above, its front up";
  show(el("section", { class: "sheet", test: "lobby" },
    el("h1", {}, "Waiting for a lap that needs you"),
    el("p", {}, `As soon as a lap begins you see ${what}, where the participant holds the stick, and what the laser sees.`),
    el("p", {}, how),
    el("p", {}, "Drive with the arrow keys, W A S D, a gamepad or the round pad. Your commands count only while you have taken over."),
    welcome.live.shadow ? el("p", {}, "In some laps you only watch: then the same button means “I would help now”, and the chair does not obey you.") : null));
  announce("Waiting for a lap");
}

function words(shadow, on) {
  if (shadow) return on ? "You would help now" : "I would help now";
  return on ? "You are driving" : "Take over";
}

function enter() {
  const first = welcome.live.view === "participant";
  const canvas = el("canvas", { role: "img", "aria-label": first ? "What the participant sees" : "The chair from above" });
  const corner = el("canvas", { class: "corner", role: "img", "aria-label": "The chair from above", hidden: !first });
  const sticks = el("canvas", { class: "sticks", role: "img", "aria-label": "Where the participant and you hold the stick" });
  const clutch = el("button", { class: "clutch", test: "clutch", "aria-pressed": "false" });
  clutch.addEventListener("pointerdown", (event) => { clutch.setPointerCapture(event.pointerId); stick.press("button", true); });
  for (const end of ["pointerup", "pointercancel"]) clutch.addEventListener(end, () => stick.press("button", false));
  clutch.addEventListener("contextmenu", (event) => event.preventDefault());
  const pad = el("div", { class: "pad", "aria-hidden": "true" }, el("div", { class: "knob" }));
  const role = el("div", { class: "chip", test: "demonstrator-role" });
  const p = el("div", { class: "chip", hidden: true, test: "p-help" });
  const root = el("div", { class: "stage", test: "watching" }, canvas, corner, sticks, el("div", { class: "bar" }, role, p), clutch, pad);
  stage = { canvas, corner, sticks, clutch, role, p, last: performance.now(), on: true, shadow: null, view: null };
  show(root);
  document.body.classList.add("on-stage");
  if (first) stage.view = openView(canvas, welcome.course, (n) => { stick.state.frames += n; });
  stick.bindPad(pad);
  stick.start();
  requestAnimationFrame(draw);
}

function leave() {
  if (!stage) return;
  stage.on = false;
  if (stage.view) stage.view.close();
  stage = null;
  stick.stop();
  document.body.classList.remove("on-stage");
}

function draw() {
  if (!stage || !stage.on) return;
  const pose = motion.pose(), picture = motion.picture;
  if (pose) {
    const options = { headingUp: true, mine: picture.driving, ranges: picture.ranges, fan: picture.fan, gates: picture.gates };
    if (stage.view) {
      stage.view.draw(pose, picture.gates);
      drawPlan(stage.corner, welcome.course, pose, options);
    } else {
      drawPlan(stage.canvas, welcome.course, pose, options);
      stick.state.frames += 1;
    }
    drawSticks(picture);
    state(picture);
    document.body.dataset.pose = JSON.stringify(pose);
  }
  requestAnimationFrame(draw);
}

function drawSticks(picture) {
  const [pen, w, h] = sized(stage.sticks);
  pen.clearRect(0, 0, w, h);
  const size = Math.min(w / 4 - 10, h / 2 - 14);
  drawStick(pen, w / 4, h / 2 + 8, size, picture.stick, "#1f5fa8", "participant");
  drawStick(pen, 3 * w / 4, h / 2 + 8, size, [0.7 * stick.state.f, 0.5 * stick.state.l], "#b3541e", "you");
}

function state(picture) {
  const on = stick.state.clutch;
  if (stage.shadow !== picture.shadow) {
    stage.shadow = picture.shadow;
    stage.role.textContent = picture.shadow ? "You watch: the chair does not obey you" : "You demonstrate";
    announce(stage.role.textContent);
  }
  stage.p.hidden = picture.p_help === undefined;
  if (picture.p_help !== undefined && picture.p_help !== null) stage.p.textContent = `p(h) ${picture.p_help.toFixed(2)}`;
  stage.clutch.classList.toggle("on", on);
  stage.clutch.setAttribute("aria-pressed", String(on));
  stage.clutch.textContent = words(picture.shadow, on);
}
