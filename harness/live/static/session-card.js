// One session on the console: plan with trail, sticks, curves over time, numbers, events, actions.
import { el, row } from "./dom.js";
import { COLOURS, drawPlan, drawStick } from "./plan.js";
import { drawCurves } from "./curves.js";

const SURE_MS = 4000;
const ms = (s) => (s === null || s === undefined ? "–" : `${Math.round(1000 * s)} ms`);
const HELP = "p(h) (line) and variance (dashed, as a share of its largest) over lap time";
const LINK = "Milliseconds over lap time: step late, age of the command";

export function makeCard(name, course, order) {
  const plan = el("canvas", { role: "img", "aria-label": "Plan with the driven trail, coloured by who was in control" });
  const help = el("canvas", { class: "time", role: "img", "aria-label": HELP });
  const quality = el("canvas", { class: "time", role: "img", "aria-label": LINK });
  const stage = el("p", { class: "stage-line", test: "session-stage" });
  const facts = el("dl", { class: "facts" });
  const log = el("tbody");
  const text = el("input", { test: "note-text", id: `note-${name}`, maxlength: "2000", placeholder: "note, or reason for the next action" });
  const said = () => { const value = text.value; text.value = ""; return value; };
  const act = (label, what, test, kind = "quiet") => el("button", { class: kind, test, onclick: () => order(what, said()) }, label);
  const drawn = el("div", { hidden: true }, plan, legend(), help, quality);
  const root = el("section", { class: "card", test: `session-${name}`, "aria-label": `Session ${name}` },
    el("h2", {}, name), stage,
    row(act("Emergency stop", "emergency", "emergency-stop", "stop"), act("Start lap", "start", "lap-begin"),
      act("Pause", "pause", "lap-pause"), act("Resume", "resume", "lap-resume"),
      act("Stop lap", "stop", "lap-stop"), act("Repeat lap", "repeat", "lap-repeat")),
    row(el("label", { for: `note-${name}`, class: "unseen" }, `Note or reason, session ${name}`), text,
      el("button", { class: "quiet", test: "note-save", onclick: () => { if (text.value) order("note", said()); } }, "Save note")),
    drawn, facts,
    row(act("Skip to next", "skip", "stage-skip"), sure("End session", "session-end", () => order("end", said())),
      sure("Withdraw participant", "session-withdraw", () => order("withdraw", said()))),
    el("div", { class: "wide" }, el("table", { class: "log" }, el("caption", {}, "Last events"), log)));
  let history = [];

  function update(session, trail) {
    stage.textContent = stageWords(session);
    root.classList.toggle("paused", session.paused.length > 0);
    facts.replaceChildren(...factsOf(session).flatMap(([term, value]) => [el("dt", {}, term), el("dd", {}, value)]));
    log.replaceChildren(...session.events.slice().reverse().map((event) => el("tr", {},
      [event.utc.slice(11, 19), event.lap === null ? "" : `lap ${event.lap}, step ${event.step}`, event.actor, event.event, event.note || ""]
        .map((value) => el("td", {}, value)))));
    if (trail) history = trail;
    root.classList.toggle("over", !["running", "waiting"].includes(session.state));
    drawn.hidden = !session.pose;
    if (!session.pose) return;
    drawPlan(plan, course, session.pose, { trail: history, mine: session.control !== "driver" });
    const pen = plan.getContext("2d"), h = plan.clientHeight;
    drawStick(pen, 46, h - 40, 28, session.intent, COLOURS.driver, "driver");
    if (session.demonstrator_stick) drawStick(pen, 120, h - 40, 28, session.demonstrator_stick, COLOURS.demonstrator, "demonstr.");
    drawCurves(help, history, [{ of: (r) => r[4], colour: COLOURS.model, top: 1 }, { of: (r) => r[5], colour: "#7a5ba8", dash: [4, 3] }], "p(h), variance dashed");
    drawCurves(quality, history, [{ of: (r) => r[6] === null ? null : 1000 * r[6], colour: "#b3541e", shared: true }, { of: (r) => 1000 * r[7], colour: "#1f5fa8", dash: [4, 3], shared: true }], "ms late, age of the command dashed");
  }
  return { root, update };
}

// A button that acts on the second press: for what cannot be undone.
function sure(label, test, act) {
  const button = el("button", { class: "quiet", test, onclick: () => {
    if (button.dataset.sure) { calm(); act(); return; }
    button.dataset.sure = "yes";
    button.textContent = `Really ${label.toLowerCase()}?`;
    setTimeout(calm, SURE_MS);
  } }, label);
  const calm = () => { delete button.dataset.sure; button.textContent = label; };
  return button;
}

function stageWords(session) {
  const where = session.stage ? `${session.stage}${session.lap === null ? "" : ` ${session.lap}`}` : "–";
  const condition = session.condition ? `, condition ${session.condition}` : "";
  const page = session.page ? `; the page “${session.page}” is open` : "";
  const held = session.paused.length ? `; PAUSED by ${session.paused.join(", ")}` : "";
  return `${session.state}: ${where}${condition}${page}${held}`;
}

function factsOf(session) {
  const link = (role) => session.connected[role] ? `here, round trip ${ms(session.round_trip_s[role])}` : "away";
  const driven = session.pose ? [
    ["lap time", `${session.t.toFixed(1)} s`],
    ["in control", session.control],
    ["p(h)", session.p_help === null ? "–" : session.p_help.toFixed(2)],
    ["variance", session.variance === null ? "–" : session.variance.toFixed(4)],
    ["clearance", `${session.clearance_m.toFixed(2)} m`],
    ["step late", ms(session.late_s)],
    ["age of the command", ms(session.input_age_s)],
  ] : [];
  return [["participant", link("participant")], ["demonstrator", link("demonstrator")], ...driven];
}

function legend() {
  return el("ul", { class: "legend" }, [["driver", "driver"], ["demonstrator", "demonstrator"], ["model", "model"]]
    .map(([key, label]) => el("li", { class: `control-${key}` }, `${label} in control`)));
}
