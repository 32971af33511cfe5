// The experimenter's console: every session, the quota, and what the next participant will get.
import { el, sheet, show } from "./dom.js";
import { link } from "./link.js";
import { makeCard } from "./session-card.js";

let welcome = null;
const cards = new Map();
const net = link("experimenter", {
  welcome: (message) => { welcome = message; frame(); },
  console: update,
  lost: () => say("Connection lost, trying again. Sessions go on without this page."),
  gone: (text) => show(sheet(el("h1", {}, "Closed"), el("p", {}, text))),
});

function frame() {
  cards.clear();
  document.getElementById("main").replaceChildren(
    el("header", { class: "top" }, el("h1", {}, "Sessions"), el("p", { id: "quota", class: "soft", role: "status" })),
    el("section", { class: "top", test: "quota" },
      el("p", {}, el("strong", {}, "Next participant: "), el("span", { id: "next", test: "next-participant" }, "–")),
      el("details", {}, el("summary", {}, "Quota: orders and groups"), el("div", { class: "wide" }, el("table", { class: "lined", test: "order-table" },
        el("thead", {}, el("tr", {}, ["Group", "Order of laps", "Planned", "Finished", "Under way"].map((t) => el("th", { scope: "col" }, t)))),
        el("tbody", { id: "orders" }))))),
    el("div", { class: "console", id: "console" }));
}

function say(text) {
  const quota = document.getElementById("quota");
  if (quota) quota.textContent = text;
}

function update(message) {
  const under = message.sessions.filter((one) => ["running", "waiting"].includes(one.state)).length;
  say(`${message.finished.length} of ${message.planned} sessions finished; ${under} under way`);
  if (message.outlook) outlook(message.outlook);
  for (const session of message.sessions) {
    if (!cards.has(session.participant)) {
      const card = makeCard(session.participant, welcome.courses[session.group] || welcome.course,
        (what, text) => net.send({ type: "order", do: what, participant: session.participant, text }));
      cards.set(session.participant, card);
      document.getElementById("console").append(card.root);
    }
    cards.get(session.participant).update(session, (message.trails || {})[session.participant]);
  }
}

function outlook({ next, quota }) {
  document.getElementById("next").textContent = next
    ? `${next.participant}${given(next)}${next.free ? "" : " (no free seat now)"}`
    : "none: everyone who is planned has begun";
  document.getElementById("orders").replaceChildren(...quota.map((one) => el("tr", {},
    [one.group || "–", one.order, one.planned, one.finished, one.under_way].map((value) => el("td", {}, String(value))))));
}

function given({ group, laps }) {
  if (!laps) return ": order and group are decided when they begin";
  return `${group ? `, group ${group}` : ""}: ${laps.join(" > ")}`;
}
