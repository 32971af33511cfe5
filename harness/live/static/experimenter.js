import { el, show } from "./dom.js";
import { link } from "./link.js";
import { drawPlan, drawStick, sized } from "./plan.js";

let welcome = null;
const cards = new Map();
const net = link("experimenter", {
  welcome: (message) => { welcome = message; cards.clear(); show(el("div", { class: "top" }, el("h1", {}, "Sessions"), el("p", { id: "quota", class: "soft" })), el("div", { class: "console", id: "console" })); },
  console: update, lost: () => state("connection lost, trying again"), gone: (text) => show(el("section", { class: "sheet" }, el("p", {}, text))),
});
function state(text) { const quota = document.getElementById("quota"); if (quota) quota.textContent = text; }
function order(participant, what, text = "") { net.send({ type: "order", do: what, participant, text }); }
function reason(what) { return window.prompt(`Reason for: ${what}`, "") ?? null; }

function card(name) {
  const plan = el("canvas", { "aria-label": "Plan with trail" }), time = el("canvas", { class: "time", "aria-label": "p(h) and variance over time" });
  const facts = el("p", { class: "soft" }), log = el("table"), note = el("input", { test: "note-text", placeholder: "note", maxlength: "2000" });
  const act = (label, what, test, kind = "quiet", ask = false) => el("button", { class: kind, test, onclick: () => {
    const text = ask ? reason(label) : ""; if (text !== null) order(name, what, text);
  } }, label);
  const root = el("section", { class: "card", test: `session-${name}` }, el("h2", {}, name), facts, plan, time,
    el("div", { class: "row" }, act("Pause", "pause", "lap-pause"), act("Resume", "resume", "lap-resume"), act("Stop lap", "stop", "lap-stop", "quiet", true),
      act("Repeat lap", "repeat", "lap-repeat", "quiet", true), act("EMERGENCY STOP", "emergency", "emergency-stop", "stop")),
    el("div", { class: "row" }, act("Skip", "skip", "stage-skip", "quiet", true), act("End session", "end", "session-end", "quiet", true), act("Withdraw", "withdraw", "session-withdraw", "quiet", true)),
    el("div", { class: "row" }, note, el("button", { test: "note-save", onclick: () => { if (note.value) { order(name, "note", note.value); note.value = ""; } } }, "Save note")), log);
  document.getElementById("console").append(root);
  const made = { root, plan, time, facts, log, history: [] };
  cards.set(name, made);
  return made;
}

function update(message) {
  state(`${message.finished.length} of ${message.planned} sessions finished; ${message.sessions.filter((s) => s.state === "running").length} under way`);
  for (const session of message.sessions) {
    const c = cards.get(session.participant) || card(session.participant);
    const ms = (s) => (s === null || s === undefined ? "–" : `${Math.round(1000 * s)} ms`);
    c.facts.textContent = `${session.state} · ${session.stage || "–"}${session.lap === null ? "" : ` ${session.lap}`} ${session.condition ? `(${session.condition})` : ""}`
      + `${session.paused.length ? " · PAUSED" : ""} · participant ${session.connected.participant ? "here" : "away"}, demonstrator ${session.connected.demonstrator ? "here" : "away"}`
      + ` · round trip ${ms(session.round_trip_s.participant)} · late ${ms(session.late_s)} · input age ${ms(session.input_age_s)}`;
    c.log.replaceChildren(...session.events.slice().reverse().map((e) => el("tr", {}, el("td", {}, e.utc.slice(11, 19)), el("td", {}, e.actor), el("td", {}, e.event), el("td", {}, e.note || ""))));
    if (session.pose) {
      const last = c.history[c.history.length - 1];
      if (last && session.t < last[0]) c.history = [];
      c.history.push([session.t, session.p_help, session.variance]); if (c.history.length > 900) c.history.shift();
      drawPlan(c.plan, welcome.course, session.pose, { trail: message.trails[session.participant], helped: session.control !== "driver" });
      const [pen] = [c.plan.getContext("2d")], h = c.plan.clientHeight;
      drawStick(pen, 34, h - 34, 26, session.intent, "#1f5fa8");
      if (session.demonstrator) drawStick(pen, 100, h - 34, 26, session.demonstrator, "#b3541e");
      drawTime(c.time, c.history);
    }
  }
}

function drawTime(canvas, history) {
  const [pen, w, h] = sized(canvas); pen.clearRect(0, 0, w, h);
  if (history.length < 2) return;
  const t0 = history[0][0], t1 = Math.max(history[history.length - 1][0], t0 + 10), x = (t) => 34 + (w - 44) * (t - t0) / (t1 - t0);
  pen.strokeStyle = "#cfd6df"; pen.fillStyle = "#5b6675"; pen.font = "11px system-ui";
  for (const p of [0, 0.5, 1]) { const y = h - 18 - (h - 30) * p; pen.beginPath(); pen.moveTo(34, y); pen.lineTo(w - 10, y); pen.stroke(); pen.fillText(String(p), 8, y + 4); }
  pen.fillText("p(h), and variance dashed, over lap time in s", 38, 10); pen.fillText(`${t0.toFixed(0)}`, 34, h - 4); pen.fillText(`${t1.toFixed(0)} s`, w - 34, h - 4);
  const most = Math.max(...history.map((r) => r[2] || 0), 1e-6);
  for (const [k, colour, dash, scale] of [[1, "#2b7a4b", [], 1], [2, "#7a5ba8", [4, 3], 1 / most]]) {
    pen.strokeStyle = colour; pen.setLineDash(dash); pen.beginPath();
    history.forEach((r, i) => { if (r[k] === null || r[k] === undefined) return; const y = h - 18 - (h - 30) * r[k] * scale; if (i) pen.lineTo(x(r[0]), y); else pen.moveTo(x(r[0]), y); });
    pen.stroke(); pen.setLineDash([]);
  }
}
