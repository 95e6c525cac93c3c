#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does the program find what other simulators planted? A few of the truths of table.py, one recording each.

    python3 program_test.py PROGRAM

What is asserted holds for nearly all data seeds (docs/explanation/tests.md has the table); the seeds here are fixed.
"""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import table  # noqa: E402

PROGRAM = None


class IndependentTruths(unittest.TestCase):
    def run_truth(self, name, rivals=(), make="", seed=1):
        """The truth, the whole result, and the entry of the true model, ranked in sample: nothing here asks for the halves."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            recording, truth = table.make_truth(name, seed, folder, make)
            own = [truth["model"]] if truth["model"] else []
            results = table.compare(PROGRAM, recording, own + list(rivals), folder / "run", "quick", options="--holdout no")
        return truth, results, table.entry_of(results, truth["model"]) if own else None

    def assert_found(self, truth, entry, within):
        for name, tolerance in within.items():
            self.assertLess(abs(entry["parameters"][name]["value"] / truth["parameters"][name] - 1), tolerance, name)
        self.assertGreater(entry["gof_p"], 0.05, "the true model is rejected")

    def test_white_noise_in_continuous_time(self):
        """At one step per frame and kicks of their own, D and gamma1 came out a third too small."""
        for steps in (4, 40):
            with self.subTest(steps=steps):
                truth, results, own = self.run_truth("brownian", ["langevin"], f"--steps {steps}")
                self.assertEqual(results["models"][0]["name"], "brownian")
                self.assert_found(truth, own, {"D": 0.1, "gamma1": 0.25})

    def test_insects_in_white_noise(self):
        truth, _, own = self.run_truth("bswarm_white")
        self.assert_found(truth, own, {"gamma": 0.15, "lambda": 0.05})

    def test_constant_speed_is_read_off(self):
        """Everybody flies at 1.000 m/s, written with six decimals: the fit said 2.14."""
        truth, results, own = self.run_truth("boids", ["vicsek"])
        self.assertEqual(results["models"][0]["name"], "boids")
        self.assert_found(truth, own, {"speed": 0.01, "radius": 0.05, "tau": 0.05})

    def test_maps_step_once_per_frame(self):
        truth, _, own = self.run_truth("vicsek", make="--seconds 4")
        self.assertEqual(own["n_sub"], 1)
        self.assert_found(truth, own, {"speed": 0.01, "eta": 0.05})

    def test_what_may_matter_is_searched(self):
        """The cage of these insects was kept at three times their extent: the true model was rejected."""
        truth, _, own = self.run_truth("noise_aware", ["langevin"])
        self.assert_found(truth, own, {"scale": 0.15, "gain": 0.25, "cage": 0.25})

    def test_a_camera_is_told_from_rough_motion(self):
        """Four hundredths of what is flown per frame make up half of these accelerations: D came out at more than twice its value."""
        truth, results, own = self.run_truth("brownian", make="--error 0.04")
        for axis in range(3):
            self.assertAlmostEqual(results["observation"]["sigma"][axis] / truth["error_sd"], 1, delta=0.15)
        self.assert_found(truth, own, {"D": 0.15})

    def test_rounding_is_part_of_the_observation(self):
        """A tenth of a millimetre is a twentieth of what is flown per frame, and most of an acceleration: longer lags tell what it was."""
        truth, results, own = self.run_truth("langevin", make="--decimals 1")
        self.assertAlmostEqual(results["observation"]["rounding"][0], 0.1)
        self.assert_found(truth, own, {"tau_eta": 0.3, "sigma_eta": 0.3})


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    PROGRAM = sys.argv.pop(1)
    unittest.main()
