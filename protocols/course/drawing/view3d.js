// First-person view in WebGL: the room's boxes, gates, chevrons on the floor, one's own footplates.
// Eye at 1.2 m, looking at the floor ahead; vertical field of view 84 degrees, more on a narrow screen:
// there 62 degrees across are seen, or the next turn would not be.
const EYE = 1.2, AIM_AHEAD = 1.6, AIM_HEIGHT = 0.25, FOV = 84 * Math.PI / 180, ACROSS = 62 * Math.PI / 180, NEAR = 0.05, FAR = 60;
const VERTEX = `attribute vec3 p; attribute vec3 n; attribute vec3 c; uniform mat4 m; varying vec3 v; varying float d;
void main() { gl_Position = m * vec4(p, 1.0); float light = 0.78 + 0.22 * dot(n, normalize(vec3(0.35, 0.5, 0.8)));
 v = c * light; d = gl_Position.w; }`;
const FRAGMENT = `precision mediump float; varying vec3 v; varying float d;
void main() { float fog = clamp((d - 6.0) / 22.0, 0.0, 0.75); gl_FragColor = vec4(mix(v, vec3(0.87, 0.90, 0.93), fog), 1.0); }`;

export function makeView(canvas, course) {
  const gl = canvas.getContext("webgl", { antialias: true });
  if (!gl) return null;
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind); gl.shaderSource(shader, source); gl.compileShader(shader); gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  gl.enable(gl.DEPTH_TEST); gl.clearColor(0.87, 0.90, 0.93, 1);
  const room = buffer(gl, roomMesh(course)), chair = buffer(gl, chairMesh());
  const gates = course.gates.map((gate) => [buffer(gl, gateMesh(gate, [0.30, 0.58, 0.36])), buffer(gl, gateMesh(gate, [0.93, 0.55, 0.08]))]);
  const matrix = gl.getUniformLocation(program, "m");
  const places = ["p", "n", "c"].map((name) => gl.getAttribLocation(program, name));

  function draw(mesh, m) {
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
    places.forEach((place, i) => { gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 36, 12 * i); });
    gl.uniformMatrix4fv(matrix, false, m); gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
  }

  return {
    draw(pose, nextGate, w, h) {
      if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
      gl.viewport(0, 0, w, h); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      const [x, y, heading] = pose, c = Math.cos(heading), s = Math.sin(heading);
      const eye = [x - 0.1 * c, y - 0.1 * s, EYE], aim = [x + AIM_AHEAD * c, y + AIM_AHEAD * s, AIM_HEIGHT];
      const m = times(perspective(w / h), lookAt(eye, aim));
      draw(room, m);
      gates.forEach((pair, i) => draw(pair[i === nextGate ? 1 : 0], m));
      draw(chair, times(m, placed(x, y, heading)));
    },
  };
}

function buffer(gl, numbers) {
  const made = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, made); gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
  return { buffer: made, count: numbers.length / 9 };
}

function quad(out, a, b, c, d, normal, colour) { for (const p of [a, b, c, a, c, d]) out.push(...p, ...normal, ...colour); }

function box(out, cx, cy, heading, length, width, low, high, colour) {
  const cos = Math.cos(heading), sin = Math.sin(heading);
  const at = (u, v, z) => [cx + u * cos - v * sin, cy + u * sin + v * cos, z];
  const [l, w] = [length / 2, width / 2];
  const n = (u, v) => [u * cos - v * sin, u * sin + v * cos, 0];
  quad(out, at(l, -w, low), at(l, w, low), at(l, w, high), at(l, -w, high), n(1, 0), colour);
  quad(out, at(-l, w, low), at(-l, -w, low), at(-l, -w, high), at(-l, w, high), n(-1, 0), colour);
  quad(out, at(l, w, low), at(-l, w, low), at(-l, w, high), at(l, w, high), n(0, 1), colour);
  quad(out, at(-l, -w, low), at(l, -w, low), at(l, -w, high), at(-l, -w, high), n(0, -1), colour);
  quad(out, at(-l, -w, high), at(l, -w, high), at(l, w, high), at(-l, w, high), [0, 0, 1], colour);
}

