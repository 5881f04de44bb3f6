// The data, the words, and short ways to the parts of the page.
const data = JSON.parse(document.getElementById("data").textContent);
const part = (id) => document.getElementById(id);

/** An element with attributes and children; text is never read as HTML. */
function make(name, attributes, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** Puts the words of the papers' language on the page. */
function sayWords() {
  for (const e of document.querySelectorAll("[data-say]")) e.textContent = data.words[e.dataset.say];
  for (const e of document.querySelectorAll("[data-label]")) {
    e.setAttribute("aria-label", data.words[e.dataset.label]);
    if (e.localName === "button") e.title = data.words[e.dataset.label];
  }
  for (const e of document.querySelectorAll("[data-hint]")) e.placeholder = data.words[e.dataset.hint];
}

/** A colour of the style sheet, `#rrggbb`, as three numbers from 0 to 1. */
function styleColor(name) {
  return hex(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
}

function hex(text) {
  return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
}
