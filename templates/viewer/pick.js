// Which rod a ray meets, and which one a number names.

/** The nearest shown rod that a ray passes within its radius and `slack` (a share of the
 * distance), by the closest points of two lines. */
function pick({ eye, ahead }, slack) {
  let [best, nearest] = [null, Infinity];
  data.rods.forEach((rod, index) => {
    if (!isShown(rod)) return;
    const axis = sub(rod.b, rod.a);
    const from = sub(eye, rod.a);
    const [uu, uv, vv] = [1, dot(ahead, axis), dot(axis, axis)];
    const [uw, vw] = [dot(ahead, from), dot(axis, from)];
    const det = uu * vv - uv * uv;
    const on = Math.min(1, Math.max(0, det > 1e-12 * vv ? (vw - uv * uw) / det : 0));
    const place = along(rod.a, axis, on);
    const far = dot(sub(place, eye), ahead);
    if (far <= 0) return;
    const miss = Math.hypot(...sub(place, along(eye, ahead, far)));
    const radius = (rod.d[0] + (rod.d[1] - rod.d[0]) * on) / 2;
    // A rod that is hit goes before one that is only near.
    const rank = far + (miss > radius ? (miss - radius) * 50 : 0);
    if (miss <= radius + slack * far && rank < nearest) [best, nearest] = [index, rank];
  });
  return best;
}

/** The rod of a number such as R012, 12, C0034 (its over rod) or U007 (its first rod). */
function findRod(text) {
  const found = /^\s*([RCU]?)0*(\d+)\s*$/i.exec(text);
  if (!found) return null;
  const [kind, number] = [found[1].toUpperCase() || "R", Number(found[2])];
  if (kind === "R") return data.rods[number - 1] ? number - 1 : null;
  if (kind === "U") return data.units[number - 1]?.rods[0] ?? null;
  const index = data.rods.findIndex((rod) => rod.marks.some((m) => m.side !== "U" && Number(m.contact.slice(1)) === number));
  return index < 0 ? null : index;
}
