import { el, prose, show } from "./dom.js";
import { link } from "./link.js";
import { makeMotion, makeStick } from "./stick.js";
import { drawPlan } from "./plan.js";
import { makeView } from "./view3d.js";

// The 3-D view, in a worker where the browser can; null where there is none.
function openView(canvas, course, counted) {
  const size = () => { const scale = Math.min(window.devicePixelRatio || 1, 2); return [Math.round(canvas.clientWidth * scale), Math.round(canvas.clientHeight * scale)]; };
  if (!hasWebGL()) return null;
  if (canvas.transferControlToOffscreen && window.Worker) {
    const worker = new Worker("/static/view3d-worker.js", { type: "module" });
    worker.onmessage = (event) => { if (event.data.drawn) counted(event.data.drawn); };
    const off = canvas.transferControlToOffscreen();
    worker.postMessage({ canvas: off, course }, [off]);
    return { draw(pose, gate) { const [w, h] = size(); worker.postMessage({ pose, gate, w, h }); }, close: () => worker.terminate() };
  }
  const view = makeView(canvas, course);
  return view && { draw(pose, gate) { view.draw(pose, gate, ...size()); counted(1); }, close() {} };
}

let welcome = null, stage = null, request = null, motion = null, period = 0.1;
let roundTrips = [], lastContact = false;
const net = link("participant", {
  view: () => (hasWebGL() ? "first-person" : "plan"),
  welcome: (message) => { welcome = message; period = message.period_s; motion = makeMotion(period); if (!stage) waiting("One moment, please."); },
  page: (message) => { leaveStage(); request = message.request; (pages[message.kind] || pages.text)(message); },
  driving: () => { if (!stage) enterStage(); },
  picture: (picture) => { if (!stage) enterStage(); motion.put(picture); },
  full: () => gone("The study has no free place at the moment. Please ask the experimenter."),
  bye: (message) => { leaveStage(); goodbye(message.completion); net.close(); },
  lost: () => waiting("The connection was lost. The chair stands; trying to connect again."),
  gone,
});
const stick = makeStick((message) => net.send(message));

function hasWebGL() { try { return Boolean(document.createElement("canvas").getContext("webgl")); } catch { return false; } }
function answer(entered) { net.send({ type: "answer", request, entered }); waiting("One moment, please."); }
function sheet(...children) { show(el("section", { class: "sheet" }, children, stopRow())); }
function waiting(text) { leaveStage(); show(el("section", { class: "sheet" }, el("p", {}, text))); }
function gone(text) { leaveStage(); show(el("section", { class: "sheet" }, el("h1", {}, "Closed"), el("p", {}, text))); }
function stopRow() {
  return el("div", { class: "row" }, el("button", { class: "quiet", test: "withdraw", onclick: wantToStop }, "I want to stop"));
}
function wantToStop() {
  const box = el("section", { class: "sheet" }, el("h1", {}, "Do you want to stop?"),
    el("p", {}, "You can stop at any time, without giving a reason. If you want to, tell us why:"),
    el("textarea", { rows: "3", maxlength: "2000", id: "why", "aria-label": "Reason (optional)" }),
    el("div", { class: "row" },
      el("button", { class: "stop", test: "withdraw-confirm", onclick: () => net.send({ type: "withdraw", reason: document.getElementById("why").value }) }, "Stop now"),
      el("button", { class: "quiet", onclick: () => location.reload() }, "Go on")));
  leaveStage(); show(box);
}

function measureFrames() {
  return new Promise((done) => {
    let n = 0; const begun = performance.now();
    const tick = () => { n += 1; const t = performance.now() - begun; if (t < 1000) requestAnimationFrame(tick); else done(Math.round(1000 * n / t)); };
    requestAnimationFrame(tick);
  });
}

