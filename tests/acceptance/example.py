# SPDX-License-Identifier: MIT
"""Examples of CONTRIBUTING.md, built: some sources in other words, everything else as it lies in a folder that holds the program."""
import json
import pathlib
import re
import shlex
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def blocks(heading):
    """The C++ of one section of the page."""
    page = (ROOT / "CONTRIBUTING.md").read_text()
    section = re.search(rf"## {heading}\n(.*?)(\n## |\Z)", page, re.S).group(1)
    return re.findall(r"```cpp\n(.*?)```", section, re.S)


def compiled(build, source, out, like):
    """By the command that compiles `like`, a source of the repository. What lies beside `source` in its folder comes before the repository's own."""
    commands = json.loads((build / "compile_commands.json").read_text())
    words = shlex.split(next(c["command"] for c in commands if c["file"] == str(ROOT / like)))
    words = [str(source) if w.endswith("/" + like) else w for w in words]
    words[words.index("-o") + 1] = str(out)
    words.insert(next(i for i, w in enumerate(words) if w.startswith("-I")), f"-I{source.parents[len(pathlib.Path(like).parts) - 1]}")
    subprocess.run(words, cwd=build, check=True)


def built(build, folder, archive, sources, headers=None, like=None):
    """A program in `folder`: `archive` with these sources (path in the repository: text) in place of, or beside, its own. `headers`: files that
    they include; `like`: what compiles new sources as itself."""
    for path, text in {**sources, **(headers or {})}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    shutil.copy(build / archive, folder / archive)
    for path in sources:
        out = folder / (pathlib.Path(path).name + ".o")
        compiled(build, folder / path, out, path if (ROOT / path).exists() else like)
        subprocess.run(["ar", "r", folder / archive, out], check=True)
    listed = subprocess.run(["ninja", "-C", build, "-t", "commands", "swarmfit"], check=True, capture_output=True, text=True).stdout
    link = next(line for line in reversed(listed.splitlines()) if " -o swarmfit " in line)
    for name in ("swarmfit", archive):
        link = link.replace(f" -o {name} ", f" -o {shlex.quote(str(folder / name))} ") if name == "swarmfit" else link.replace(f" {name} ", f" {shlex.quote(str(folder / name))} ")
    subprocess.run(link, shell=True, cwd=build, check=True)
    return folder / "swarmfit"
