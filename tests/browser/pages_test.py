# SPDX-License-Identifier: MIT
"""pages_test.py SWARMFIT [TEST...]: opens every kind of page in a real browser and uses it.

Exit code 77, and a loud word, where there is no browser (packages chromium and chromium-driver)."""

import shutil
import sys
import tempfile
import unittest

from page_case import Page
from pages import ATTACK, HOSTILE_NAME, HOSTILE_UNIT, LONG_NAME, MODELS, Pages
from player_test import Players  # noqa: F401  # its tests run with these
from webdriver import ENTER, Browser, WebDriverError, missing

SKIPPED = 77
COLUMN_OF_MODELS = 1
RANKED = "return [...document.querySelectorAll('#ranking tbody tr')].map((row) => row.cells[1].textContent.trim())"


class Reports(Page):
    def test_comparison_is_drawn(self):
        self.open_player("compare")
        charts = self.browser.run("return document.querySelectorAll('.grid figure h3').length")
        self.expect_pictures(charts, 1 + len(MODELS))
        drawings = self.browser.run("return [...document.querySelectorAll('.paper svg')].map((s) => s.getBoundingClientRect().height)")
        self.assertGreaterEqual(len(drawings), 7)
        self.assertGreater(min(drawings[:7]), 40)

    def test_fit_is_drawn(self):
        self.open_player("fit")
        self.expect_pictures(self.browser.run("return document.querySelectorAll('.canvas').length"), 2)

    def test_ranking_sorts_by_mouse_and_keyboard(self):
        self.open("compare")
        ranked = self.browser.run(RANKED)
        buttons = self.browser.find_all("#ranking thead button")
        self.browser.click(buttons[COLUMN_OF_MODELS])
        self.assertEqual(self.browser.run(RANKED), sorted(ranked))
        sorts = "return [...document.querySelectorAll('#ranking th[aria-sort]')].map((th) => th.textContent + th.ariaSort)"
        self.assertEqual(self.browser.run(sorts), ["modelascending"])
        self.browser.press(buttons[COLUMN_OF_MODELS], ENTER)
        self.assertEqual(self.browser.run(RANKED), sorted(ranked, reverse=True))
        self.assertEqual(self.browser.run(sorts), ["modeldescending"])
        self.browser.press(buttons[0], " ")
        self.assertEqual(self.browser.run(RANKED), ranked)

    def test_sorting_is_by_number(self):
        self.open("compare")
        rows = "document.querySelectorAll('#ranking tbody tr')"
        self.browser.run(rows + ".forEach((row, k) => { row.cells[2].textContent = ['9.5', '10', '−1'][k]; })")
        self.browser.click(self.browser.find("#ranking thead th:nth-child(3) button"))
        shown = self.browser.run(f"return [...{rows}].map((row) => row.cells[2].textContent)")
        self.assertEqual(shown, ["−1", "9.5", "10"])

    def test_charts_follow_the_legend(self):
        self.open("compare")
        chart = self.browser.find("#pdf-v")
        before = self.picture(chart)["print"]
        self.browser.click(self.browser.find("#legend input[data-model='0']"))
        self.assertNotEqual(self.picture(chart)["print"], before)

    # Nothing is hidden: the page never scrolls sideways, and of what is wider than its box a shadow shows, with the name of the row kept.
    def test_fits_every_screen(self):
        self.open("compare")
        for width in 1280, 1104, 420:
            self.browser.devtools("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
            wide = self.browser.run("return [...document.querySelectorAll('main > section .scroll')].filter((s) => s.scrollWidth > "
                                    "s.clientWidth + 1).map((s) => [s.ariaLabel, s.querySelector('table').className])")
            if width > 1000:
                self.assertEqual(wide, [])
            for name, look in wide:
                self.assertIn("frozen", look, name)
        kept = """
            const box = document.querySelector('#energies .scroll');
            box.scrollLeft = 150;
            return [box.scrollLeft, box.querySelector('tbody th').getBoundingClientRect().left - box.getBoundingClientRect().left];"""
        scrolled, left = self.browser.run(kept)
        self.browser.devtools("Emulation.clearDeviceMetricsOverride")
        self.assertGreater(scrolled, 50)
        self.assertLess(abs(left), 2)

    def test_several_recordings(self):
        self.open("several")
        rows = "return [...document.querySelectorAll('#ranking tbody tr')].map((row) => row.cells[0].textContent)"
        ranked = self.browser.run(rows)
        self.browser.click(self.browser.find("#ranking thead button"))
        self.assertEqual(self.browser.run(rows), sorted(ranked))
        self.browser.click(self.browser.find_all("#recordings a")[1])
        self.wait("the recording's own report", "return document.querySelector('.player .stage') !== null")

    def test_without_javascript_a_sentence(self):
        self.browser.devtools("Emulation.setScriptExecutionDisabled", value=True)
        try:
            self.open("compare")
            self.assertIn("needs JavaScript", self.browser.text(self.browser.find(".player")))
        finally:
            self.browser.devtools("Emulation.setScriptExecutionDisabled", value=False)


class OtherPages(Page):
    def test_recording_by_itself(self):
        self.open_player("describe")
        self.expect_pictures(7, 1)
        self.assertIn("swarmfit describe demo --frames 0:60 --html describe.html", self.browser.text(self.browser.find("#repeat")))
        chart = self.browser.find("#pdf-v")
        before = self.picture(chart)["print"]
        self.browser.click(self.browser.find("#log"))
        self.assertNotEqual(self.picture(chart)["print"], before)

    def test_simulation(self):
        self.open_player("simulate")
        self.expect_pictures(self.browser.run("return document.querySelectorAll('.canvas').length"), 1)
        self.assertIn("Vicsek", self.browser.text(self.browser.find("#model")))

    # All move at nearly the same speed, so colours by speed are few, and by individual twelve.
    def test_colours_tell_individuals_apart(self):
        self.open_player("simulate")
        self.scrub(10)
        self.set(".player label input[type=range]", 0)
        hues = """
            const c = document.querySelector(".stage canvas"), data = c.getContext("2d").getImageData(0, 0, c.width, c.height - 30).data, counts = {};
            for (let k = 0; k < data.length; k += 4) {
              const least = Math.min(data[k], data[k + 1], data[k + 2]), most = Math.max(data[k], data[k + 1], data[k + 2]);
              if (most - least > 30) counts[[data[k], data[k + 1], data[k + 2]]] = (counts[[data[k], data[k + 1], data[k + 2]]] || 0) + 1;
            }
            return Object.values(counts).filter((n) => n > 25).length;"""
        self.assertLessEqual(self.browser.run(hues), 7)
        self.set(".player label:nth-of-type(2) select", "track")
        self.assertGreaterEqual(self.browser.run(hues), 10)

    # Every model has a player, and only those in sight run.
    def test_gallery(self):
        self.open("gallery")
        names = self.pages.scenarios()
        self.wait("the players", "return document.querySelectorAll('.player .play').length === arguments[0]", len(names))
        self.pause()
        last = "return [...document.querySelectorAll('.player .time')].pop().textContent"
        self.assertTrue(self.browser.run(last).startswith("0.00 s"))
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('h2')].map((h) => h.textContent)"), names)
        self.expect_pictures(0, len(names))
        self.browser.run("[...document.querySelectorAll('.player')].pop().scrollIntoView()")
        self.wait("the last one to run", last.replace("return ", "return !") + ".startsWith('0.00 s')")