const pages = {
  text: (page) => sheet(prose(page.text || ""), el("div", { class: "row" }, el("button", { onclick: () => answer({}) }, "Continue"))),
  check: async (page) => {
    const status = el("p", {}, "Checking your machine ...");
    sheet(el("h1", {}, "Your machine"), status);
    const rate = await measureFrames();
    const webgl = hasWebGL(), pad = Boolean(stick.gamepad());
    status.replaceWith(el("ul", {}, el("li", {}, `Pictures a second: ${rate}`),
      el("li", {}, webgl ? "3-D view: yes" : "3-D view: no; you will drive by the plan"),
      el("li", {}, pad ? "Gamepad: found" : window.isSecureContext ? "Gamepad: none; press a button on it, or use the keyboard or touch" : "Gamepad: not available over this connection; keyboard and touch work")),
      el("div", { class: "row" }, el("button", { test: "check-continue", onclick: () => answer({ frame_rate: rate, webgl: webgl ? 1 : 0, gamepad: pad ? 1 : 0 }) }, "Continue")));
  },
  consent: (page) => sheet(prose(page.text), el("div", { class: "row" },
    el("button", { test: "consent-agree", onclick: () => answer({ agreed: 1 }) }, "I agree"),
    el("button", { class: "quiet", test: "consent-refuse", onclick: () => answer({ agreed: 0 }) }, "I do not agree"))),
  demographics: (page) => {
    const choice = { gender: ["female", "male", "other", "undisclosed"], handedness: ["right", "left", "both", "undisclosed"] };
    const label = { age_years: "Age in years", gender: "Gender", handedness: "Handedness" };
    const fields = page.fields.map((name) => el("label", {}, el("p", {}, label[name] || name), choice[name]
      ? el("select", { name }, el("option", { value: "" }, "no answer"), choice[name].map((c) => el("option", { value: c }, c)))
      : el("input", { name, type: "number", min: "1", max: "120", inputmode: "numeric" })));
    const form = el("form", { onsubmit: (event) => {
      event.preventDefault();
      const entered = {};
      for (const name of page.fields) { const value = form.elements[name].value; entered[name] = value === "" ? null : choice[name] ? value : Number(value); }
      answer(entered);
    } }, fields, el("div", { class: "row" }, el("button", { test: "demographics-submit" }, "Continue")));
    sheet(el("h1", {}, "About you"), form);
  },
  instructions: (page) => {
    const keys = {};
    const grid = el("div", { class: "keys", "aria-hidden": "true" }, ["", "ArrowUp", "", "ArrowLeft", "ArrowDown", "ArrowRight"].map((code) => {
      if (!code) return el("i");
      keys[code] = el("span", {}, { ArrowUp: "↑", ArrowDown: "↓", ArrowLeft: "←", ArrowRight: "→" }[code]);
      return keys[code];
    }));
    const device = el("p", { class: "soft" }, "Try it: press an arrow key, W A S D, move a gamepad's stick, or touch the round pad.");
    const timer = setInterval(() => {
      if (!grid.isConnected) { clearInterval(timer); return; }
      for (const [code, key] of Object.entries(keys)) key.classList.toggle("on", stick.held.has(code) || stick.held.has({ ArrowUp: "KeyW", ArrowDown: "KeyS", ArrowLeft: "KeyA", ArrowRight: "KeyD" }[code]));
      const pad = stick.gamepad(); if (pad && (pad.f || pad.l)) device.textContent = "Gamepad: works.";
    }, 80);
    sheet(prose(page.text || "# How to drive\n\nYou sit in a wheelchair. Drive along the way, through the gates, as quickly and safely as you can. The next gate is orange; arrows on the floor show the direction."), grid, device,
      el("div", { class: "row" }, el("button", { test: "instructions-continue", onclick: () => answer({}) }, "Continue")));
  },
  ready: (page) => sheet(el("h1", {}, page.resumed ? "Welcome back" : "Ready?"),
    el("p", {}, page.resumed ? "The lap goes on where it was." : "The lap begins after a short countdown."),
    el("div", { class: "row" }, el("button", { test: "lap-start", onclick: () => countdown(() => answer({})) }, page.resumed ? "Go on" : "Start the lap"))),
  questions: (page) => {
    const form = el("form", { onsubmit: (event) => {
      event.preventDefault();
      const entered = {};
      for (const q of page.questions) {
        const field = form.elements[`${q.instrument}.${q.item}`]; const value = field ? field.value : "";
        entered[`${q.instrument}.${q.item}`] = value === "" ? null : q.answer === "text" ? value : Number(value);
      }
      answer(entered);
    } }, page.questions.map((q) => {
      const name = `${q.instrument}.${q.item}`;
      if (q.answer === "text") return el("fieldset", {}, el("legend", {}, q.text), el("textarea", { name, rows: "3", maxlength: "2000", "aria-label": q.text }));
      if (q.answer === "number") return el("fieldset", {}, el("legend", {}, q.text), el("input", { name, type: "number", step: "any", min: q.lowest, max: q.highest, "aria-label": q.text }));
      const labels = q.anchors.length ? q.anchors : Array.from({ length: q.points }, (_, i) => String(i + 1));
      return el("fieldset", {}, el("legend", {}, q.text), el("div", { class: "scale" }, labels.map((text, i) => {
        const input = el("input", { type: "radio", name, value: i + 1, test: `answer-${q.item}-${i + 1}`, onchange: (event) => {
          for (const other of event.target.closest(".scale").children) other.classList.toggle("chosen", other.contains(event.target));
        } });
        return el("label", {}, input, text);
      })));
    }), el("div", { class: "row" }, el("button", { test: "questions-submit" }, "Continue")));
    sheet(el("h1", {}, "About the lap you just drove"), form);
  },
  break: (page) => {
    const button = el("button", { disabled: true, test: "break-continue", onclick: () => answer({}) }, "Continue");
    sheet(el("h1", {}, "A short break"), el("p", {}, `Please rest for at least ${Math.round(page.seconds)} seconds.`), el("div", { class: "row" }, button));
    setTimeout(() => { button.disabled = false; button.focus(); }, 1000 * page.seconds);
  },
  debrief: (page) => sheet(prose(page.text), el("div", { class: "row" }, el("button", { test: "debrief-done", onclick: () => answer({}) }, "Done"))),
};

