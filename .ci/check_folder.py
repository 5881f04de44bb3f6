#!/usr/bin/env python3
"""Opens an output folder with other people's readers.

usage: check_folder.py TOOLS OUT [--everything]

Khronos' glTF validator (0 errors, 0 warnings), qpdf, pdftotext (every rod number is
found), ezdxf (nothing to mend; a circle at every foot; jigs closed and on their layers),
rsvg-convert on every SVG (with
--everything, else on the first). Exit status 0 when all are content. To be run by a
Python that has ezdxf.
"""
import csv
import json
import pathlib
import re
import subprocess
import sys

import ezdxf

VALIDATE = """
const fs = require('fs'), validator = require('gltf-validator');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))
  .then(r => console.log(JSON.stringify(r.issues)));
"""


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr.decode(errors='replace')}")
    return done.stdout


def check_glb(tools, file):
    issues = json.loads(run("node", "-e", VALIDATE, str(file.resolve()), cwd=tools))
    if issues["numErrors"] or issues["numWarnings"]:
        sys.exit(f"{file}: {json.dumps(issues['messages'][:5], indent=1)}")


def check_pdfs(out, rods):
    for file in sorted(out.glob("*.pdf")):
        said = run("qpdf", "--check", file)
        if b"No syntax or stream encoding errors" not in said:
            sys.exit(f"{file}: {said.decode(errors='replace')}")
    text = run("pdftotext", "-layout", out / "sheets.pdf", "-").decode()
    words = set(re.findall(r"R\d{3,}", text))
    missing = [r for r in rods if r not in words]
    if missing:
        sys.exit(f"{out}/sheets.pdf does not name {missing[:5]}")


def check_dxf(file, structure):
    drawing = ezdxf.readfile(file)
    audit = drawing.audit()
    if audit.errors or audit.fixes:
        sys.exit(f"{file}: {[e.message for e in (audit.errors + audit.fixes)[:5]]}")
    if (drawing.dxfversion, drawing.header["$INSUNITS"]) != ("AC1015", 4):
        sys.exit(f"{file}: not release 2000 in mm")
    # A file that lost its end passes the audit, so everything is counted.
    supports = structure["supports"]
    count = {}
    for entity in drawing.modelspace():
        key = entity.dxftype(), entity.dxf.layer
        count[key] = count.get(key, 0) + 1
    feet = len(supports)
    for key, expected in {
        ("CIRCLE", "FEET"): feet,
        ("LINE", "CENTRES"): 2 * feet,
        ("LINE", "HEADINGS"): feet,
        ("LWPOLYLINE", "HEADINGS"): feet,
        ("LINE", "CHORDS"): {0: 0, 1: 0, 2: 1}.get(feet, feet),
        ("LINE", "TITLE"): 3,
    }.items():
        if count.get(key, 0) != expected:
            sys.exit(f"{file}: {count.get(key, 0)} of {key}, not {expected}")
    circles = drawing.modelspace().query('CIRCLE[layer=="FEET"]')
    numbers = {t.dxf.text for t in drawing.modelspace().query('TEXT[layer=="NUMBERS"]')}
    for circle, support in zip(circles, supports):
        away = [abs(a - b) for a, b in zip(circle.dxf.center, support["point"][:2])]
        if max(away) > 1e-6 or support["rod"] not in numbers:
            sys.exit(f"{file}: the foot of {support['rod']} is off by {away} or has no number")
    low, high = drawing.header["$EXTMIN"], drawing.header["$EXTMAX"]
    for circle in circles:
        center, radius = circle.dxf.center, circle.dxf.radius
        if not all(low[i] <= center[i] - radius <= center[i] + radius <= high[i] for i in (0, 1)):
            sys.exit(f"{file}: {center} lies outside the extent {low} to {high}")


def check_jigs(file, sheets):
    """Sheets for a laser: closed cuts, the layers and colours of the trade, nothing twice."""
    drawing = ezdxf.readfile(file)
    audit = drawing.audit()
    if audit.errors or audit.fixes:
        sys.exit(f"{file}: {[e.message for e in (audit.errors + audit.fixes)[:5]]}")
    header = drawing.header
    if (drawing.dxfversion, header["$INSUNITS"], header["$MEASUREMENT"]) != ("AC1015", 4, 1):
        sys.exit(f"{file}: not release 2000 in mm")
    colors = {"CUT": 1, "SCORE": 5, "ENGRAVE": 7, "GUIDE": 8}
    seen, references = set(), 0
    for entity in drawing.modelspace():
        layer, kind = entity.dxf.layer, entity.dxftype()
        if layer not in colors or drawing.layers.get(layer).dxf.color != colors[layer]:
            sys.exit(f"{file}: layer {layer}")
        if kind == "CIRCLE":
            continue
        if kind != "LWPOLYLINE" or (layer != "SCORE" and not entity.closed):
            sys.exit(f"{file}: an open line or a {kind} on {layer}")
        points = [tuple(round(v, 4) for v in p) for p in entity.get_points("xy")]
        if layer == "SCORE" and entity.closed:
            sides = sorted({round(max(v) - min(v), 4) for v in zip(*points)})
            references += sides == [10.0, 100.0]
        for a, b in zip(points, points[1:] + points[:1] * entity.closed):
            if a == b or frozenset((a, b)) in seen:
                sys.exit(f"{file}: {a} to {b} is of no length or drawn twice")
            seen.add(frozenset((a, b)))
    if references != sheets:
        sys.exit(f"{file}: {references} reference rectangles")


def check_svgs(files):
    for file in files:
        # Drawn small: what matters is that every element is understood.
        run("rsvg-convert", "--zoom", "0.2", file)


def main():
    tools, out = (pathlib.Path(a) for a in sys.argv[1:3])
    with open(out / "rods.csv", newline="", encoding="utf-8") as f:
        rods = [row["id"] for row in csv.DictReader(f)]
    for model in sorted(out.glob("*.glb")):
        check_glb(tools, model)
    check_pdfs(out, rods)
    structure = json.loads((out / "structure.json").read_text(encoding="utf-8"))
    check_dxf(out / "support-map.dxf", structure)
    single = sorted(out.glob("jigs/*.dxf"))
    for file in single:
        check_jigs(file, 1)
    if (out / "jigs.dxf").exists():
        check_jigs(out / "jigs.dxf", max(1, len(single)))
    svgs = sorted(out.rglob("*.svg"))
    check_svgs(svgs if "--everything" in sys.argv else svgs[:1])
    print(f"{out}: {len(rods)} rods, model, papers and {len(svgs)} drawings read well")


if __name__ == "__main__":
    main()
