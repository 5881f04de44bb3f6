// The card of the picked rod.

/** A button that picks a rod. */
function rodButton(index, text) {
  const button = make("button", { type: "button", class: "rod" }, text);
  button.addEventListener("click", () => choose(index));
  return button;
}

function markTable(rod) {
  const heads = ["mark", "from-a", null, "mate", "angle", "lies"];
  const figures = new Set(["from-a", "angle"]);
  const head = heads.map((key) => make("th", figures.has(key) ? { class: "figure" } : {}, key ? data.words[key] : ""));
  const row = (m) => make("tr", {},
    make("td", { class: "key" }, m.letter),
    make("td", { class: "figure key" }, m.at),
    make("td", { class: "key" }, m.side),
    make("td", { class: "whole" }, rodButton(m.mate, data.rods[m.mate].id), ` ${m.text}`),
    make("td", { class: "figure" }, m.angle),
    make("td", {}, m.clock, make("br", {}), m.word));
  return make("table", {}, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...rod.marks.map(row)));
}

function showCard() {
  const card = part("card");
  if (state.rod === null) {
    card.replaceChildren(make("p", { class: "quiet" }, data.words.hint));
    return;
  }
  const rod = data.rods[state.rod];
  const print = make("button", { type: "button", id: "print" }, data.words.print);
  print.addEventListener("click", () => window.print());
  const facts = [rod.class, rod.placed].filter(Boolean).join(" · ");
  card.replaceChildren(
    make("h2", {}, rod.id),
    make("p", { class: "cut" }, `${rod.cut}, ${rod.diameter}`),
    make("p", { class: "quiet" }, facts),
    ...(stress ? [make("p", { class: "stress" }, stress.rods[state.rod].text)] : []),
    markTable(rod),
    ...rod.foot.map((line) => make("p", {}, line)),
    print);
}
