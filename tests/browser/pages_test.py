# SPDX-License-Identifier: MIT
"""pages_test.py SWARMFIT [TEST...]: opens every kind of page in a real browser and uses it.

Exit code 77, and a loud word, where there is no browser (packages chromium and chromium-driver)."""

import shutil
import sys
import tempfile
import time
import unittest

from pages import ATTACK, HOSTILE_NAME, HOSTILE_UNIT, LONG_NAME, MODELS, Pages
from webdriver import Browser, WebDriverError, missing, reference
from webdriver import END, ENTER, HOME, RIGHT, UP

SKIPPED = 77
COLUMN_OF_MODELS = 1

# What is on a canvas: the share of pixels that are not of the commonest colour, how many colours there are, and a number for all of it.
PICTURE = """
const canvas = arguments[0], data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
const counts = new Map();
let print = 2166136261;
for (let k = 0; k < data.length; k += 4) {
  const colour = (data[k] << 24) | (data[k + 1] << 16) | (data[k + 2] << 8) | data[k + 3];
  counts.set(colour, (counts.get(colour) || 0) + 1);
  print = Math.imul(print ^ colour, 16777619);
}
return { painted: 1 - 4 * Math.max(...counts.values()) / data.length, colours: counts.size, print, page: [data[0], data[1], data[2]] };
"""
# Pixels of every moving picture that differ clearly from what `keep` saw.
PIXELS = """
const all = [...document.querySelectorAll(".stage canvas")].map((c) => c.getContext("2d").getImageData(0, 0, c.width, c.height).data);
"""
KEEP = PIXELS + "window.kept = all;"
CHANGED = PIXELS + """
return all.map((now, which) => {
  const was = window.kept[which];
  if (was.length !== now.length) return now.length;
  let changed = 0;
  for (let k = 0; k < now.length; k += 4)
    changed += Math.max(Math.abs(now[k] - was[k]), Math.abs(now[k + 1] - was[k + 1]), Math.abs(now[k + 2] - was[k + 2])) > 40;
  return changed;
});
"""
SAME, OTHER = 3, 25  # pixels: at most, at least
RANKED = "return [...document.querySelectorAll('#ranking tbody tr')].map((row) => row.cells[1].textContent.trim())"


class Page(unittest.TestCase):
    """One browser and one folder of pages for all tests."""

    pages = None
    browser = None
    urls = {}

    @classmethod
    def url(cls, kind):
        if kind == "flat":
            cls.url("several")
        if kind not in Page.urls:
            Page.urls[kind] = getattr(Page.pages, kind)()
        return Page.urls[kind]

    def open(self, kind):
        self.browser.console()
        self.browser.media()
        self.browser.open(self.url(kind))

    def tearDown(self):
        said = [line for line in self.browser.console() if "willReadFrequently" not in line]  # these tests look at canvases often
        self.assertEqual(said, [], "the console should be silent")

    def picture(self, canvas):
        return self.browser.run(PICTURE, reference(canvas))

    def keep(self):
        self.browser.run(KEEP)

    def expect_changed(self, what):
        for pixels in self.browser.run(CHANGED):
            self.assertGreaterEqual(pixels, OTHER, what)
        self.keep()

    def expect_unchanged(self, what):
        for pixels in self.browser.run(CHANGED):
            self.assertLessEqual(pixels, SAME, what)

    def wait(self, what, script, *arguments):
        for _ in range(100):
            if self.browser.run(script, *arguments):
                return
            time.sleep(0.1)
        self.fail(f"waited in vain for {what}")

    # Opens a page and stops its player, which waits for nobody else.
    def open_player(self, kind):
        self.open(kind)
        self.wait("the player", "return document.querySelector('.player .play') !== null")
        self.browser.run("document.querySelector('.player').scrollIntoView()")
        self.pause()

    def pause(self):
        self.wait("the player to run by itself", "return document.querySelector('.player .play').textContent === 'Pause'")
        self.browser.click(self.browser.find(".player .play"))

    def set(self, selector, value):
        self.browser.run("const e = document.querySelector(arguments[0]); e.value = arguments[1]; e.dispatchEvent(new Event('input'))",
                         selector, value)

    def scrub(self, frame):
        self.set(".player input[aria-label=Time]", frame)

    def time_shown(self):
        return self.browser.text(self.browser.find(".player .time"))

    # Every chart and every moving picture shows something.
    def expect_pictures(self, charts, films):
        drawn = self.browser.find_all(".canvas canvas")
        self.assertEqual(len(drawn), charts)
        for canvas in drawn:
            self.assertGreater(self.picture(canvas)["painted"], 0.005)
        stages = self.browser.find_all(".stage canvas")
        self.assertEqual(len(stages), films)
        for canvas in stages:
            shown = self.picture(canvas)
            self.assertGreater(shown["painted"], 0.003)
            self.assertGreater(shown["colours"], 20)


