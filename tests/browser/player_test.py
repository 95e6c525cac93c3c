# SPDX-License-Identifier: MIT
"""The player of a report, used as a reader would."""

import math
import time

from page_case import KEEP, Page
from pages import MODELS
from webdriver import END, HOME, RIGHT, UP, reference


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

    # A stimulus is where it is at that time, and obstacles stand still.
    def test_shows_what_surrounds(self):
        where = """
            const c = document.querySelector(".stage canvas"), data = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
            const [red, green, blue] = arguments[0];
            let x = 0, y = 0, n = 0;
            for (let k = 0; k < data.length; k += 4)
              if (data[k] === red && data[k + 1] === green && data[k + 2] === blue) x += k / 4 % c.width, y += Math.floor(k / 4 / c.width), ++n;
            return [x / n / c.width, y / n / c.height, n];"""
        predator = [0xC2, 0x18, 0x5B]
        self.open_player("predator")
        self.set(".player label input[type=range]", 0)
        self.scrub(10)
        self.assertEqual(self.browser.run(where, predator)[2], 0)
        self.scrub(45)
        left, above, pixels = self.browser.run(where, predator)
        self.assertGreater(pixels, 40)
        self.scrub(85)
        right, still_above, _ = self.browser.run(where, predator)
        self.assertGreater(right, left + 0.3)
        self.assertAlmostEqual(above, still_above, delta=0.02)
        self.assertIn("repels", self.browser.text(self.browser.find(".key-of-signs")))
        self.assertIn("obstacle", self.browser.text(self.browser.find(".key-of-signs")))

    # A group that travels is followed from the start, and then stays in the middle; in its box it crosses the picture.
    def test_follows_the_group(self):
        ink = """
            const c = document.querySelector(".stage canvas"), data = c.getContext("2d").getImageData(0, 0, c.width, c.height - 40).data;
            let x = 0, y = 0, n = 0;
            for (let k = 0; k < data.length; k += 4)
              if (Math.max(data[k], data[k + 1], data[k + 2]) - Math.min(data[k], data[k + 1], data[k + 2]) > 60) x += k / 4 % c.width, y += Math.floor(k / 4 / c.width), ++n;
            return [x / n / c.width, y / n / c.width];"""
        self.open_player("flock")
        self.set(".player label input[type=range]", 0)
        box = ".player input[type=checkbox]"
        self.assertTrue(self.browser.run(f"return document.querySelector('{box}').checked"))
        self.scrub(0)
        middle = self.browser.run(ink)
        for frame in 120, 239:
            self.scrub(frame)
            self.assertLess(math.dist(self.browser.run(ink), middle), 0.06)
        self.browser.click(self.browser.find(box))
        self.scrub(0)
        start = self.browser.run(ink)
        self.scrub(239)
        self.assertGreater(math.dist(self.browser.run(ink), start), 0.25)

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
        self.assertIn("frame 30", self.time_shown(), "the middle of the film, where tails can be seen")
        self.assertGreater(self.picture(self.browser.find(".stage canvas"))["painted"], 0.003)
