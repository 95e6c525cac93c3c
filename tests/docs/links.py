#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tests/docs/links.py [ROOT]   every link and picture of every Markdown page leads to a file that is there, and to a heading that it has.

Links to other sites are not followed. Exit code 1 if a link is dead, with a line for each."""
import os
import re
import sys

FENCE = re.compile(r"^(```|~~~)")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HTML_LINK = re.compile(r"<(?:a|img)\s[^>]*?(?:href|src)=\"([^\"]+)\"")
SKIPPED_FOLDERS = {"build", "runs", ".git"}


def pages(root):
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in SKIPPED_FOLDERS)
        for name in sorted(files):
            if name.endswith(".md"):
                yield os.path.join(folder, name)


def prose(path):
    """Number and text of the lines outside code, with code spans taken out."""
    fence = None
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            mark = FENCE.match(line.lstrip())
            if mark:
                fence = None if fence == mark.group(1) else fence or mark.group(1)
            elif fence is None:
                yield number, line


def without_code(line):
    return re.sub(r"`[^`]*`", lambda code: " " * len(code.group()), line)


def slug(heading):
    """The anchor of a heading, as GitHub makes it; MkDocs' differs only in what the pages here avoid."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    text = re.sub(r"[^\w\- ]", "", text.strip().lower())
    return text.replace(" ", "-")


def anchors(path):
    found = set()
    for _, line in prose(path):
        heading = re.match(r"#{1,6}\s+(.*?)\s*#*\s*$", line)
        if heading:
            found.add(slug(heading.group(1)))
        found.update(re.findall(r"id=\"([^\"]+)\"", line))
    return found


def links(path):
    for number, line in prose(path):
        text = without_code(line)
        for pattern in (LINK, HTML_LINK):
            for target in pattern.findall(text):
                yield number, target


def fault(page, target):
    if re.match(r"[a-z][a-z0-9+.-]*:", target):
        return None
    name, _, anchor = target.partition("#")
    path = os.path.normpath(os.path.join(os.path.dirname(page), name)) if name else page
    if not os.path.exists(path):
        return "no such file"
    if anchor and path.endswith(".md") and anchor not in anchors(path):
        return "no such heading"
    return None


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", "..")
    followed, dead = 0, 0
    for page in pages(os.path.abspath(root)):
        for number, target in links(page):
            followed += 1
            what = fault(page, target)
            if what:
                dead += 1
                print(f"{os.path.relpath(page, root)}:{number}: {target}: {what}")
    print(f"{followed} links, {dead} dead")
    return 1 if dead or not followed else 0


if __name__ == "__main__":
    sys.exit(main())
