# SPDX-License-Identifier: MIT
"""Pages for the tests, made by the program on recordings small enough to take seconds."""

import json
import pathlib
import subprocess

QUICK = ["--budget", "quick", "--max-evaluations", "20", "--replicates", "1", "-q"]
DEMO = ["demo", "--frames", "0:60"]
MODELS = ["brownian", "langevin", "bswarm"]

# What a hostile recording says wherever it may say something.
ATTACK = "<script>alert(1)</script>"
HOSTILE_NAME = "<img src=x onerror=alert(2)>\"'&lt;script&gt;{{data}}.csv"
HOSTILE_UNIT = "\"'><svg onload=alert(3)>"
LONG_NAME = "n" * 10000
HOSTILE_FLAGS = ["--columns", f"id={ATTACK},frame={LONG_NAME},x=x,y=y,z=z", "--fps", "50", "--unit", HOSTILE_UNIT]


class Pages:
    """Runs the program in `folder` and says where its pages are."""

    def __init__(self, program, folder):
        self.program = str(pathlib.Path(program).resolve())
        self.folder = pathlib.Path(folder)

    def run(self, *arguments, timeout=300):
        done = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=timeout, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(arguments)}: {done.stderr.strip()}")

    def url(self, *path):
        return self.folder.joinpath(*path).resolve().as_uri()

    def compare(self):
        self.run("compare", *DEMO, "-m", ",".join(MODELS), *QUICK, "--out", "compare")
        return self.url("compare", "report.html")

    def fit(self):
        self.run("fit", *DEMO, "-m", "brownian", *QUICK, "--out", "fit")
        return self.url("fit", "report.html")

    def several(self):
        """Two flat recordings, one of them with gaps."""
        for name, more in ("herd", []), ("gaps & more", ["--dropout", "0.05", "--seed", "2"]):
            self.run("simulate", "brownian", "--dims", "2", "--agents", "12", "--frames", "60", "--unit", "m", "--out", f"{name}.csv", *more)
        self.run("compare", "herd.csv", "gaps & more.csv", "-m", ",".join(MODELS), *QUICK, "--out", "several")
        return self.url("several", "report.html")

    def flat(self):
        """The report of one of several()."""
        return self.url("several", "gaps & more", "report.html")

    def describe(self):
        self.run("describe", *DEMO, "--html", "describe.html")
        return self.url("describe.html")

    def simulate(self):
        self.run("simulate", "vicsek", "--dims", "2", "--agents", "40", "--frames", "30", "--html", "simulate.html")
        return self.url("simulate.html")

    def evaluate(self):
        """The example against a simulation whose frames are numbered from elsewhere."""
        self.run("simulate", "brownian", "--agents", "8", "--frames", "50", "--fps", "50", "--unit", "mm", "--out", "other.csv")
        self.run("evaluate", *DEMO, "other.csv", "--html", "evaluate.html")
        return self.url("evaluate.html")

    def recover(self):
        self.run("recover", "-m", "bswarm,boids", "--seeds", "2", "--agents", "6", "--frames", "50", "--max-evaluations", "10", "-q",
                 "--out", "recover")
        return self.url("recover", "report.html")

    def recover_parameters(self):
        self.run("recover", "--parameters", "-m", "brownian", "--seeds", "3", "--agents", "6", "--frames", "60", "-q", "--out", "parameters")
        return self.url("parameters", "report.html")

    def power(self):
        self.run("power", *DEMO, "-m", "bswarm,boids", "--seeds", "2", "--max-evaluations", "10", "-q", "--out", "power")
        return self.url("power", "report.html")

    def measure(self):
        self.run("measure", *DEMO, "-q", "--out", "measure")
        return self.url("measure", "report.html")

    def sweep(self):
        self.run("sweep", "vicsek", "--axis", "eta=0:2:2", "--dims", "2", "--agents", "20", "--frames", "20", "--box", "0", "-q", "--out", "sweep")
        return self.url("sweep", "report.html")

    def flock(self):
        """That flies far in comparison with its size."""
        self.run("simulate", "boids", "--agents", "20", "--frames", "240", "--fps", "30", "--box", "0", "--start-radius", "1", "--set",
                 "speed=4", "--set", "radius=3", "--warm-up", "60", "--html", "flock.html")
        return self.url("flock.html")

    def predator(self):
        """A predator that comes late and crosses the picture, beside a block."""
        (self.folder / "predator.toml").write_text("""title = "late"
model = "brownian"
dims = 2
agents = 5
frames = 100
[start]
radius = 1
speed = 0
[[stimulus]]
kind = "repel"
path = [[0.4, -3, 2], [0.9, 3, 2]]
from = 0.4
[[obstacle]]
shape = "box"
lower = [-3, -3]
upper = [3, -2]
""")
        self.run("simulate", "./predator.toml", "--html", "predator.html")
        return self.url("predator.html")

    def gallery(self):
        self.run("gallery", "gallery.html")
        return self.url("gallery.html")

    def json(self, *arguments):
        """What a command prints."""
        printed = subprocess.run([self.program, *arguments, "--json"], cwd=self.folder, capture_output=True, text=True, timeout=60, check=True)
        return json.loads(printed.stdout)

    def scenarios(self):
        """Names of all scenarios."""
        return [scene["name"] for scene in self.json("scenarios")["scenarios"]]

    def hostile_recording(self):
        """The same recording as a page of its own."""
        self.hostile()
        self.run("describe", HOSTILE_NAME, *HOSTILE_FLAGS, "--html", "recording.html")
        return self.url("recording.html")

    def hostile_pair(self):
        """The same recording against itself."""
        self.hostile()
        self.run("evaluate", HOSTILE_NAME, HOSTILE_NAME, *HOSTILE_FLAGS, "--html", "pair.html")
        return self.url("pair.html")

    def hostile(self):
        self.run("simulate", "brownian", "--agents", "6", "--frames", "60", "--out", "plain.csv")
        table = [line.split(",") for line in (self.folder / "plain.csv").read_text().splitlines() if not line.startswith("#")]
        head = [f"\"{ATTACK}\"", LONG_NAME, "x", "y", "z"]
        at = {name: table[0].index(name) for name in ("id", "frame", "x", "y", "z")}
        rows = [[f"\"{ATTACK}{row[at['id']]}\"", *(row[at[name]] for name in ("frame", "x", "y", "z"))] for row in table[1:]]
        rows[7][2] = rows[20][4] = "NaN"
        (self.folder / HOSTILE_NAME).write_text("\n".join(",".join(row) for row in [head, *rows]) + "\n")
        self.run("compare", HOSTILE_NAME, *HOSTILE_FLAGS, "-m", "brownian,langevin", *QUICK, "--out", "hostile")
        return self.url("hostile", "report.html")
