// A lap as the participant sees it: first person, plan in the corner, time, "somebody helps".
import { announce, el, show } from "./dom.js";
import { drawPlan } from "./plan.js";
import { openView } from "./view.js";

// Opens the stage. `stop` and `comfortable` are called for the buttons of these names.
export function openStage(welcome, stick, motion, { stop, comfortable }) {
  const canvas = el("canvas", { class: "view", role: "img", "aria-label": "View from the wheelchair" });
  const corner = el("canvas", { class: "corner", role: "img", "aria-label": "Plan of the course" });
  const helped = el("div", { class: "chip alert", hidden: true, test: "helped" }, "Somebody helps");
  const time = el("div", { class: "chip", hidden: !welcome.live.show_lap_time, test: "lap-time" }, "0 s");
  const enough = el("button", { class: "quiet", test: "comfortable", hidden: true, onclick: comfortable }, "I feel comfortable");
  const sound = el("button", { class: "quiet", test: "sound", "aria-pressed": "false", onclick: () => thud.toggle(sound) }, "Sound");
  const leave = el("button", { class: "quiet", test: "withdraw", onclick: stop }, "I want to stop");
  const pad = el("div", { class: "pad", "aria-hidden": "true" }, el("div", { class: "knob" }));
  const root = el("div", { class: "stage", test: "driving" }, canvas, corner,
    el("div", { class: "bar" }, time, helped, el("div", { class: "push" }, enough, sound, leave)), pad);
  const thud = makeThud();
  show(root);
  stick.bindPad(pad);
  stick.start();
  document.body.classList.add("on-stage");
  const wanted = welcome.live.view === "first-person";
  const view = wanted ? openView(canvas, welcome.course, (n) => counted(n)) : null;
  corner.hidden = !view;
  const shown = { helped: false, contact: false };
  let on = true;

  function counted(n) {
    stick.state.frames += n;
    document.body.dataset.drawn = n + Number(document.body.dataset.drawn || 0);
  }

  function bumped() {
    root.classList.add("shake");
    setTimeout(() => root.classList.remove("shake"), 300);
    if (navigator.vibrate) navigator.vibrate(120);
    thud.play();
  }

  function draw() {
    if (!on) return;
    const pose = motion.pose(), picture = motion.picture;
    if (pose) {
      const options = { gates: picture.gates };
      if (view) { view.draw(pose, picture.gates); drawPlan(corner, welcome.course, pose, options); }
      else { drawPlan(canvas, welcome.course, pose, options); counted(1); }
      if (picture.helped !== shown.helped) {
        helped.hidden = !picture.helped;
        announce(picture.helped ? "Somebody helps" : "You drive");
      }
      time.textContent = `${picture.t.toFixed(1)} s`;
      enough.hidden = !picture.practice;
      if (picture.contact && !shown.contact) bumped();
      shown.helped = picture.helped;
      shown.contact = picture.contact;
      document.body.dataset.pose = JSON.stringify(pose);
      document.body.dataset.t = picture.t;
    }
    requestAnimationFrame(draw);
  }
  requestAnimationFrame(draw);

  return {
    close() {
      on = false;
      if (view) view.close();
      stick.stop();
      document.body.classList.remove("on-stage");
    },
  };
}

// A dull sound for a collision; off until the person turns it on.
function makeThud() {
  let audio = null;
  return {
    toggle(button) {
      if (audio) { audio.close(); audio = null; } else audio = new AudioContext();
      button.setAttribute("aria-pressed", String(Boolean(audio)));
    },
    play() {
      if (!audio) return;
      const tone = audio.createOscillator(), volume = audio.createGain(), now = audio.currentTime;
      tone.frequency.setValueAtTime(90, now);
      volume.gain.setValueAtTime(0.5, now);
      volume.gain.exponentialRampToValueAtTime(0.001, now + 0.2);
      tone.connect(volume).connect(audio.destination);
      tone.start(now);
      tone.stop(now + 0.2);
    },
  };
}

// Counts down, then calls `then`.
export function countdown(then) {
  let left = 3;
  const number = el("div", { class: "count", role: "timer", test: "countdown" }, String(left));
  show(number);
  announce("The lap begins in three");
  const timer = setInterval(() => {
    if (!number.isConnected) { clearInterval(timer); return; }
    left -= 1;
    if (left > 0) number.textContent = String(left);
    else { clearInterval(timer); then(); }
  }, 700);
}
