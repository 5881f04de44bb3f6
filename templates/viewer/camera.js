// The camera: it looks at a target from a heading, a height angle and a distance; z is up.
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (a, b, t) => [a[0] + b[0] * t, a[1] + b[1] * t, a[2] + b[2] * t];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const l = Math.hypot(...a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };

/** Tangent of half the angle of view, the shorter way of the picture. */
const OPENING = Math.tan(Math.PI / 10);
const STEEPEST = Math.PI / 2 - 0.01;

const camera = { target: [0, 0, 0], heading: 0, height: 0, distance: 1, size: 1 };

/** The whole frame, seen as it was at first. */
function lookHome() {
  const low = [0, 1, 2].map((i) => data.rods.reduce((m, r) => Math.min(m, r.a[i], r.b[i]), Infinity));
  const high = [0, 1, 2].map((i) => data.rods.reduce((m, r) => Math.max(m, r.a[i], r.b[i]), -Infinity));
  camera.target = [0, 1, 2].map((i) => (low[i] + high[i]) / 2);
  camera.size = Math.hypot(...sub(high, low)) / 2;
  camera.distance = (camera.size * 0.85) / Math.sin(Math.atan(OPENING));
  camera.heading = -Math.PI / 3;
  camera.height = Math.PI / 6;
}

/** Walks round the frame to the side where a rod lies, and looks at it from above. */
function walkTo(rod) {
  const [x, y] = [0, 1].map((i) => (rod.a[i] + rod.b[i]) / 2 - camera.target[i]);
  if (Math.hypot(x, y) > camera.size / 20) camera.heading = Math.atan2(y, x);
  camera.height = Math.max(camera.height, Math.PI / 6);
}

/** How far behind the middle of the frame a rod lies as it is looked at, mm. */
function behind(rod) {
  return dot(sub(along(rod.a, sub(rod.b, rod.a), 0.5), camera.target), cameraAxes().ahead);
}

/** Eye, and the unit vectors ahead, to the right and up. */
function cameraAxes() {
  const [c, s] = [Math.cos(camera.height), Math.sin(camera.height)];
  const out = [Math.cos(camera.heading) * c, Math.sin(camera.heading) * c, s];
  const right = [-Math.sin(camera.heading), Math.cos(camera.heading), 0];
  return { eye: along(camera.target, out, camera.distance), ahead: out.map((x) => -x), right, up: cross(out, right) };
}

function turn(dx, dy) {
  camera.heading -= dx;
  camera.height = Math.min(STEEPEST, Math.max(-STEEPEST, camera.height + dy));
}

/** Moves the target across the picture; 1 is the shorter way of it. */
function pan(dx, dy) {
  const { right, up } = cameraAxes();
  const reach = 2 * OPENING * camera.distance;
  camera.target = along(along(camera.target, right, -dx * reach), up, dy * reach);
}

function zoom(factor) {
  camera.distance = Math.min(camera.size * 20, Math.max(camera.size * 0.03, camera.distance * factor));
}

/** Half openings across and upright for a picture of this shape. */
function openings(width, height) {
  const shorter = Math.min(width, height) || 1;
  return [(OPENING * width) / shorter, (OPENING * height) / shorter];
}

/** The matrix from mm to clip space, by columns. */
function viewMatrix(width, height) {
  const { eye, ahead, right, up } = cameraAxes();
  const [ox, oy] = openings(width, height);
  const [near, far] = [camera.distance * 0.02 + camera.size * 0.002, camera.distance + camera.size * 12];
  const [k, m] = [(far + near) / (far - near), (-2 * far * near) / (far - near)];
  const row = (v, f) => [v[0] * f, v[1] * f, v[2] * f, -dot(v, eye) * f];
  const [x, y, w] = [row(right, 1 / ox), row(up, 1 / oy), row(ahead, 1)];
  const z = [w[0] * k, w[1] * k, w[2] * k, w[3] * k + m];
  return new Float32Array([0, 1, 2, 3].flatMap((i) => [x[i], y[i], z[i], w[i]]));
}

/** The ray through a point of the picture, in shares of its width and height from top left. */
function rayThrough(x, y, width, height) {
  const { eye, ahead, right, up } = cameraAxes();
  const [ox, oy] = openings(width, height);
  return { eye, ahead: unit(along(along(ahead, right, (2 * x - 1) * ox), up, (1 - 2 * y) * oy)) };
}
