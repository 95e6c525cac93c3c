#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the pages of the manual promise beside their links: every page can be found, every warning has its cure, one version everywhere."""
import os
import re
import unittest

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

    def test_container_builds_by_what_the_repository_has(self):
        container = content("packaging", "Containerfile")
        for path in ("run", "CMakePresets.json"):
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)))
        self.assertIn("./run --version", container)
        self.assertIn("cpack --config build/release/CPackConfig.cmake", container)


if __name__ == "__main__":
    unittest.main()
