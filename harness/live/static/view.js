// The first-person view where the browser has WebGL: in a worker where it can, else on the page.
import { makeView } from "./view3d.js";

let webgl = null;

export function hasWebGL() {
  if (webgl === null) {
    try { webgl = Boolean(document.createElement("canvas").getContext("webgl")); } catch { webgl = false; }
  }
  return webgl;
}

// Returns what draws on a canvas; null where there is no WebGL. `counted` is told of pictures drawn.
export function openView(canvas, course, counted) {
  if (!hasWebGL()) return null;
  const size = () => {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
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
