#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tests/docs/words.py strings      every sentence that the program may print, with its place, to be read once as a stranger
tests/docs/words.py paragraphs   the twenty longest paragraphs of the manual with their Flesch reading ease, the hardest first

Strings are what stands in quotes in the sources and has three words or more. Reading ease: 206.835 - 1.015 words per sentence - 84.6
syllables per word; below 30 is hard, above 60 is plain."""
import os
import re
import sys

import links

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
ROOMS = ("libtrack", "libswarm", "libeval", "fit", "reports", "cli")
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
NO_MANUAL = ("CHANGELOG.md", "CONTRIBUTING.md", os.path.join("reports", "published"))


def sources(root=ROOT):
    for room in ROOMS:
        for folder, _, files in sorted(os.walk(os.path.join(root, room))):
            yield from (os.path.join(folder, name) for name in sorted(files) if name.endswith((".cpp", ".h", ".def")))


def strings(path):
    """Line and text of what stands in quotes; neighbours are one."""
    with open(path, encoding="utf-8") as file:
        text = re.sub(r"^\s*(?://|#include).*$", "", file.read(), flags=re.M)
    found, end = [], None
    for match in LITERAL.finditer(text):
        if end is not None and not text[end:match.start()].strip():
            found[-1][1] += match.group(1)
        else:
            found.append([text.count("\n", 0, match.start()) + 1, match.group(1)])
        end = match.end()
    return [(line, said) for line, said in found if " " in said and len(re.findall(r"[^\W\d_]{2,}", said)) >= 3]


def paragraphs(path):
    """Prose: neither headings nor tables, code or equations; an entry of a list is a paragraph."""
    block, begun = [], 0
    for number, line in [*links.prose(path), (0, "\n")]:
        text = line.strip()
        new = re.match(r"([-*>]|\d+\.)\s", text)
        if block and (not text or new or text.startswith(("|", "#", "$$"))):
            yield begun, " ".join(block)
            block = []
        if text and not text.startswith(("|", "#", "$$", "<")):
            begun = begun if block else number
            block.append(re.sub(r"^([-*>]|\d+\.)\s+", "", text))


def plain(text):
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\b(al|e\.g|i\.e|vs|approx)\.", r"\1", text)
    return re.sub(r"[`*_]|\([^)]*doi[^)]*\)", "", text)


def syllables(word):
    groups = len(re.findall(r"[aeiouyäöüé]+", word.lower()))
    return max(1, groups - (word.lower().endswith("e") and not word.lower().endswith("le") and groups > 1))


def reading_ease(text):
    said = plain(text)
    words = re.findall(r"[^\W\d_]+(?:['’-][^\W\d_]+)*", said)
    sentences = max(1, len(re.findall(r"[.!?](?=[)\s]|$)", said)))
    if not words:
        return float("nan")
    return 206.835 - 1.015 * len(words) / sentences - 84.6 * sum(map(syllables, words)) / len(words)


def longest(count, root=ROOT):
    found = []
    for page in links.pages(root):
        name = os.path.relpath(page, root)
        if not name.startswith(NO_MANUAL):
            found += [(len(plain(text).split()), reading_ease(text), f"{name}:{line}", text) for line, text in paragraphs(page)]
    return sorted(found, key=lambda one: -one[0])[:count]


def main():
    if sys.argv[1:] == ["strings"]:
        for path in sources():
            for line, said in strings(path):
                print(f"{os.path.relpath(path, ROOT)}:{line}: {said}")
    elif sys.argv[1:] == ["paragraphs"]:
        for words, ease, place, text in sorted(longest(20), key=lambda one: one[1]):
            print(f"{ease:5.0f}  {words:4d} words  {place}: {text[:60]}")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
