// Round sticks with WebGL 2: one shape, drawn as often as there are sticks.

/** Flats round a stick, and numbers that a stick takes: two ends, two radii, a colour. */
const FLATS = 12;
const NUMBERS = 11;

const VERTEX = `#version 300 es
in vec4 shape;  // cosine, sine, end (0 or 1), whether it is of a cap
in vec3 a; in vec3 b; in vec2 radii; in vec3 color;
uniform mat4 view; uniform vec3 eye;
out vec3 shade; out vec3 normal; out vec3 toEye;
void main() {
  vec3 axis = normalize(b - a);
  vec3 side = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0)));
  vec3 out_ = side * shape.x + cross(axis, side) * shape.y;
  vec3 place = mix(a, b, shape.z) + out_ * mix(radii.x, radii.y, shape.z);
  normal = shape.w > 0.5 ? axis * (shape.z * 2.0 - 1.0) : normalize(out_);
  shade = color; toEye = eye - place;
  gl_Position = view * vec4(place, 1);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 shade; in vec3 normal; in vec3 toEye; out vec4 pixel;
void main() {
  vec3 n = normalize(normal);
  float facing = abs(dot(n, normalize(toEye)));
  pixel = vec4(shade * (0.45 + 0.35 * facing + 0.2 * max(n.z, 0.0)), 1);
}`;

/** The triangles of a stick: its skin and two caps. */
function stickShape() {
  const points = [];
  const at = (i, end, cap) => { const t = (2 * Math.PI * i) / FLATS; return [Math.cos(t), Math.sin(t), end, cap]; };
  for (let i = 0; i < FLATS; i++) {
    points.push(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 1, 0), at(i, 0, 0), at(i + 1, 1, 0), at(i, 1, 0));
    for (const end of [0, 1]) points.push([0, 0, end, 1], at(i, end, 1), at(i + 1, end, 1));
  }
  return new Float32Array(points.flat());
}

/** What draws sticks on a canvas; null where WebGL 2 is missing. */
function painter(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) return null;
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const shape = stickShape();
  const [shapes, sticks] = [gl.createBuffer(), gl.createBuffer()];
  gl.bindBuffer(gl.ARRAY_BUFFER, shapes);
  gl.bufferData(gl.ARRAY_BUFFER, shape, gl.STATIC_DRAW);
  attribute(gl, program, "shape", 4, 16, 0, 0);
  gl.bindBuffer(gl.ARRAY_BUFFER, sticks);
  for (const [name, size, from] of [["a", 3, 0], ["b", 3, 3], ["radii", 2, 6], ["color", 3, 8]]) {
    attribute(gl, program, name, size, NUMBERS * 4, from * 4, 1);
  }
  gl.enable(gl.DEPTH_TEST);
  const [view, eye] = ["view", "eye"].map((name) => gl.getUniformLocation(program, name));
  let count = 0;
  const load = (numbers) => {
    count = numbers.length / NUMBERS;
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.DYNAMIC_DRAW);
  };
  const draw = (ground) => {
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(view, false, viewMatrix(canvas.width, canvas.height));
    gl.uniform3fv(eye, cameraAxes().eye);
    gl.drawArraysInstanced(gl.TRIANGLES, 0, shape.length / 4, count);
  };
  // Reading a pixel back waits until all is drawn.
  const finish = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  return { load, draw, finish };
}

function attribute(gl, program, name, size, stride, from, each) {
  const place = gl.getAttribLocation(program, name);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, from);
  gl.vertexAttribDivisor(place, each);
}
