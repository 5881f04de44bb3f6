#!/usr/bin/env python3
"""Drives viewer.html in a headless Chromium, as a builder would.

    check_viewer.py OUT CHROMIUM [--pictures FOLDER]

It fails on an error of the page, on any request besides the file, and where picking,
searching, stepping or printing does not show what the other files of OUT say.
"""
import argparse
import json
import math
from pathlib import Path

from playwright.sync_api import sync_playwright

FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


# Where the middle of the first rod stands in the picture, by the page's own camera.
FIRST_ROD = """() => {
  const c = document.getElementById("view"), box = c.getBoundingClientRect();
  const m = viewMatrix(box.width, box.height);
  const clip = (p) => [0, 1, 3].map((i) => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]);
  const [x, y, w] = clip(data.rods[0].a.map((v, i) => (v + data.rods[0].b[i]) / 2));
  return [box.left + (x / w + 1) / 2 * box.width, box.top + (1 - y / w) / 2 * box.height];
}"""
CAMERA = "[camera.heading, camera.height, camera.distance, ...camera.target]"


def check_picking(page):
    page.mouse.click(*page.evaluate(FIRST_ROD))
    # Another rod may stand before it: then the one that is picked is nearer.
    picked = page.locator("#card h2").inner_text()
    distance = """(id) => { const r = data.rods.find((r) => r.id === id);
      return Math.hypot(...sub(r.a.map((v, i) => (v + r.b[i]) / 2), cameraAxes().eye)); }"""
    assert picked == "R001" or page.evaluate(distance, picked) < page.evaluate(distance, "R001"), picked


