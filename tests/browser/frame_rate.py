# SPDX-License-Identifier: MIT
"""frame_rate.py SWARMFIT   how many pictures a second the player draws of a thousand agents, and of as many round a mesh of ten thousand
facets, without a graphics card.

No test: what it prints depends on the machine and on what else runs there. docs/reports.md has the figures."""

import math
import re
import shutil
import sys
import tempfile
import time

from pages import Pages
from webdriver import Browser

SECONDS = 4
CROWD = ["simulate", "brownian", "--agents", "1000", "--frames", "60", "--fps", "60", "--box", "0", "--start-radius", "8"]
SCENE = """
title = "A crowd round a ball"
model = "boids"
agents = 1000
frames = 60
fps = 20
bounds = {shape = "box", lower = [-8, -8, -8], upper = [8, 8, 8]}
[[obstacle]]
shape = "mesh"
file = "ball.obj"
"""
RATE = """
const done = arguments[arguments.length - 1], start = performance.now();
let pictures = 0;
const next = (now) => (++pictures, now - start > 1000 * arguments[0] ? done(1000 * pictures / (now - start)) : requestAnimationFrame(next));
requestAnimationFrame(next);
"""


def ball(rings):
    """A ball of radius 2 as OBJ: 4 rings (rings - 1) facets."""
    around = 2 * rings
    polar = [(math.pi * i / rings, math.pi * k / rings) for i in range(1, rings) for k in range(around)]
    corners = [(0, 0, 2), *((2 * math.sin(p) * math.cos(a), 2 * math.sin(p) * math.sin(a), 2 * math.cos(p)) for p, a in polar), (0, 0, -2)]
    at = lambda i, k: 2 + (i - 1) * around + k % around
    facets = []
    for k in range(around):
        facets += [(1, at(1, k), at(1, k + 1)), (len(corners), at(rings - 1, k + 1), at(rings - 1, k))]
        for i in range(1, rings - 1):
            facets += [(at(i, k), at(i + 1, k), at(i + 1, k + 1)), (at(i, k), at(i + 1, k + 1), at(i, k + 1))]
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners] + [f"f {a} {b} {c}" for a, b, c in facets]
    return "\n".join(lines) + "\n", len(facets)


def rate(browser, url):
    """Pictures, how many pixels, and how often they are drawn: the player draws as often as the browser lets it."""
    browser.open(url)
    while browser.run("return document.querySelector('.player .play') === null"):
        time.sleep(0.1)
    browser.run("document.querySelector('.player').scrollIntoView()")
    time.sleep(2)
    assert browser.run("return document.querySelector('.player .play').textContent") == "Pause"
    films = browser.run("const all = [...document.querySelectorAll('.stage canvas')]; return [all.length, all[0].width, all[0].height]")
    return films, browser.run_async(RATE, SECONDS)


def main():
    place = tempfile.mkdtemp(prefix="swarmfit-rate-")
    pages, browser = Pages(sys.argv[1], place), Browser(size=(1280, 1000))
    try:
        pages.run(*CROWD, "--html", "1.html")
        page = (pages.folder / "1.html").read_text()
        before, takes, after = re.split(r'(?<="takes":\[)(.*?\})(?=\])', page, maxsplit=1)
        for films in 1, 2, 6:
            (pages.folder / f"{films}.html").write_text(before + ",".join([takes] * films) + after)
            (films, width, height), found = rate(browser, pages.url(f"{films}.html"))
            print(f"{films} × 1000 agents, {width} × {height} pixels each: {found:.0f} pictures a second")
        mesh, facets = ball(50)
        (pages.folder / "ball.obj").write_text(mesh)
        (pages.folder / "ball.toml").write_text(SCENE)
        pages.run("simulate", "ball.toml", "--html", "ball.html")
        (_, width, height), found = rate(browser, pages.url("ball.html"))
        print(f"1000 agents round {facets} facets, {width} × {height} pixels: {found:.0f} pictures a second")
    finally:
        browser.close()
        shutil.rmtree(place, ignore_errors=True)


if __name__ == "__main__":
    main()
