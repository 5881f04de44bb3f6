#!/usr/bin/env python3
"""Opens an output folder with other people's readers.

usage: check_folder.py TOOLS OUT [--everything]

Khronos' glTF validator (0 errors, 0 warnings), qpdf, pdftotext (every rod number is
found), rsvg-convert on every SVG (with --everything, else on the first). Exit status 0
when all are content.
"""
import csv
import json
import pathlib
import re
import subprocess
import sys

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


def check_svgs(files):
    for file in files:
        # Drawn small: what matters is that every element is understood.
        run("rsvg-convert", "--zoom", "0.2", file)


def main():
    tools, out = (pathlib.Path(a) for a in sys.argv[1:3])
    with open(out / "rods.csv", newline="", encoding="utf-8") as f:
        rods = [row["id"] for row in csv.DictReader(f)]
    check_glb(tools, out / "model.glb")
    check_pdfs(out, rods)
    svgs = sorted(out.rglob("*.svg"))
    check_svgs(svgs if "--everything" in sys.argv else svgs[:1])
    print(f"{out}: {len(rods)} rods, model, papers and {len(svgs)} drawings read well")


if __name__ == "__main__":
    main()
