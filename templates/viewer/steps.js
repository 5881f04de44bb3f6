// Going through the steps of assembly.

function goTo(step) {
  state.step = step === null ? null : Math.max(0, Math.min(data.steps.length - 1, step));
  // The card stays only while its rod is there to be seen.
  if (state.rod !== null && !isShown(data.rods[state.rod])) state.rod = null;
  if (state.step !== null) {
    // New rods on the far side would be hidden by the others.
    const far = data.steps[state.step].rods.map((i) => data.rods[i]).find((rod) => behind(rod) > camera.size / 4);
    if (far) walkTo(far);
  }
  changed();
}

/** One step on or back; from the whole frame, back leads to the last step. */
function stepBy(by) {
  if (data.steps.length === 0) return;
  if (state.step === null) goTo(by > 0 ? 0 : data.steps.length - 1);
  else goTo(state.step + by);
}

function showStep() {
  const box = part("step");
  part("all").setAttribute("aria-pressed", String(state.step === null));
  part("slider").value = String((state.step ?? data.steps.length - 1) + 1);
  if (state.step === null) {
    box.replaceChildren(...data.guide.slice(0, 1).map((text) => make("p", {}, text)));
    return;
  }
  const step = data.steps[state.step];
  const newPart = ([number, facts, contacts], i) => make("tr", {},
    make("td", {}, rodButton(step.rods[i], number)),
    make("td", {}, facts, make("br", {}), contacts));
  box.replaceChildren(
    make("h2", {}, step.title),
    make("table", {}, make("tbody", {}, ...step.parts.map(newPart))),
    ...step.notes.map((note) => make("p", {}, note)));
}

function setUpSteps() {
  part("stepping").hidden = data.steps.length === 0;
  part("slider").max = String(Math.max(1, data.steps.length));
  part("slider").addEventListener("input", (e) => goTo(Number(e.target.value) - 1));
  part("first").addEventListener("click", () => goTo(0));
  part("back").addEventListener("click", () => stepBy(-1));
  part("forward").addEventListener("click", () => stepBy(1));
  part("all").addEventListener("click", () => goTo(null));
}