function countdown(then) {
  let left = 3; const number = el("div", { class: "count", "aria-live": "assertive" }, String(left));
  show(number);
  const timer = setInterval(() => { left -= 1; if (left > 0) number.textContent = String(left); else { clearInterval(timer); then(); } }, 700);
}

function enterStage() {
  const canvas = el("canvas", { class: "view", "aria-label": "View from the wheelchair" });
  const corner = el("canvas", { class: "corner", "aria-label": "Plan of the course" });
  const helped = el("div", { class: "chip alert", hidden: true, test: "helped" }, "Somebody helps");
  const time = el("div", { class: "chip", hidden: !welcome.live.show_lap_time }, "0 s");
  const comfortable = el("button", { class: "quiet", test: "comfortable", onclick: () => net.send({ type: "comfortable" }) }, "I feel comfortable");
  const pad = el("div", { class: "pad", "aria-hidden": "true" }, el("div", { class: "knob" }));
  const root = el("div", { class: "stage", test: "driving" }, canvas, corner, el("div", { class: "bar" }, time, helped, comfortable,
    el("button", { class: "quiet push", test: "withdraw", onclick: wantToStop }, "I want to stop")), pad);
  stage = { root, canvas, corner, helped, time, comfortable, on: true };
  show(root); stick.bindPad(pad);
  const wants3d = welcome.live.view === "first-person";
  stage.view = wants3d ? openView(canvas, welcome.course, (n) => { stick.state.frames += n; }) : null;
  if (!stage.view) corner.hidden = true;
  stick.start(); requestAnimationFrame(drawStage);
}

function leaveStage() { if (stage) { stage.on = false; if (stage.view) stage.view.close(); stage = null; stick.stop(); } }

function drawStage() {
  if (!stage || !stage.on) return;
  const pose = motion.pose(), picture = motion.picture;
  if (pose) {
    if (stage.view) { stage.view.draw(pose, picture.gates); drawPlan(stage.corner, welcome.course, pose, { helped: picture.helped, gates: picture.gates }); }
    else { drawPlan(stage.canvas, welcome.course, pose, { helped: picture.helped, gates: picture.gates }); stick.state.frames += 1; }
    stage.helped.hidden = !picture.helped;
    stage.time.textContent = `${picture.t.toFixed(1)} s`;
    stage.comfortable.hidden = !picture.practice;
    if (picture.contact && !lastContact) { stage.root.classList.add("shake"); setTimeout(() => stage && stage.root.classList.remove("shake"), 300); }
    lastContact = picture.contact;
    document.body.dataset.pose = JSON.stringify(pose);
  }
  requestAnimationFrame(drawStage);
}

function goodbye(completion) {
  const parts = [el("h1", {}, "Thank you"), el("p", {}, "You can close this page now.")];
  if (completion && completion.code) parts.push(el("p", {}, "Your completion code: ", el("strong", { test: "completion-code" }, completion.code)));
  if (completion && completion.url) parts.push(el("p", {}, el("a", { href: completion.url, rel: "noreferrer" }, "Back to the platform")));
  show(el("section", { class: "sheet" }, parts));
}
