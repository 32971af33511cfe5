// Link and machine check: frame rate, round trip, WebGL or plan, gamepad found or why not.
import { el, row } from "./dom.js";
import { hasWebGL } from "./view.js";

const FRAMES_MS = 1200, TRIPS_MS = 4000;

// Shows what was found as it is found; `answer` gets it. `trip` returns the median round trip, ms.
export async function checkPage(page, { rules, wanted, stick, trip, answer }) {
  const list = el("ul", { class: "found", role: "status" }, el("li", {}, "Checking ..."));
  const button = el("button", { test: "check-continue", disabled: true }, "Continue");
  page.append(el("h1", {}, "Your machine"),
    el("p", {}, "We look whether this machine and its connection are quick enough. Nothing is installed."), list, row(button));
  const rate = await frames();
  const roundTrip = await tripWithin(trip);
  const webgl = hasWebGL(), pad = stick.gamepad();
  const view = wanted === "first-person" && webgl ? "first-person" : "plan";
  const slow = rate < rules.min_frame_rate, far = roundTrip !== null && roundTrip > rules.max_round_trip_ms;
  list.replaceChildren(
    fact(`Pictures a second: ${rate}`, slow && `at least ${rules.min_frame_rate} are needed`),
    fact(`Round trip to the server: ${roundTrip === null ? "not measured" : `${Math.round(roundTrip)} ms`}`, far && `at most ${rules.max_round_trip_ms} ms are needed`),
    fact(webgl ? "3-D graphics (WebGL): yes" : "3-D graphics (WebGL): no; you drive by the plan"),
    fact(gamepadWords(pad)),
  );
  if (slow || far) {
    page.insertBefore(el("p", { class: "problem", role: "alert" }, rules.rule === "refuse"
      ? "This machine or connection is too slow for the study. If you go on, the study ends here."
      : "This machine or connection is slow. You can take part; it is noted."), button.parentElement);
  }
  button.disabled = false;
  button.addEventListener("click", () => answer({ frame_rate: rate, webgl: webgl ? 1 : 0, gamepad: pad ? 1 : 0, view }));
}

function fact(text, problem) {
  return el("li", { class: problem ? "bad" : "good" }, text, problem ? ` – ${problem}` : "");
}

function gamepadWords(pad) {
  if (pad) return `Gamepad: found (${pad.id.slice(0, 60)})`;
  if (!window.isSecureContext) return "Gamepad: not available over this connection (plain http); keyboard and touch work";
  if (!navigator.getGamepads) return "Gamepad: not available in this browser; keyboard and touch work";
  return "Gamepad: none found; press a button on it to wake it, or use keyboard or touch";
}

function frames() {
  return new Promise((done) => {
    let n = 0;
    const begun = performance.now();
    const tick = () => {
      n += 1;
      const t = performance.now() - begun;
      if (t < FRAMES_MS) requestAnimationFrame(tick); else done(Math.round(1000 * n / t));
    };
    requestAnimationFrame(tick);
  });
}

async function tripWithin(trip) {
  const end = performance.now() + TRIPS_MS;
  while (trip() === null && performance.now() < end) await new Promise((done) => setTimeout(done, 100));
  return trip();
}
