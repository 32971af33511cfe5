import { el, show } from "./dom.js";
import { link } from "./link.js";
import { makeMotion, makeStick } from "./stick.js";
import { drawPlan, drawStick } from "./plan.js";

let welcome = null, stage = null, motion = null, stick = null;
const net = link("demonstrator", {
  welcome: (message) => { welcome = message; motion = makeMotion(message.period_s); stick = stick || makeStick((m) => net.send(m), { clutch: message.live.clutch }); lobby(); },
  lobby, driving: () => {}, lost: () => note("The connection was lost. You have let go; trying to connect again."), gone: note,
  page: (message) => { net.send({ type: "answer", request: message.request, entered: {} }); },
  picture: (picture) => { if (!stage) enter(); motion.put(picture); stage.last = performance.now(); },
});

function note(text) { leave(); show(el("section", { class: "sheet" }, el("p", {}, text))); }
function lobby() {
  if (stage && performance.now() - stage.last < 700) return;
  leave();
  if (document.querySelector("[data-testid=lobby]")) return;
  show(el("section", { class: "sheet", test: "lobby" }, el("h1", {}, "Waiting for a lap that needs you"),
    el("p", {}, "You see the chair from above as soon as a lap begins."),
    el("p", {}, welcome && welcome.live.clutch === "toggle" ? "Press the space bar, or the button, to take over; press it again to hand back." : "Hold the space bar, or the button, to take over; let go to hand back."),
    el("p", {}, "Drive with the arrow keys, W A S D, a gamepad or the round pad. Your commands count only while you have taken over.")));
}

function enter() {
  const canvas = el("canvas", { "aria-label": "The chair from above" });
  const clutch = el("button", { class: "clutch", test: "clutch" }, "Take over");
  const on = (value) => { stick.state.clutch = value; };
  if (welcome.live.clutch === "toggle") clutch.addEventListener("click", () => on(!stick.state.clutch));
  else { clutch.addEventListener("pointerdown", () => on(true)); for (const end of ["pointerup", "pointercancel", "pointerleave"]) clutch.addEventListener(end, () => on(false)); }
  const pad = el("div", { class: "pad", "aria-hidden": "true" }, el("div", { class: "knob" }));
  const p = el("div", { class: "chip", hidden: true });
  const root = el("div", { class: "stage", test: "watching" }, canvas, el("div", { class: "bar" }, el("div", { class: "chip" }, "You demonstrate"), p), clutch, pad);
  stage = { root, canvas, clutch, p, last: performance.now(), on: true };
  show(root); stick.bindPad(pad); stick.start(); requestAnimationFrame(draw);
}

function leave() { if (stage) { stage.on = false; stage = null; stick.stop(); stick.state.clutch = false; } }

function draw() {
  if (!stage || !stage.on) return;
  const pose = motion.pose(), picture = motion.picture;
  if (pose) {
    drawPlan(stage.canvas, welcome.course, pose, { headingUp: true, helped: picture.helped, ranges: picture.ranges, gates: picture.gates });
    const pen = stage.canvas.getContext("2d"), h = stage.canvas.clientHeight;
    pen.fillStyle = "#1d2530"; pen.font = "13px system-ui"; pen.fillText("participant", 16, h - 112);
    drawStick(pen, 60, h - 60, 44, picture.stick, "#1f5fa8");
    stage.p.hidden = picture.p_help === undefined; if (picture.p_help !== undefined) stage.p.textContent = `p(h) ${picture.p_help.toFixed(2)}`;
    stage.clutch.classList.toggle("on", stick.state.clutch);
    stage.clutch.textContent = stick.state.clutch ? "You are driving" : "Take over";
    stick.state.frames += 1;
    document.body.dataset.pose = JSON.stringify(pose);
  }
  requestAnimationFrame(draw);
}
