// Notes in a participant's page, for each key pressed, how many seconds pass until a turn is drawn.
// The plan is drawn in the frame that tells the pose; the first-person view is drawn by a worker,
// which tells how many pictures it has drawn: the next one is waited for (apart = true).
// What counts as seen: one pixel of a first-person view of 1280 pixels.
const SEEN_RAD = 0.001;
const key = { pressed: null, heading: 0, drawn: null, took: [] };

addEventListener("keydown", (event) => {
  const { pose } = document.body.dataset;
  if (event.repeat || !pose) return;
  Object.assign(key, { pressed: performance.now(), heading: JSON.parse(pose)[2], drawn: null });
}, true);

requestAnimationFrame(function look() {
  requestAnimationFrame(look);
  if (!document.body || key.pressed === null) return;
  const { pose, drawn } = document.body.dataset;
  if (key.drawn === null && Math.abs(JSON.parse(pose)[2] - key.heading) >= SEEN_RAD) {
    key.drawn = apart ? Number(drawn) : -1;
  }
  if (key.drawn !== null && Number(drawn) > key.drawn) {
    key.took.push((performance.now() - key.pressed) / 1000);
    key.pressed = null;
    document.body.dataset.took = JSON.stringify(key.took);
  }
});