function roomMesh(course) {
  const out = [];
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [cx, cy, , length, width] of course.boxes) {
    const r = Math.hypot(length, width) / 2;
    x0 = Math.min(x0, cx - r); x1 = Math.max(x1, cx + r); y0 = Math.min(y0, cy - r); y1 = Math.max(y1, cy + r);
  }
  for (let x = Math.floor(x0) - 1; x < x1 + 1; x++) for (let y = Math.floor(y0) - 1; y < y1 + 1; y++) {
    const tone = (x + y) % 2 ? 0.74 : 0.79;
    quad(out, [x, y, 0], [x + 1, y, 0], [x + 1, y + 1, 0], [x, y + 1, 0], [0, 0, 1], [tone, tone * 0.97, tone * 0.92]);
  }
  for (const [cx, cy, heading, length, width, height, name] of course.boxes) {
    const wall = height > 1.5;
    box(out, cx, cy, heading, length, width, 0, Math.min(height, 2.4), wall ? [0.85, 0.87, 0.90] : [0.62, 0.52, 0.42]);
  }
  return out;
}

function gateMesh([, left, right], colour) {
  const out = [], dx = left[0] - right[0], dy = left[1] - right[1], length = Math.hypot(dx, dy);
  for (const [px, py] of [left, right]) box(out, px, py, 0, 0.06, 0.06, 0, 1.6, colour);
  const heading = Math.atan2(dy, dx), mx = (left[0] + right[0]) / 2, my = (left[1] + right[1]) / 2;
  box(out, mx, my, heading, length, 0.04, 1.55, 1.65, colour);
  // A chevron on the floor shows the direction: forward is to the right of right-to-left.
  const f = [dy / length, -dx / length], s = [dx / length, dy / length];
  for (const back of [0.25, 0.7]) {
    const at = (along, across) => [mx + f[0] * (along - back) + s[0] * across, my + f[1] * (along - back) + s[1] * across, 0.012];
    for (const side of [-1, 1]) quad(out, at(0.15, 0), at(0, 0), at(-0.25, side * 0.3), at(-0.1, side * 0.3), [0, 0, 1], colour);
  }
  return out;
}

function chairMesh() {
  const out = [], dark = [0.2, 0.22, 0.26];
  box(out, 0.52, 0.13, 0, 0.2, 0.18, 0.08, 0.13, dark); box(out, 0.52, -0.13, 0, 0.2, 0.18, 0.08, 0.13, dark);
  box(out, 0.16, 0.25, 0, 0.36, 0.06, 0.58, 0.64, dark); box(out, 0.16, -0.25, 0, 0.36, 0.06, 0.58, 0.64, dark);
  box(out, 0.34, -0.25, 0, 0.05, 0.05, 0.64, 0.72, [0.75, 0.2, 0.15]);
  return out;
}

function perspective(aspect) {
  const f = 1 / Math.max(Math.tan(FOV / 2), Math.tan(ACROSS / 2) / aspect), r = 1 / (NEAR - FAR);
  return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (FAR + NEAR) * r, -1, 0, 0, 2 * FAR * NEAR * r, 0];
}

function lookAt(eye, aim) {
  const sub = (a, b) => a.map((v, i) => v - b[i]), unit = (a) => { const n = Math.hypot(...a); return a.map((v) => v / n); };
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
  const z = unit(sub(eye, aim)), x = unit(cross([0, 0, 1], z)), y = cross(z, x);
  return [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1];
}

function placed(x, y, heading) {
  const c = Math.cos(heading), s = Math.sin(heading);
  return [c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, x, y, 0, 1];
}

function times(a, b) {
  const out = new Array(16).fill(0);
  for (let i = 0; i < 4; i++) for (let j = 0; j < 4; j++) for (let k = 0; k < 4; k++) out[4 * j + i] += a[4 * k + i] * b[4 * j + k];
  return out;
}
