// Keyboard, gamepad and touch as one stick. Keys ramp, from START on so that a press is felt at once;
// gamepad and touch have a dead zone.
export const KEYS = { ArrowUp: [1, 0], KeyW: [1, 0], ArrowDown: [-1, 0], KeyS: [-1, 0],
  ArrowLeft: [0, 1], KeyA: [0, 1], ArrowRight: [0, -1], KeyD: [0, -1] };
const RAMP_S = 0.25, START = 0.3, DEAD = 0.12, EVERY_MS = 20;

// What lies within the dead zone is nothing; the rest goes from 0 to full.
const zone = (v) => (Math.abs(v) < DEAD ? 0 : Math.sign(v) * (Math.abs(v) - DEAD) / (1 - DEAD));

// What keys hold ramps towards its goal; a press from rest begins at START.
function towards(value, goal, step) {
  const from = goal && value * goal >= 0 ? goal * Math.max(value * goal, START) : value;
  return from + Math.max(-step, Math.min(step, goal - from));
}

export function makeStick(send, options = {}) {
  const held = new Set();
  const stick = { f: 0, l: 0, clutch: false, device: "keyboard", frames: 0, n: 0, touch: null, blocked: false };
  const clutch = { key: false, button: false, pad: false, switched: false };
  let last = performance.now(), timer = null, sending = false;

  const typing = (event) => /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
  const isClutch = (event) => event.code === "Space" && options.clutch;
  addEventListener("keydown", (event) => {
    if (!timer || stick.blocked || typing(event)) return;
    if (event.code in KEYS) {
      event.preventDefault();
      held.add(event.code);
      stick.device = "keyboard";
      if (!event.repeat) read();
    }
    if (isClutch(event)) { event.preventDefault(); if (!event.repeat) press("key", true); }
  });
  addEventListener("keyup", (event) => {
    held.delete(event.code);
    if (timer && isClutch(event) && !typing(event)) { event.preventDefault(); press("key", false); }
  });
  addEventListener("blur", letGo);
  document.addEventListener("visibilitychange", () => { if (document.hidden) letGo(); });

  function letGo() {
    held.clear();
    stick.touch = null;
    Object.assign(clutch, { key: false, button: false, pad: false, switched: false });
  }

  // One source of the clutch is pressed or let go; a switch turns at each press.
  function press(source, down) {
    if (down && !clutch[source]) clutch.switched = !clutch.switched;
    clutch[source] = down;
  }

  function gamepad() {
    const pads = navigator.getGamepads ? [...navigator.getGamepads()] : [];
    const pad = pads.find((one) => one && one.connected !== false && one.axes.length > 1);
    if (!pad) return null;
    return { f: -zone(pad.axes[1]), l: -zone(pad.axes[0]), pressed: pad.buttons.some((b) => b.pressed), id: pad.id };
  }

  function steer(step) {
    const pad = gamepad();
    if (options.clutch) press("pad", Boolean(pad && pad.pressed));
    if (!pad && stick.device === "gamepad") { stick.device = "keyboard"; stick.f = stick.l = 0; }  // unplugged: no ramp
    if (stick.touch) {
      stick.f = stick.touch.f; stick.l = stick.touch.l; stick.device = "touch";
    } else if (pad && (pad.f || pad.l || pad.pressed || stick.device === "gamepad") && !held.size) {
      stick.f = pad.f; stick.l = pad.l; stick.device = "gamepad";
    } else {
      let f = 0, l = 0;
      for (const code of held) { f += KEYS[code][0]; l += KEYS[code][1]; }
      stick.f = towards(stick.f, Math.sign(f), step); stick.l = towards(stick.l, Math.sign(l), step);
    }
  }

  function read() {
    const now = performance.now(), step = (now - last) / 1000 / RAMP_S;
    last = now;
    const attentive = !document.hidden && document.hasFocus();
    steer(step);
    if (!attentive || stick.blocked) { letGo(); stick.f = 0; stick.l = 0; }
    stick.clutch = options.clutch === "toggle" ? clutch.switched : clutch.key || clutch.button || clutch.pad;
    if (!sending) return;
    const one = (v) => Math.max(-1, Math.min(1, Math.round(v * 1e4) / 1e4));
    stick.n += 1;
    send({ type: "input", n: stick.n, sent: now, f: one(stick.f), l: one(stick.l), c: stick.clutch,
      dev: stick.device, frames: Math.min(stick.frames, 1000), att: attentive });
    stick.frames = 0;
  }

  return {
    state: stick, held, gamepad, press,
    // Reads the devices; what they say is sent, or only tried.
    start(sends = true) {
      sending = sends;
      if (!timer) { last = performance.now(); timer = setInterval(read, EVERY_MS); }
    },
    stop() { clearInterval(timer); timer = null; letGo(); stick.f = stick.l = 0; stick.clutch = false; },
    bindPad(pad) {
      const knob = pad.firstElementChild;
      const move = (event) => {
        const box = pad.getBoundingClientRect(), r = box.width / 2;
        let x = (event.clientX - box.left - r) / r, y = (event.clientY - box.top - r) / r;
        const size = Math.hypot(x, y);
        if (size > 1) { x /= size; y /= size; }
        stick.touch = { f: -zone(y), l: -zone(x) };
        knob.style.transform = `translate(${x * 45}px, ${y * 45}px)`;
      };
      const leave = () => { stick.touch = { f: 0, l: 0 }; knob.style.transform = ""; };
      pad.addEventListener("pointerdown", (event) => { pad.setPointerCapture(event.pointerId); move(event); });
      pad.addEventListener("pointermove", (event) => { if (event.buttons) move(event); });
      pad.addEventListener("pointerup", leave);
      pad.addEventListener("pointercancel", leave);
    },
  };
}

// Draws between two pictures: the display is faster than the control step.
export function makeMotion(period) {
  let before = null, now = null, at = 0;
  return {
    put(picture) {
      if (now && picture.t === now.t) { now = picture; return; }  // the same moment, told again
      before = now && picture.t > now.t ? now : null;
      now = picture;
      at = performance.now();
    },
    pose() {
      if (!now) return null;
      if (!before) return now.pose;
      const share = Math.min((performance.now() - at) / 1000 / period, 1);
      const turn = Math.atan2(Math.sin(now.pose[2] - before.pose[2]), Math.cos(now.pose[2] - before.pose[2]));
      return [before.pose[0] + share * (now.pose[0] - before.pose[0]),
        before.pose[1] + share * (now.pose[1] - before.pose[1]), before.pose[2] + share * turn];
    },
    get picture() { return now; },
  };
}
