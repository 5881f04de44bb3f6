// Puts the page together.
sayWords();
lookHome();
const homeTarget = camera.target.slice();
const canvas = part("view");
const paint = painter(canvas);
let waiting = false;

/** Draws before the next picture of the screen, once. */
function redraw() {
  if (!paint || waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
}

function draw() {
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((n) => Math.max(1, Math.round(n * ratio)));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  paint.draw(styleColor("--room"));
}

/** Shows what has been chosen anew. */
function changed() {
  showCard();
  showStep();
  showLegend();
  showScale();
  if (paint) paint.load(sceneSticks());
  redraw();
}

function choose(rod) {
  state.rod = rod;
  if (rod !== null && !isShown(data.rods[rod])) state.step = null;
  changed();
}

/** Takes the picture for the print view: drawn and read in one go, or it is empty. */
function takePicture() {
  if (!paint || canvas.clientWidth === 0) return;
  draw();
  part("picture").src = canvas.toDataURL("image/png");
}

part("search").addEventListener("submit", (e) => e.preventDefault());
part("find").addEventListener("input", (e) => {
  const rod = findRod(e.target.value);
  part("found").textContent = rod === null && e.target.value.trim() ? data.words["not-found"] : "";
  if (rod === null) return;
  walkTo(data.rods[rod]);
  choose(rod);
});
part("colors").addEventListener("change", (e) => { state.colors = e.target.value; changed(); });
part("ends").addEventListener("change", (e) => { state.ends = e.target.checked; changed(); });
part("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = getComputedStyle(root).colorScheme === "dark";
  root.dataset.theme = dark ? "light" : "dark";
  changed();
});
for (const [id, act] of [["closer", () => zoom(0.8)], ["farther", () => zoom(1.25)], ["home", lookHome]]) {
  part(id).addEventListener("click", () => { act(); redraw(); });
}
window.addEventListener("beforeprint", takePicture);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
new ResizeObserver(redraw).observe(canvas);
part("no-webgl").hidden = paint !== null;
setUpGestures(canvas);
setUpSteps();
setUpStress();
changed();