def check_search(page, structure):
    for rod in structure["rods"][:: max(1, len(structure["rods"]) // 12)]:
        page.fill("#find", rod["id"])
        assert page.locator("#card h2").inner_text() == rod["id"]
        heading = page.evaluate(f"{CAMERA}[0]")
        middle = [(p + q) / 2 for p, q in zip(rod["a"], rod["b"])]
        x, y = [middle[i] - page.evaluate(f"camera.target[{i}]") for i in (0, 1)]
        assert math.hypot(x, y) < 0.2 * page.evaluate("camera.size") or (
            math.cos(heading - math.atan2(y, x)) > 0.99
        ), "a found rod lies behind the frame"
    page.fill("#find", "12")
    assert page.locator("#card h2").inner_text() == "R012"
    contact = structure["contacts"][3]
    page.fill("#find", contact["id"])
    assert page.locator("#card h2").inner_text() in (contact["over"], contact["under"])
    unit = structure["units"][0]
    page.fill("#find", unit["id"])
    assert page.locator("#card h2").inner_text() in unit["rods"]
    page.fill("#find", "R99999")
    assert page.locator("#found").inner_text() != ""
    page.fill("#find", "R012")
    mate = page.locator("#card button.rod").first
    name = mate.inner_text()
    mate.click()
    assert page.locator("#card h2").inner_text() == name


def check_steps(page, steps):
    page.click("#first")
    for number, step in enumerate(steps[:6]):
        shown = page.locator("#step button.rod").all_inner_texts()
        # A star is behind the rod that closes a circuit.
        assert [text.rstrip("*") for text in shown] == step["rods"], (number, shown)
        page.click("#forward")
    for _ in steps[6:]:
        page.click("#forward")
        hidden = "data.steps[state.step].rods.every((i) => behind(data.rods[i]) > camera.size / 4)"
        assert not page.evaluate(hidden), "new rods lie behind the frame"
    page.click("#all")
    assert page.locator("#step button.rod").count() == 0


def check_stress(page, structure):
    """Colours, bar and words of the stresses, where the statics ran; else no choice of them."""
    choice = page.locator('#colors option[value="stress"]')
    if not page.locator("script#stress").text_content():
        assert choice.count() == 0, "a choice of stresses without any"
        return
    page.focus("#colors")
    before = page.evaluate("sceneSticks().length")
    # By the keyboard: it is the last choice.
    page.keyboard.press("End")
    assert page.locator("#colors").input_value() == "stress"
    assert page.locator("#scale").is_visible() and page.locator("#bar span").count() > 0
    assert page.evaluate("sceneSticks().length") > before, "rods of one colour only"
    bar, stage = page.locator("#scale").bounding_box(), page.locator("#stage").bounding_box()
    assert bar["x"] + bar["width"] < stage["x"] + stage["width"] and bar["y"] > stage["y"], bar
    most = page.evaluate("Math.max(...stress.rods.flatMap((r) => r.along.filter((_, i) => i % 2)))")
    assert most == page.evaluate("stress.colors.length") - 1, "no rod has the darkest colour"
    hot = page.evaluate("stress.rods.findIndex((r) => r.along.some((v, i) => i % 2 && v === stress.colors.length - 1))")
    for index in (0, hot, len(structure["rods"]) - 1):
        rod = structure["rods"][index]
        page.fill("#find", rod["id"])
        text = page.locator("#card .stress").inner_text()
        assert text == page.evaluate(f"stress.rods[{index}].text") and "MPa" in text, text
        assert 0 <= page.evaluate(f"stress.rods[{index}].at") <= rod["length"] + 0.01
    page.select_option("#colors", "plain")
    assert page.locator("#scale").is_hidden()


def check_print(page):
    page.fill("#find", "R012")
    pdf = page.pdf(format="A5")
    assert pdf.startswith(b"%PDF") and page.locator("#picture").get_attribute("src").startswith("data:image/png")
    page.emulate_media(media="print")
    assert page.locator("#card").is_visible() and page.locator("#picture").is_visible()
    assert not page.locator("#stepping").is_visible() and not page.locator("#stage").is_visible()
    page.emulate_media(media="screen")
    return pdf


def check_moves(page):
    view = f"{CAMERA}.join()"
    page.focus("#view")
    for key in ["ArrowLeft", "ArrowUp", "+", "-"]:
        before = page.evaluate(view)
        page.keyboard.press(key)
        assert page.evaluate(view) != before, key
    page.keyboard.press("Home")
    home, box = page.evaluate(view), page.locator("#view").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    for button in ["left", "right"]:
        page.mouse.move(x, y)
        page.mouse.down(button=button)
        page.mouse.move(x + 40, y + 20)
        page.mouse.up(button=button)
        assert page.evaluate(view) != home, button
        page.keyboard.press("Home")
    page.mouse.wheel(0, -200)
    page.wait_for_function(f"{view} !== {json.dumps(home)}")
    page.keyboard.press("Home")


def check_touch(page):
    """A tap picks, one finger turns, two fingers move and zoom."""
    box = page.locator("#view").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    fingers = page.context.new_cdp_session(page)

    def touch(kind, *points):
        spots = [{"x": px, "y": py, "id": i} for i, (px, py) in enumerate(points)]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": spots})

    def moved(start, end):
        before = page.evaluate(CAMERA)
        touch("touchStart", *start)
        for part in (0.5, 1.0):
            touch("touchMove", *[tuple(p + part * (q - p) for p, q in zip(a, b)) for a, b in zip(start, end)])
        touch("touchEnd")
        return before, page.evaluate(CAMERA)

    before, after = moved([(x, y)], [(x + 60, y + 30)])
    assert after[0] < before[0] and after[1] > before[1] and after[2:] == before[2:], (before, after)
    before, after = moved([(x - 30, y), (x + 30, y)], [(x - 60, y), (x + 60, y)])
    assert abs(after[2] / before[2] - 0.5) < 0.05 and after[:2] == before[:2], (before, after)
    before, after = moved([(x - 30, y), (x + 30, y)], [(x - 30, y + 50), (x + 30, y + 50)])
    assert after[:2] == before[:2] and after[5] > before[5], (before, after)
    page.fill("#find", "R012")
    page.click("#home")
    page.touchscreen.tap(*page.evaluate(FIRST_ROD))
    assert page.locator("#card h2").inner_text() != "R012"


def frame_time(page):
    return page.evaluate(
        """() => { const t = performance.now(); for (let i = 0; i < 10; i++) { turn(0.05, 0); draw(); paint.finish(); }
          return (performance.now() - t) / 10; }"""
    )


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("out", type=Path)
    arguments.add_argument("chromium")
    arguments.add_argument("--pictures", type=Path)
    options = arguments.parse_args()
    structure = json.loads((options.out / "structure.json").read_text())
    steps = json.loads((options.out / "assembly.json").read_text())["steps"]
    address = (options.out / "viewer.html").resolve().as_uri()
    with sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=options.chromium, args=FLAGS)
        for name, width, height, scheme in [
            ("desktop", 1280, 800, "light"),
            ("desktop", 1280, 800, "dark"),
            ("phone", 390, 844, "light"),
            ("phone", 390, 844, "dark"),
        ]:
            page = browser.new_page(
                viewport={"width": width, "height": height}, color_scheme=scheme, has_touch=name == "phone"
            )
            faults, requests = [], []
            page.on("console", lambda m: faults.append(m.text) if m.type in ("error", "warning") else None)
            page.on("pageerror", lambda e: faults.append(str(e)))
            page.on("request", lambda r: requests.append(r.url))
            page.goto(address)
            assert page.locator("#no-webgl").is_hidden(), "no WebGL"
            assert page.evaluate("document.documentElement.scrollWidth") <= width, "wider than the screen"
            if (name, scheme) == ("desktop", "light"):
                check_picking(page)
                check_search(page, structure)
                check_steps(page, steps)
                check_moves(page)
                check_stress(page, structure)
                pdf = check_print(page)
                print(f"{len(structure['rods'])} rods: {frame_time(page):.1f} ms a picture")
            if (name, scheme) == ("phone", "light"):
                check_touch(page)
            page.fill("#find", "R012")
            if options.pictures:
                options.pictures.mkdir(parents=True, exist_ok=True)
                (options.pictures / "card.pdf").write_bytes(pdf)
                page.screenshot(path=options.pictures / f"{name}-{scheme}.png")
                page.click("#first")
                page.click("#forward")
                page.select_option("#colors", "sides")
                page.screenshot(path=options.pictures / f"{name}-{scheme}-step.png")
                if page.locator('#colors option[value="stress"]').count():
                    page.click("#all")
                    page.select_option("#colors", "stress")
                    page.screenshot(path=options.pictures / f"{name}-{scheme}-stress.png")
            # What it draws for itself, such as the picture to print, is data and no request.
            requests = [url for url in requests if not url.startswith("data:")]
            assert requests == [address], requests
            faults = [text for text in faults if "GPU stall" not in text]
            assert not faults, faults
            page.close()
        browser.close()


main()
