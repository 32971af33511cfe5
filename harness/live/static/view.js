// The first-person view where the browser has WebGL: in a worker where it can, else on the page.
import { makeView } from "./view3d.js";

let webgl = null;

export function hasWebGL() {
  if (webgl === null) {
    try { webgl = Boolean(document.createElement("canvas").getContext("webgl")); } catch { webgl = false; }
  }
  return webgl;
}

const SLOW = 20, COARSEST = 0.3;

// Returns what draws on a canvas; null where there is no WebGL. `tell` is told of pictures drawn.
// Where fewer than SLOW are drawn a second, such as without a graphics card, they become coarser.
export function openView(canvas, course, tell) {
  if (!hasWebGL()) return null;
  let share = 1, since = Infinity, drawn = 0;  // counted from the first picture: loading takes its time
  const counted = (n) => { since = Math.min(since, performance.now()); drawn += n; tell(n); };
  const size = () => {
    const now = performance.now();
    if (now - since > 1000) {
      if (drawn < SLOW && now - since < 2000) share = Math.max(0.7 * share, COARSEST);  // else it was hidden
      since = now; drawn = 0;
    }
    const scale = share * Math.min(window.devicePixelRatio || 1, 2);
    return [Math.round(canvas.clientWidth * scale), Math.round(canvas.clientHeight * scale)];
  };
  if (canvas.transferControlToOffscreen && window.Worker) {
    const worker = new Worker("/static/view3d-worker.js", { type: "module" });
    worker.onmessage = (event) => { if (event.data.drawn) counted(event.data.drawn); };
    const off = canvas.transferControlToOffscreen();
    worker.postMessage({ canvas: off, course }, [off]);
    return {
      draw(pose, gate) { const [w, h] = size(); worker.postMessage({ pose, gate, w, h }); },
      close() { worker.terminate(); },
    };
  }
  const view = makeView(canvas, course);
  return view && { draw(pose, gate) { view.draw(pose, gate, ...size()); counted(1); }, close() {} };
}