class Evaluations(Page):
    def test_two_side_by_side(self):
        self.open_player("evaluate")
        self.expect_pictures(7, 2)
        names = self.browser.run("return [...document.querySelectorAll('.stage figcaption')].map((c) => c.textContent.trim())")
        self.assertEqual([name.split()[0] for name in names], ["recording", "simulation"])
        self.assertIn("swarmfit evaluate demo --frames 0:60 other.csv --html evaluate.html", self.browser.text(self.browser.find("#repeat")))

    def test_charts_follow_the_legend(self):
        self.open("evaluate")
        chart = self.browser.find("#pdf-v")
        before = self.picture(chart)["print"]
        self.browser.click(self.browser.find("#legend input[data-model='0']"))
        without = self.picture(chart)["print"]
        self.assertNotEqual(without, before)
        self.browser.click(self.browser.find("#log"))
        self.assertNotEqual(self.picture(chart)["print"], without)

    # What stands in the table is what the program prints.
    def test_energies_are_those_of_the_terminal(self):
        self.open("evaluate")
        shown = self.browser.run("return [...document.querySelectorAll('#energies tbody tr')].map((row) => [row.cells[0].textContent, "
                                 "row.cells[2].textContent])")
        printed = self.pages.json("evaluate", "demo", "--frames", "0:60", "other.csv")["raw_energies"]
        self.assertEqual([energy for _, energy in shown], [f"{energy:.3f}" for energy in printed.values()])
        self.browser.click(self.browser.find("#energies thead th:nth-child(3) button"))
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('#energies tbody tr')].map((row) => row.cells[2].textContent)"),
                         sorted((energy for _, energy in shown), key=float))


# Cells of a matrix: text and whether it is shaded.
MATRIX = """
const table = document.querySelectorAll(arguments[0] + " table")[arguments[1]];
return [...table.tBodies[0].rows].map((row) => [...row.querySelectorAll("td")].slice(0, -1).map((cell) =>
  [Number(cell.textContent), getComputedStyle(cell).backgroundColor !== "rgba(0, 0, 0, 0)"]));
"""


