// Stresses, where the statics ran: colours along the rods and the bar that tells them.
const stress = JSON.parse(part("stress").textContent || "null");
const STRESS_COLORS = (stress?.colors ?? []).map(hex);
const DARKEST = hex("#000000");

/** The stretches of a rod: from, to (mm from end A), and the colour. */
function stretches(index) {
  const { along } = stress.rods[index];
  const found = [];
  for (let i = 0; i < along.length; i += 2) found.push([i ? along[i - 2] : 0, along[i], STRESS_COLORS[along[i + 1]]]);
  return found;
}

/** The bar of the colours, while they are shown. */
function showScale() {
  part("scale").hidden = state.colors !== "stress";
  if (!stress || part("bar").children.length > 0) return;
  part("scale-title").textContent = stress.title;
  part("bar").style.background = `linear-gradient(to right, ${stress.colors.join()})`;
  part("bar").replaceChildren(...stress.ticks.map(([at, text]) => {
    const tick = make("span", {}, text);
    tick.style.left = `${100 * at}%`;
    return tick;
  }));
}

/** The choice of these colours is there only with stresses. */
function setUpStress() {
  if (!stress) part("colors").querySelector('[value="stress"]').remove();
}
