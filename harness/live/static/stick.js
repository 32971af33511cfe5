// Keyboard, gamepad and touch as one stick. Keys ramp; gamepad and touch have a dead zone.
const KEYS = { ArrowUp: [1, 0], KeyW: [1, 0], ArrowDown: [-1, 0], KeyS: [-1, 0],
  ArrowLeft: [0, 1], KeyA: [0, 1], ArrowRight: [0, -1], KeyD: [0, -1] };
const RAMP_S = 0.25, DEAD = 0.12, EVERY_MS = 40;

export function makeStick(send, options = {}) {
  const held = new Set();
  const stick = { f: 0, l: 0, clutch: false, device: "keyboard", frames: 0, n: 0, touch: null, toggle: false };
  let last = performance.now(), timer = null;

  const typing = (event) => /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
  addEventListener("keydown", (event) => {
    if (typing(event)) return;
    if (event.code in KEYS) { held.add(event.code); stick.device = "keyboard"; event.preventDefault(); }
    if (event.code === "Space" && options.clutch) {
      event.preventDefault();
      if (options.clutch === "toggle") { if (!event.repeat) stick.clutch = !stick.clutch; } else stick.clutch = true;
    }
  });
  addEventListener("keyup", (event) => {
    held.delete(event.code);
    if (event.code === "Space" && options.clutch === "hold") stick.clutch = false;
  });
  addEventListener("blur", () => { held.clear(); if (options.clutch === "hold") stick.clutch = false; });
  document.addEventListener("visibilitychange", () => { if (document.hidden) held.clear(); });

  function gamepad() {
    const pads = navigator.getGamepads ? [...navigator.getGamepads()].filter(Boolean) : [];
    if (!pads.length) return null;
    const [x, y] = pads[0].axes;
    const zone = (v) => (Math.abs(v) < DEAD ? 0 : Math.sign(v) * (Math.abs(v) - DEAD) / (1 - DEAD));
    return { f: -zone(y || 0), l: -zone(x || 0), pressed: pads[0].buttons.some((b) => b.pressed) };
  }

  function read() {
    const now = performance.now(), step = (now - last) / 1000 / RAMP_S;
    last = now;
    const attentive = !document.hidden && document.hasFocus();
    const pad = gamepad();
    if (!pad && stick.device === "gamepad") { stick.device = "keyboard"; stick.f = stick.l = 0; } // unplugged: no ramp
    if (stick.touch) { stick.f = stick.touch.f; stick.l = stick.touch.l; stick.device = "touch"; }
    else if (pad && (pad.f || pad.l || pad.pressed || stick.device === "gamepad")) {
      stick.f = pad.f; stick.l = pad.l; stick.device = "gamepad";
      if (options.clutch === "hold") stick.clutch = pad.pressed;
    } else {
      let f = 0, l = 0;
      for (const code of held) { f += KEYS[code][0]; l += KEYS[code][1]; }
      const towards = (now_, goal) => now_ + Math.max(-step, Math.min(step, Math.sign(goal) - now_));
      stick.f = towards(stick.f, f); stick.l = towards(stick.l, l);
    }
    if (!attentive) { stick.f = 0; stick.l = 0; }
    const one = (v) => Math.max(-1, Math.min(1, Math.round(v * 1e4) / 1e4));
    stick.n += 1;
    send({ type: "input", n: stick.n, sent: performance.timeOrigin ? now : now, f: one(stick.f),
      l: one(stick.l), c: stick.clutch, dev: stick.device, frames: Math.min(stick.frames, 1000), att: attentive });
    stick.frames = 0;
  }

  return {
    state: stick, held,
    start() { if (!timer) { last = performance.now(); timer = setInterval(read, EVERY_MS); } },
    stop() { clearInterval(timer); timer = null; stick.f = stick.l = 0; held.clear(); },
    gamepad,
    bindPad(pad) {
      const knob = pad.firstElementChild;
      const move = (event) => {
        const box = pad.getBoundingClientRect(), r = box.width / 2;
        let x = (event.clientX - box.left - r) / r, y = (event.clientY - box.top - r) / r;
        const size = Math.hypot(x, y); if (size > 1) { x /= size; y /= size; }
        const zone = (v) => (Math.abs(v) < DEAD ? 0 : v);
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
      if (now && picture.t === now.t) { now = picture; return; } // the same moment, told again
      before = now && picture.t > now.t ? now : null; now = picture; at = performance.now();
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
