// Draws the first-person view away from the page's own thread: where WebGL is done in software,
// drawing there would hold up the stick's messages.
import { makeView } from "./view3d.js";

let view = null, news = null;

function loop() {
  if (news) { view.draw(news.pose, news.gate, news.w, news.h); news = null; postMessage({ drawn: 1 }); }
  requestAnimationFrame(loop);
}

onmessage = (event) => {
  const message = event.data;
  if (message.canvas) {
    view = makeView(message.canvas, message.course);
    postMessage({ ready: Boolean(view) });
    if (view) requestAnimationFrame(loop);
  } else news = message;
};