class Reports(Page):
    def test_comparison_is_drawn(self):
        self.open_player("compare")
        charts = self.browser.run("return document.querySelectorAll('figure h3').length") + 4
        self.expect_pictures(charts, 1 + len(MODELS))

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

    # In every column of numbers, so that some have different orders as text.
    def test_sorting_is_by_number(self):
        self.open("compare")
        values = "return [...document.querySelectorAll('#ranking tbody tr')].map((row) => parseFloat(row.cells[arguments[0]].textContent))"
        orders = set()
        for column in range(2, self.browser.run("return document.querySelector('#ranking tr').cells.length")):
            if not self.browser.find_all(f"#ranking thead th:nth-child({column + 1}) button"):
                continue
            self.browser.click(self.browser.find(f"#ranking thead th:nth-child({column + 1}) button"))
            shown = self.browser.run(values, column)
            self.assertEqual(shown, sorted(shown), column)
            orders.add(tuple(shown) == tuple(sorted(shown, key=str)))
        self.assertIn(False, orders, "no column tells numbers from text")

    def test_charts_follow_the_legend(self):
        self.open("compare")
        chart = self.browser.find("#energy-chart")
        before = self.picture(chart)["print"]
        self.browser.click(self.browser.find("#legend input[data-model='0']"))
        self.assertNotEqual(self.picture(chart)["print"], before)

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


