// Mouse, fingers, wheel and keys.

/** Pixels that a finger may slip in a tap, and slack of a tap beside a rod, in pixels. */
const TAP = 8;
const BESIDE = { mouse: 3, touch: 14 };

function setUpGestures(canvas) {
  const fingers = new Map();
  let moved = 0;
  const spread = () => {
    const [p, q] = [...fingers.values()];
    return { x: (p.x + q.x) / 2, y: (p.y + q.y) / 2, wide: Math.hypot(p.x - q.x, p.y - q.y) || 1 };
  };
  const drag = (e, last) => {
    const [dx, dy] = [e.clientX - last.x, e.clientY - last.y];
    const reach = Math.min(canvas.clientWidth, canvas.clientHeight);
    moved += Math.abs(dx) + Math.abs(dy);
    const before = fingers.size === 2 ? spread() : null;
    fingers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    if (before) {
      const now = spread();
      pan((now.x - before.x) / reach, (now.y - before.y) / reach);
      zoom(before.wide / now.wide);
    } else if (e.buttons & 6 || e.shiftKey) pan(dx / reach, dy / reach);
    else turn((dx / reach) * Math.PI, (dy / reach) * Math.PI);
    redraw();
  };
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    // A tap of two fingers picks nothing.
    if (fingers.size > 1) moved = Infinity;
  });
  canvas.addEventListener("pointermove", (e) => {
    const last = fingers.get(e.pointerId);
    if (last) drag(e, last);
  });
  canvas.addEventListener("pointerup", (e) => {
    if (fingers.size === 1 && moved < TAP && e.button === 0) tap(canvas, e);
    fingers.delete(e.pointerId);
  });
  canvas.addEventListener("pointercancel", (e) => fingers.delete(e.pointerId));
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    zoom(Math.exp(Math.sign(e.deltaY) * Math.min(0.2, Math.abs(e.deltaY) / 500)));
    redraw();
  }, { passive: false });
  canvas.addEventListener("keydown", onKey);
}

function tap(canvas, e) {
  const box = canvas.getBoundingClientRect();
  const ray = rayThrough((e.clientX - box.left) / box.width, (e.clientY - box.top) / box.height, box.width, box.height);
  const pixels = BESIDE[e.pointerType === "touch" ? "touch" : "mouse"];
  choose(pick(ray, (pixels * 2 * OPENING) / Math.min(box.width, box.height)));
}

function onKey(e) {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const act = {
    ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0),
    ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1),
    "+": () => zoom(0.87), "=": () => zoom(0.87), "-": () => zoom(1.15), Home: lookHome,
    n: () => stepBy(1), p: () => stepBy(-1), a: () => goTo(null), Escape: () => choose(null),
  }[e.key];
  if (!act) return;
  e.preventDefault();
  act();
  redraw();
}
