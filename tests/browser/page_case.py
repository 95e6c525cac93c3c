# SPDX-License-Identifier: MIT
"""What all tests of pages share: one browser, one folder of pages, and ways to look at canvases."""

import time
import unittest

from webdriver import reference

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