class Players(Page):
    def test_runs_by_itself_and_stops(self):
        self.open_player("compare")
        stopped = self.time_shown()
        self.keep()
        time.sleep(0.5)
        self.assertEqual(self.time_shown(), stopped)
        self.expect_unchanged("stopped")
        self.browser.click(self.browser.find(".player .play"))
        self.wait("time to pass", "return document.querySelector('.player .time').textContent !== arguments[0]", stopped)
        time.sleep(0.5)
        self.browser.click(self.browser.find(".player .play"))
        self.expect_changed("played")

    def test_scrubs_all_films_together(self):
        self.open_player("compare")
        self.scrub(0)
        self.keep()
        self.assertIn("0.00 s", self.time_shown())
        self.scrub(50)
        self.assertIn("1.00 s", self.time_shown())
        self.browser.run("window.first = window.kept")
        self.expect_changed("scrubbed")
        self.scrub(0)
        self.browser.run("window.kept = window.first")
        self.expect_unchanged("scrubbed back")

    # All start where the recording does; a simulation is another film from there on.
    def test_films_differ(self):
        self.open_player("compare")
        self.scrub(50)
        self.browser.run(KEEP + "window.kept = window.kept.map((_, k) => window.kept[(k + 1) % window.kept.length])")
        self.expect_changed("the next film")

    def test_orbit_zoom_and_reset(self):
        self.open_player("compare")
        self.scrub(30)
        canvas, stage = self.browser.find(".stage canvas"), self.browser.find(".player .stage")
        self.keep()
        self.browser.run("window.first = window.kept")
        self.browser.drag(canvas, 60, 25)
        self.expect_changed("dragged")
        self.browser.press(stage, RIGHT + UP)
        self.expect_changed("turned by keys")
        self.browser.press(stage, "++")
        self.expect_changed("zoomed by keys")
        self.browser.wheel(canvas, 200)
        self.expect_changed("zoomed by the wheel")
        self.browser.press(stage, "0")
        self.browser.run("window.kept = window.first")
        self.expect_unchanged("as at first")

    def test_keys(self):
        self.open_player("compare")
        stage = self.browser.find(".player .stage")
        for key, shown in (HOME, "frame 0"), (".", "frame 1"), (".", "frame 2"), (",", "frame 1"), (END, "frame 60"):
            self.browser.press(stage, key)
            self.assertTrue(self.time_shown().endswith(shown), (key, self.time_shown()))
        self.browser.press(stage, " ")
        self.assertEqual(self.browser.text(self.browser.find(".player .play")), "Pause")
        self.browser.press(stage, " ")
        self.assertEqual(self.browser.text(self.browser.find(".player .play")), "Play")

    def test_colour_and_tails(self):
        self.open_player("compare")
        self.scrub(40)
        self.keep()
        self.browser.run("window.first = window.kept")
        colour = ".player label:nth-of-type(2) select"
        self.set(colour, "track")
        self.expect_changed("coloured by individual")
        self.assertFalse(self.browser.run("return document.querySelector('.key-of-colours').checkVisibility()"))
        self.set(colour, "speed")
        self.browser.run("window.kept = window.first")
        self.expect_unchanged("coloured by speed")
        self.set(".player label input[type=range]", 0)
        self.expect_changed("without tails")
        self.scrub(10)
        self.expect_changed("heads alone")

    # A line and its length in the lower left corner; in space, the axes in the lower right one.
    def test_scale_bar_and_axes(self):
        ink = """
            const c = arguments[0], at = c.width * arguments[1], data = c.getContext("2d").getImageData(at, c.height - 40, c.width / 4, 38).data;
            let dark = 0;
            for (let k = 0; k < data.length; k += 4) dark += data[k] + data[k + 1] + data[k + 2] < 450;
            return dark;"""
        for kind, axes in ("compare", True), ("flat", False):
            self.open_player(kind)
            self.scrub(0)
            canvas = reference(self.browser.find(".stage canvas"))
            self.assertGreater(self.browser.run(ink, canvas, 0), 50, "scale")
            if axes:
                self.assertGreater(self.browser.run(ink, canvas, 0.74), 20, "axes")

    # From above: no turning, arrows move; a gap is a hole in a tail, and who is not seen is not drawn.
    def test_flat_recording(self):
        self.open_player("flat")
        self.scrub(30)
        self.expect_pictures(self.browser.run("return document.querySelectorAll('.canvas').length"), 1 + len(MODELS))
        self.keep()
        self.browser.press(self.browser.find(".player .stage"), RIGHT)
        self.expect_changed("moved")
        self.assertEqual(self.browser.run("return document.querySelector('.stage').getAttribute('aria-label').includes('turn')"), False)

    def test_dark_and_print(self):
        self.open_player("compare")
        canvas = self.browser.find(".stage canvas")
        self.assertEqual(self.picture(canvas)["page"], [255, 255, 255])
        self.browser.media(prefers_color_scheme="dark")
        self.wait("the dark", "return arguments[0].getContext('2d').getImageData(0, 0, 1, 1).data[0] < 60", reference(canvas))
        self.browser.media("print", prefers_color_scheme="dark")
        self.wait("paper", "return arguments[0].getContext('2d').getImageData(0, 0, 1, 1).data[0] === 255", reference(canvas))
        self.assertGreater(self.picture(canvas)["painted"], 0.003)
        self.assertEqual(self.browser.run("return getComputedStyle(document.querySelector('.player .controls')).display"), "none")

    def test_says_what_it_is(self):
        self.open_player("compare")
        names = self.browser.run("return [...document.querySelectorAll('.stage canvas')].map((c) => c.getAttribute('aria-label'))")
        self.assertEqual(sorted(names), sorted(f"Moving picture: {name}" for name in ["recording", *MODELS]))
        unnamed = self.browser.run("""return [...document.querySelectorAll(".player input, .player select, .player button, .player canvas")]
            .filter((e) => !e.getAttribute("aria-label") && !e.closest("label") && !e.textContent.trim()).length""")
        self.assertEqual(unnamed, 0)

    def test_reduced_motion_waits_for_the_reader(self):
        self.browser.console()
        self.browser.media(prefers_reduced_motion="reduce")
        self.browser.open(self.url("compare"))
        self.wait("the player", "return document.querySelector('.player .play') !== null")
        self.browser.run("document.querySelector('.player').scrollIntoView()")
        time.sleep(1)
        self.assertEqual(self.browser.text(self.browser.find(".player .play")), "Play")
        self.assertIn("frame 0", self.time_shown())
        self.assertGreater(self.picture(self.browser.find(".stage canvas"))["painted"], 0.003)


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
        names = self.pages.models()
        self.wait("the players", "return document.querySelectorAll('.player .play').length === arguments[0]", len(names))
        self.pause()
        last = "return [...document.querySelectorAll('.player .time')].pop().textContent"
        self.assertTrue(self.browser.run(last).startswith("0.00 s"))
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('h2')].map((h) => h.textContent)"), names)
        self.expect_pictures(0, len(names))
        self.browser.run("[...document.querySelectorAll('.player')].pop().scrollIntoView()")
        self.wait("the last one to run", last.replace("return ", "return !") + ".startsWith('0.00 s')")


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