class Studies(Page):
    # Every recording is counted once, what is counted is shaded, and the maker's own cell framed.
    def expect_matrix(self, section, recordings, which=0):
        rows = self.browser.run(MATRIX, section, which)
        for row in rows:
            self.assertEqual(sum(count for count, _ in row), recordings)
            for count, shaded in row:
                self.assertEqual(shaded, count > 0)
        framed = self.browser.run("return [...document.querySelectorAll(arguments[0] + ' .own')].every((cell) => "
                                  "getComputedStyle(cell).boxShadow !== 'none')", section)
        self.assertTrue(framed)

    def answer(self):
        return self.browser.text(self.browser.find("h1"))

    def test_recovery(self):
        self.open("recover")
        self.assertRegex(self.answer(), r"^The true model is ranked first in (all 4|\d of 4) recordings\.$")
        self.expect_matrix("#confusion", 2)
        self.assertIn("swarmfit recover --config config.toml --out NEW_FOLDER", self.browser.text(self.browser.find("#repeat")))
        self.browser.run("for (const part of document.querySelectorAll('details')) part.open = true")
        self.assertEqual(len(self.browser.find_all("#recordings tbody tr")), 4)
        self.assertIn("χ_att", self.browser.text(self.browser.find("#planted")))

    def test_parameter_recovery(self):
        self.open("recover_parameters")
        self.assertIn("brownian", self.answer())
        parameters = len(self.browser.find_all("#coverage tbody tr"))
        self.assertEqual(len(self.browser.find_all("#intervals svg.recovered")), parameters)
        spans = self.browser.run("return [...document.querySelectorAll('#intervals svg')].map((drawing) => [...drawing.querySelectorAll("
                                 "'.reach')].map((line) => line.getBoundingClientRect().height))")
        for heights in spans:
            self.assertEqual(len(heights), 3)
            self.assertGreater(max(heights), 5)
        painted = self.browser.run("return getComputedStyle(document.querySelector('svg.recovered .reach')).stroke")
        self.assertNotEqual(painted, "none")
        # Ranks of every parameter, and of all together, each a line in its band.
        self.assertEqual(len(self.browser.find_all("#calibration svg .ranks")), parameters + 1)
        look = "return ['.ranks', '.band'].map((part) => getComputedStyle(document.querySelector('#calibration svg ' + part)))"
        line, band = self.browser.run(look + ".map((style) => [style.stroke, style.fill])")
        self.assertNotEqual(line[0], "none")
        self.assertEqual(line[1], "none")
        self.assertNotEqual(band[1], "none")

    def test_power(self):
        self.open("power")
        self.assertTrue(self.answer().startswith("A recording like this one "))
        self.expect_matrix("#matrices", 2)
        pairs = "return [...document.querySelectorAll('#pairs tbody tr')].map((row) => row.cells[0].textContent)"
        self.assertEqual(self.browser.run(pairs), ["bswarm", "boids"])
        self.browser.click(self.browser.find("#pairs thead button"))
        self.assertEqual(self.browser.run(pairs), ["boids", "bswarm"])

    def test_fit_a_phone(self):
        for kind in "recover", "recover_parameters", "power", "measure", "sweep":
            self.open(kind)
            self.browser.devtools("Emulation.setDeviceMetricsOverride", width=420, height=900, deviceScaleFactor=1, mobile=False)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 420, kind)
        self.browser.devtools("Emulation.clearDeviceMetricsOverride")

    # Without a script all of it can be read.
    def test_no_script_is_needed(self):
        self.browser.devtools("Emulation.setScriptExecutionDisabled", value=True)
        try:
            self.open("power")
            self.assertIn("bswarm", self.browser.text(self.browser.find("#pairs")))
        finally:
            self.browser.devtools("Emulation.setScriptExecutionDisabled", value=False)


class Hostile(Page):
    # What was said is read, and is nothing but text: no element, no handler and no script more than on a page of harmless data.
    def expect_harmless(self, kind, like):
        counts = "return ['script', 'img', 'svg:not(.key, .place, .interval)', '[onload]', '[onerror]'].map((s) => document.querySelectorAll(s).length)"
        self.open_player(like)
        harmless = self.browser.run(counts)
        self.open_player(kind)
        with self.assertRaises(WebDriverError) as no_alert:
            self.browser.call("GET", "/alert/text")
        self.assertEqual(no_alert.exception.code, "no such alert")
        self.assertEqual(self.browser.run(counts), harmless)
        self.browser.run("for (const part of document.querySelectorAll('details')) part.open = true")
        text = self.browser.run("return document.body.innerText")
        for said in ATTACK, HOSTILE_NAME, HOSTILE_UNIT, LONG_NAME:
            self.assertIn(said, text)

    def test_report(self):
        self.expect_harmless("hostile", "compare")
        self.expect_pictures(self.browser.run("return document.querySelectorAll('.canvas').length"), 3)

    def test_recording_against_itself(self):
        self.expect_harmless("hostile_pair", "evaluate")
        self.expect_pictures(7, 2)

    def test_recording_by_itself(self):
        self.expect_harmless("hostile_recording", "describe")
        self.expect_pictures(self.browser.run("return document.querySelectorAll('.canvas').length"), 1)


if __name__ == "__main__":
    lacking = missing()
    if lacking:
        print(f"SKIPPED: no page was opened in a browser, since {' and '.join(lacking)} cannot be found; install chromium-driver")
        sys.exit(SKIPPED)
    place = tempfile.mkdtemp(prefix="swarmfit-pages-")
    Page.pages = Pages(sys.argv.pop(1), place)
    Page.browser = Browser()
    try:
        outcome = unittest.main(exit=False, verbosity=2).result
    finally:
        Page.browser.close()
        shutil.rmtree(place, ignore_errors=True)
    sys.exit(not outcome.wasSuccessful())
