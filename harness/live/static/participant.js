// The participant's page: pages before and after the laps, and the laps.
import { announce, el, prose, row, sheet, show } from "./dom.js";
import { checkPage } from "./machine.js";
import { countdown, openStage } from "./driving.js";
import { hasWebGL } from "./view.js";
import { instructionsPage } from "./controls.js";
import { link } from "./link.js";
import { makeMotion, makeStick } from "./stick.js";
import { askQuestions, forgetDraft } from "./questions.js";

let welcome = null, stage = null, request = null, motion = null;
const net = link("participant", {
  view: () => (hasWebGL() ? "first-person" : "plan"),
  welcome: (message) => {
    welcome = message;
    motion = makeMotion(message.period_s);
    if (!stage) waiting("One moment, please.");
  },
  page: (message) => { leaveStage(); request = message.request; (pages[message.kind] || pages.text)(message); },
  driving: enterStage,
  picture: (picture) => { enterStage(); motion.put(picture); },
  full: () => closed("The study has no free place at the moment. Please ask the experimenter."),
  bye: (message) => { leaveStage(); forgetDraft(); goodbye(message); net.close(); },
  lost: () => waiting("The connection was lost. The chair stands; trying to connect again."),
  gone: closed,
});
const stick = makeStick((message) => net.send(message));

function answer(entered) { net.send({ type: "answer", request, entered }); waiting("One moment, please."); }
function page(...children) { show(sheet(children, stopRow())); }
function waiting(text) { leaveStage(); show(sheet(el("p", { role: "status" }, text))); }
function closed(text) { leaveStage(); show(sheet(el("h1", {}, "Closed"), el("p", {}, text))); }
function stopRow() {
  return el("footer", { class: "row" }, el("button", { class: "quiet", test: "withdraw", onclick: wantToStop }, "I want to stop"));
}
function button(test, label, entered) { return el("button", { test, onclick: () => answer(entered) }, label); }

const AFTER_STOPPING = {
  keep: "What you did so far is kept, without your name.",
  purge: "Everything that was recorded about you will be deleted.",
};

// Asks before it ends the session; the chair stands meanwhile.
function wantToStop() {
  stick.state.blocked = true;
  const why = el("textarea", { rows: "3", maxlength: "2000", id: "why" });
  const close = () => { stick.state.blocked = false; box.remove(); };
  const box = el("dialog", { "aria-labelledby": "stop-title", onclose: close },
    el("h1", { id: "stop-title" }, "Do you want to stop?"),
    el("p", {}, `You can stop at any time, without giving a reason. ${AFTER_STOPPING[welcome.live.withdrawal]}`),
    el("label", { for: "why" }, "If you want to, tell us why:"), why,
    row(el("button", { class: "stop", test: "withdraw-confirm", onclick: () => { net.send({ type: "withdraw", reason: why.value }); close(); waiting("One moment, please."); } }, "Stop now"),
      el("button", { class: "quiet", test: "withdraw-cancel", onclick: () => box.close() }, "Go on")));
  document.body.append(box);
  box.showModal();
}

const LABELS = { age_years: "Age in years", gender: "Gender", handedness: "Handedness" };
const CHOICES = { gender: ["female", "male", "other", "undisclosed"], handedness: ["right", "left", "both", "undisclosed"] };

const pages = {
  text: (message) => page(prose(message.text || ""), row(button("text-continue", "Continue", {}))),
  check: (message) => {
    const section = sheet();
    show(section);
    const live = welcome.live;
    checkPage(section, { rules: live.machine_check, wanted: live.view, stick, trip: () => net.roundTrip(), answer });
  },
  consent: (message) => page(prose(message.text), row(
    button("consent-agree", "I agree", { agreed: 1 }),
    el("button", { class: "quiet", test: "consent-refuse", onclick: () => answer({ agreed: 0 }) }, "I do not agree"))),
  demographics: (message) => {
    const fields = message.fields.map((name) => el("div", { class: "field" },
      el("label", { for: `field-${name}`, class: "question" }, LABELS[name] || name),
      CHOICES[name]
        ? el("select", { name, id: `field-${name}` }, el("option", { value: "" }, "no answer"), CHOICES[name].map((c) => el("option", { value: c }, c)))
        : el("input", { name, id: `field-${name}`, type: "number", min: "1", max: "130", step: "1", inputmode: "numeric" })));
    const form = el("form", { onsubmit: (event) => {
      event.preventDefault();
      const entered = {};
      for (const name of message.fields) {
        const value = form.elements[name].value;
        entered[name] = value === "" ? null : CHOICES[name] ? value : Number(value);
      }
      answer(entered);
    } }, fields, row(el("button", { test: "demographics-submit" }, "Continue")));
    page(el("h1", {}, "About you"), el("p", { class: "soft" }, "You can leave out what you do not want to tell."), form);
  },
  instructions: () => {
    const text = welcome.live.instructions && welcome.live.instructions.text;
    page(instructionsPage(text, stick, () => answer({})));
  },
  ready: (message) => page(el("h1", {}, message.resumed ? "Welcome back" : "Ready?"),
    el("p", {}, message.resumed ? "The lap goes on where it was." : "The lap begins after a short countdown."),
    row(el("button", { test: "lap-start", onclick: () => countdown(() => answer({})) }, message.resumed ? "Go on" : "Start the lap"))),
  questions: (message) => askQuestions(message.questions, welcome.live.questions, stopRow, answer, `${net.seat()} ${message.request}`),
  break: (message) => {
    const on = el("button", { disabled: true, test: "break-continue", onclick: () => answer({}) }, "Continue");
    page(el("h1", {}, "A short break"), el("p", {}, `Please rest for at least ${Math.round(message.seconds)} seconds.`), row(on));
    setTimeout(() => { on.disabled = false; announce("You can go on now."); }, 1000 * message.seconds);
  },
  debrief: (message) => page(prose(message.text), row(button("debrief-done", "Done", {}))),
};

function enterStage() {
  if (stage) return;
  stage = openStage(welcome, stick, motion, { stop: wantToStop, comfortable: () => net.send({ type: "comfortable" }) });
}
function leaveStage() {
  if (stage) { stage.close(); stage = null; }
  stick.stop();
  const box = document.querySelector("dialog");
  if (box) box.close();
}

const FAREWELL = {
  finished: "You have finished the study. You can close this page now.",
  refused: "You did not agree to take part; nothing was stored. You can close this page now.",
  unfit: "This machine or its connection is too slow for the study. Please try another one, or ask the experimenter.",
  withdrew: "You have stopped. You can close this page now.",
  ended: "The session was ended by the experimenter. You can close this page now.",
};

function goodbye({ reason, purged, completion }) {
  const parts = [el("h1", {}, "Thank you"), el("p", { test: `farewell-${reason}` }, FAREWELL[reason])];
  if (reason === "withdrew") parts.push(el("p", {}, purged ? "Everything that was recorded about you has been deleted." : AFTER_STOPPING.keep));
  if (completion && completion.code) parts.push(el("p", {}, "Your completion code: ", el("strong", { test: "completion-code" }, completion.code)));
  if (completion && completion.url) parts.push(el("p", {}, el("a", { href: completion.url, rel: "noreferrer", test: "completion-link" }, "Back to the platform")));
  show(sheet(parts));
}
