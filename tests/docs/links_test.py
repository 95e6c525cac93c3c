#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""No link of the manual is dead; and a dead one would be found."""
import os
import tempfile
import unittest

import links

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


class Links(unittest.TestCase):
    def test_none_is_dead(self):
        dead, followed = [], 0
        for page in links.pages(ROOT):
            for number, target in links.links(page):
                followed += 1
                what = links.fault(page, target)
                if what:
                    dead.append(f"{os.path.relpath(page, ROOT)}:{number}: {target}: {what}")
        self.assertEqual(dead, [])
        self.assertGreater(followed, 200)

    def test_dead_ones_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "page.md")
            with open(page, "w", encoding="utf-8") as file:
                file.write("# One `two`, three!\n\n[a](page.md#one-two-three) [b](#one-two-three) [c](#four) [d](none.md)\n"
                           "![e](none.png) <img src=\"none.svg\"> `[f](code.md)` [g](https://example.org/)\n\n"
                           "```\n[h](code.md)\n```\n[i [j]](none.md)\n")
            found = [target for _, target in links.links(page) if links.fault(page, target)]
            self.assertEqual(found, ["#four", "none.md", "none.png", "none.svg", "none.md"])


if __name__ == "__main__":
    unittest.main()
