#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the pages of the manual promise beside their links: every page can be found, every warning has its cure, one version everywhere."""
import os
import re
import unittest

import links
import words

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def content(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


class Pages(unittest.TestCase):
    def test_every_suspicion_of_describe_has_its_heading(self):
        names = re.findall(r"Suspicion\{\s*\"([^\"]+)\"", content("libeval", "suspicions.cpp"))
        self.assertGreaterEqual(len(names), 10)
        for name in names:
            self.assertIn(f"\n### {name}\n", content("docs", "how-to", "warnings.md"))

    def test_every_warning_that_has_a_cure_is_given(self):
        said = " ".join(text for path in words.sources() for _, text in words.strings(path))
        cures = content("docs", "how-to", "warnings.md").partition('## In `compare` and `fit`: "Warnings"')[2]
        names = re.findall(r"^\| \*\*([^*]+)\*\*", cures, flags=re.M)
        self.assertGreaterEqual(len(names), 25)
        for name in names:
            for part in re.split(r" N |[…:]|\bv, a,", name):  # what stands for a number or a name
                self.assertTrue(part.strip().rstrip(".") in said, f"no warning says: {part}")

    def test_one_word_for_one_thing(self):
        gone = re.compile(r"\b(maker|planted|alike|told apart|blew up|goes with|one of both|differenced across)\b")
        for path in words.sources():
            for line, text in words.strings(path):
                self.assertIsNone(gone.search(text), f"{path}:{line}: {text}")
        for page in links.pages(ROOT):
            if not os.path.relpath(page, ROOT).startswith((*words.NO_MANUAL, "docs/explanation/history.md")):
                for line, text in links.prose(page):
                    self.assertIsNone(gone.search(text), f"{page}:{line}: {text}")

    def test_long_paragraphs_can_be_read(self):
        for length, ease, place, _ in words.longest(20):
            self.assertGreaterEqual(ease, 45, f"{place}: {length} words")

    def test_every_model_is_listed(self):
        names = re.findall(r"MODEL\((\w+)\)", content("libswarm", "models.def"))
        self.assertGreaterEqual(len(names), 13)
        for name in names:
            self.assertIn(f"](../models/{name}.md)", content("docs", "reference", "models.md"))
            self.assertIn(f"docs/models/{name}.md", content("docs", "mkdocs.yml"))

    def test_every_page_is_in_the_navigation(self):
        navigation = content("docs", "mkdocs.yml")
        for section in ("tutorial", "how-to", "reference", "explanation"):
            for name in os.listdir(os.path.join(ROOT, "docs", section)):
                self.assertIn(f"docs/{section}/{name}", navigation)

    def test_every_metric_has_a_diagram(self):
        keys = re.findall(r"^ +\{\"(\w+)\", \"", content("libeval", "columns.cpp"), flags=re.M)
        self.assertEqual(len(keys), 7)
        for key in keys:
            self.assertIn(f"](../images/metrics/{key}.svg)", content("docs", "reference", "metrics.md"))

    def test_one_version(self):
        version = re.search(r"project\(swarmfit VERSION (\S+)", content("CMakeLists.txt")).group(1)
        self.assertIn(f"\nversion: {version}\n", content("CITATION.cff"))
        self.assertIn(f'set version = "{version}"', content("packaging", "conda", "meta.yaml"))

    def test_conda_recipe_and_environment_name_the_same_libraries(self):
        recipe = content("packaging", "conda", "meta.yaml").partition("host: &libraries")[2].partition("run:")[0]
        needed = set(re.findall(r"^ +- ([\w-]+)", recipe, flags=re.M))
        named = set(re.search(r"^dependencies: \[(.*)\]", content("packaging", "conda", "environment.yml"), flags=re.M).group(1).split(", "))
        self.assertGreaterEqual(len(needed), 15)
        self.assertEqual(named - needed, {"cxx-compiler", "cmake", "ninja", "pkg-config"})
        self.assertEqual(needed - named, set())

    def test_container_builds_by_what_the_repository_has(self):
        container = content("packaging", "Containerfile")
        for path in ("run", "CMakePresets.json"):
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)))
        self.assertIn("./run --version", container)
        self.assertIn("cpack --config build/release/CPackConfig.cmake", container)


if __name__ == "__main__":
    unittest.main()
