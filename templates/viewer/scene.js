// What is shown: which sticks, in which colours.

/** What the reader has chosen; `step` is null for the whole frame. */
const state = { rod: null, step: null, colors: "plain", ends: true };

/** Okabe-Ito, for classes in turn and for the signs of contacts. */
const PALETTE = ["#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7"].map(hex);
const [OVER, UNDER, BORDER, INNER] = ["#d55e00", "#0072b2", "#cc79a7", "#009e73"].map(hex);
const [PICKED, MATE, NEW, END_A, PROP] = ["#e6007a", "#f0c000", "#e07b00", "#d00000", "#7a7f85"].map(hex);

const isShown = (rod) => state.step === null || (rod.step !== null && rod.step <= state.step);
const isNew = (rod) => state.step !== null && rod.step === state.step;
const blend = (a, b) => a.map((x, i) => (x + b[i]) / 2);

/** The colour of a rod, and whether it is to be seen at half strength. */
function rodColor(index, mates, look) {
  const rod = data.rods[index];
  if (index === state.rod) return PICKED;
  if (mates.has(index)) return MATE;
  let color = look.wood;
  if (state.colors === "border") color = rod.border ? BORDER : INNER;
  if (state.colors === "classes") color = PALETTE[rod.k % PALETTE.length];
  if (isNew(rod)) return state.colors === "plain" || state.colors === "sides" ? NEW : color;
  return state.step === null ? color : blend(color, look.room);
}

/** The numbers of all sticks, for the painter. */
function sceneSticks() {
  const look = { wood: styleColor("--wood"), room: styleColor("--room"), floor: styleColor("--floor") };
  const numbers = [];
  const stick = (a, b, ra, rb, color) => numbers.push(...a, ...b, ra, rb, ...color);
  floor(stick, look);
  const mates = new Set(state.rod === null ? [] : data.rods[state.rod].marks.map((m) => m.mate));
  data.rods.forEach((rod, index) => {
    if (!isShown(rod)) return;
    const axis = unit(sub(rod.b, rod.a));
    const length = Math.hypot(...sub(rod.b, rod.a));
    const [ra, rb] = rod.d.map((d) => d / 2);
    const faint = (color) => (state.step === null || isNew(rod) ? color : blend(color, look.room));
    const sleeve = (from, to, color) => stick(along(rod.a, axis, from), along(rod.a, axis, to), ra * 1.06, ra * 1.06, faint(color));
    if (state.colors === "stress") {
      const radius = (at) => ra + ((rb - ra) * at) / length;
      for (const [from, to, color] of stretches(index)) {
        stick(along(rod.a, axis, from), along(rod.a, axis, to), radius(from), radius(to), faint(color));
      }
      if (index === state.rod) {
        // Its colours stay: rings at the ends say that it is picked, a dark one where it is stressed most.
        for (const at of [ra * 4, length - ra * 4]) sleeve(at - ra, at + ra, PICKED);
        const { at } = stress.rods[index];
        sleeve(at - ra / 2, at + ra / 2, DARKEST);
      }
    } else stick(rod.a, rod.b, ra, rb, rodColor(index, mates, look));
    if (state.ends) sleeve(-0.02 * ra, Math.min(ra * 3, length / 4), END_A);
    if (state.colors === "stress" || (state.colors !== "sides" && index !== state.rod)) return;
    for (const m of rod.marks) {
      if (m.side !== "E") sleeve(m.x - ra, m.x + ra, m.side === "O" ? OVER : UNDER);
    }
  });
  if (state.step !== null) {
    for (const prop of data.steps[state.step].props) {
      const r = data.rods[0].d[0] / 3;
      stick([prop.point[0], prop.point[1], prop.point[2] - prop.height], prop.point, r, r, PROP);
    }
  }
  return numbers;
}

/** The ground, and a disc below each foot. */
function floor(stick, look) {
  const [x, y] = homeTarget;
  const thick = camera.size / 400;
  stick([x, y, data.ground - thick], [x, y, data.ground], camera.size * 1.25, camera.size * 1.25, look.floor);
  for (const [fx, fy, fz] of data.feet) {
    const r = data.rods[0].d[0] * 1.6;
    stick([fx, fy, fz], [fx, fy, fz + thick], r, r, blend(look.floor, PROP));
  }
}

/** What the colours mean. */
function showLegend() {
  const meanings = {
    plain: [],
    sides: [[OVER, "over"], [UNDER, "under"]],
    border: [[BORDER, "border-rod"], [INNER, "inner-rod"]],
    classes: [],
    stress: [],
  }[state.colors].slice();
  if (state.ends) meanings.push([END_A, "end-a"]);
  const entry = ([color, word]) => {
    const box = make("i", { "aria-hidden": "true" });
    box.style.background = `rgb(${color.map((x) => Math.round(x * 255)).join()})`;
    return make("span", {}, box, data.words[word]);
  };
  part("legend").replaceChildren(...meanings.map(entry));
}
