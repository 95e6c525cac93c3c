#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The truths against closed forms: stationary laws, conserved quantities, geometry, and what the camera is said to do.

    python3 truths_test.py

Statistical tests have fixed seeds; their bounds are at least four standard errors wide.
"""

import contextlib
import io
import json
import math
import os
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import truths  # noqa: E402

# Perlin's published permutation (2002), for the published value of his noise.
PERLIN = [151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99, 37, 240, 21, 10, 23,
          190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32, 57, 177, 33, 88, 237, 149, 56, 87, 174, 20,
          125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220,
          105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196,
          135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255,
          82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248, 152, 2, 44, 154, 163, 70, 221,
          153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228,
          251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106,
          157, 184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78,
          66, 215, 61, 156, 180]


def positions_of(name, **options):
    return truths.generate(name, **options)[0]


def step_lengths(x):
    return np.linalg.norm(np.diff(x, axis=0), axis=-1)


def headings(x):
    return truths.unit(np.diff(x, axis=0))


def run_of(seed=1, agents=5, frames=10, interval=0.01, steps=1):
    return truths.Run(np.random.default_rng(seed), agents, frames, interval, steps)


class LinearSystems(unittest.TestCase):
    def test_brownian_has_its_stationary_moments(self):
        s = truths.stationary_covariance(*truths.brownian_system(-1.67, 28167.0, 5.0))
        np.testing.assert_allclose(s, np.diag([28167.0 / (1.67 * 5.0), 28167.0 / 1.67]), rtol=1e-12, atol=1e-9)

    def test_langevin_has_its_stationary_moments(self):
        tau_v, k, tau_eta, sigma = 0.6, 5.0, 0.1, 600.0
        a, g = 1 / tau_eta, 1 / tau_v
        m = sigma ** 2 / (k + a * g + a ** 2)
        expected = [[m * (a / g + 1) / k, 0, m], [0, m * a / g, m * a], [m, m * a, sigma ** 2]]
        s = truths.stationary_covariance(*truths.langevin_system(tau_v, k, tau_eta, sigma))
        np.testing.assert_allclose(s, expected, rtol=1e-11, atol=1e-7)

    def test_transitions_compose_and_keep_the_stationary_law(self):
        a, q = truths.langevin_system(0.6, 5.0, 0.1, 600.0)
        s = truths.stationary_covariance(a, q)
        for h in (1e-3, 0.01, 0.5):
            phi, sigma = truths.transition(a, q, h)
            twice, sigma2 = truths.transition(a, q, 2 * h)
            np.testing.assert_allclose(phi @ phi, twice, rtol=1e-10, atol=1e-14)
            np.testing.assert_allclose(phi @ sigma @ phi.T + sigma, sigma2, rtol=1e-8)
            np.testing.assert_allclose(phi @ s @ phi.T + sigma, s, rtol=1e-10, atol=1e-7)

    def test_matrix_exponential_of_a_rotation(self):
        np.testing.assert_allclose(truths.matrix_exponential(np.array([[0.0, 5.0], [-5.0, 0.0]])),
                                   [[math.cos(5), math.sin(5)], [-math.sin(5), math.cos(5)]], atol=1e-12)

    def check_oscillator(self, x, gamma, k, variance, interval, tolerance):
        """The variance, and the covariance of an underdamped oscillator at several lags."""
        self.assertAlmostEqual(np.mean(x * x) / variance, 1.0, delta=tolerance)
        omega = math.sqrt(k - gamma ** 2 / 4)
        for lag in (1, 20, 60):
            t = lag * interval
            correlation = math.exp(-gamma * t / 2) * (math.cos(omega * t) + gamma / (2 * omega) * math.sin(omega * t))
            moved = np.mean((x[lag:] - x[:-lag]) ** 2)
            self.assertAlmostEqual(moved / (2 * variance * (1 - correlation)), 1.0, delta=tolerance, msg=f"lag {lag}")

    def test_brownian_moves_as_an_oscillator(self):
        for options in ({"exact": True}, {"steps": 20}):
            x = positions_of("brownian", seed=3, agents=3000, seconds=1, **options)
            self.check_oscillator(x, 1.67, 5.0, 28167.0 / (1.67 * 5.0), 0.01, 0.05)

    def test_second_differences_know_the_number_of_steps(self):
        T, D = 0.01, 28167.0
        cases = [({"steps": n}, 2 / 3 + 1 / (3 * n * n), (n * n - 1) / (4 * n * n + 2)) for n in (1, 2, 4, 10)]
        for options, variance, correlation in cases + [({"exact": True}, 2 / 3, 1 / 4)]:
            x = positions_of("brownian", seed=5, agents=2000, seconds=0.3, settings={"gamma1": -1e-3, "k": 1e-6}, **options)
            second = np.diff(x, n=2, axis=0)
            with self.subTest(options):
                self.assertAlmostEqual(second.var() / (2 * D * T ** 3) / variance, 1.0, delta=0.02)
                self.assertAlmostEqual(np.mean(second[1:] * second[:-1]) / second.var(), correlation, delta=0.015)

    def test_langevin_stays_stationary(self):
        a, g, k = 10.0, 1 / 0.6, 5.0
        m = 600.0 ** 2 / (k + a * g + a * a)
        for options in ({"exact": True}, {"steps": 20}):
            x = positions_of("langevin", seed=7, agents=2000, seconds=2, **options)
            self.assertAlmostEqual(np.mean(x[-1] ** 2) / (m * (a / g + 1) / k), 1.0, delta=0.08)
            self.assertAlmostEqual(np.mean(np.diff(x, axis=0) ** 2) / 1e-4 / (m * a / g), 1.0, delta=0.04)

    def test_what_is_not_linear_has_no_exact_law(self):
        for name, settings in (("rayleigh", {}), ("boids", {}), ("brownian", {"gamma2": 1e-5})):
            with self.assertRaises(SystemExit):
                truths.generate(name, exact=True, settings=settings)


class ActiveParticles(unittest.TestCase):
    def test_free_rayleigh_particles_have_their_speeds(self):
        gamma1, gamma2, D = 2.0, 5e-5, 20000.0
        v = np.linspace(0, 600, 20001)
        weight = v ** 2 * np.exp((gamma1 * v ** 2 / 2 - gamma2 * v ** 4 / 4) / D)
        expected = np.sum(weight * v ** 2) / np.sum(weight)
        x = positions_of("rayleigh", seed=2, agents=1500, seconds=0.5, steps=5, settings={"k": 0.0})
        self.assertAlmostEqual(np.mean(step_lengths(x) ** 2) / 1e-4 / expected, 1.0, delta=0.03)

    def test_repulsion_is_the_gradient_of_its_potential(self):
        C_r, l_r, d = 3000.0, 20.0, 15.0
        step = truths.brownian_step(run_of(agents=2), 0.0, 0.0, 0.0, 0.0, C_r, l_r)
        _, v = step((np.array([[0.0, 0, 0], [d, 0, 0]]), np.zeros((2, 3))))
        self.assertAlmostEqual(v[1, 0] / 0.01, C_r / l_r * math.exp(-d / l_r), places=9)
        np.testing.assert_allclose(v[0], -v[1], atol=1e-12)

    def test_a_lone_insect_with_drag_and_white_noise_has_its_speeds(self):
        """u = gamma v³ / (3 D) is exponential with mean and standard deviation 1, whatever the step."""
        for steps in (5, 10):
            alone = {"chi_rep": 0.0, "chi_att": 0.0}
            x = positions_of("bswarm_white", seed=4, agents=400, seconds=0.5, fps=200, steps=steps, settings=alone)
            u = 0.008 * (step_lengths(x) * 200) ** 3 / (3 * 404.0 ** 2 / 2)
            self.assertAlmostEqual(u.mean(), 1.0, delta=0.12)
            self.assertAlmostEqual(u.std(), 1.0, delta=0.25)

    def test_zones_of_bswarm(self):
        still = np.zeros((3, 3))
        x = np.array([[0.0, 0, 0], [10.0, 0, 0], [0, 100.0, 0]])
        force = truths.bswarm_force(x, still, 0.01, 200.0, 900.0, 20.0, 400.0)
        np.testing.assert_allclose(force[0], [-200.0, 900.0, 0.0])
        back = np.array([0.0, -100.0, 0]) / 100 + np.array([10.0, -100.0, 0]) / math.hypot(10, 100)
        np.testing.assert_allclose(force[2], 900.0 * back / 2)  # averaged over the zone
        far = truths.bswarm_force(x * 100, still, 0.01, 200.0, 900.0, 20.0, 400.0)
        np.testing.assert_allclose(far, 0.0)
        drag = truths.bswarm_force(x * 100, still + (3.0, 4.0, 0.0), 0.01, 200.0, 900.0, 20.0, 400.0)
        np.testing.assert_allclose(drag[0], [-0.15, -0.2, 0.0])


class Noise(unittest.TestCase):
    def setUp(self):
        self.noise = truths.Perlin(np.random.default_rng(11))
        self.x = np.random.default_rng(12).uniform(-20, 20, (4000, 3))

    def test_published_value(self):
        self.assertEqual(sorted(PERLIN), list(range(256)))
        self.noise.tables = np.array([PERLIN] * 3)
        self.noise.shifts = np.zeros((3, 3))
        values, _ = self.noise(np.array([[3.14, 42.0, 7.0], [0.5, 0.5, 0.5]]))
        np.testing.assert_allclose(values[0], 0.136919958784, atol=1e-12)
        np.testing.assert_allclose(values[1], -0.25, atol=1e-12)

    def test_derivatives(self):
        _, J = self.noise(self.x)
        h = 1e-5
        for axis in range(3):
            e = h * np.eye(3)[axis]
            np.testing.assert_allclose(J[:, :, axis], (self.noise(self.x + e)[0] - self.noise(self.x - e)[0]) / (2 * h), atol=1e-7)

    def test_curl_has_no_divergence(self):
        h = 1e-3
        divergence = sum((truths.curl(self.noise(self.x + h * e)[1]) - truths.curl(self.noise(self.x - h * e)[1]))[:, axis] / (2 * h)
                         for axis, e in enumerate(np.eye(3)))
        self.assertLess(np.abs(divergence).max(), 2e-4)

    def test_strength(self):
        P, J = self.noise(np.random.default_rng(13).uniform(-100, 100, (20000, 3)))
        self.assertAlmostEqual(np.sqrt(np.mean(P ** 2)), 0.27, delta=0.01)
        self.assertAlmostEqual(np.sqrt(np.mean(np.sum(truths.curl(J) ** 2, axis=1))), 1.72, delta=0.04)

    def test_cage(self):
        scale, gain, cage = 100.0, 12000.0, 250.0
        rng = np.random.default_rng(14)

        def N(x):
            P = gain * self.noise(x / scale)[0]
            n = -truths.unit(x)
            q = np.clip((cage - np.linalg.norm(x, axis=1, keepdims=True)) / scale, 0, 1)
            alpha = 15 / 8 * q - 10 / 8 * q ** 3 + 3 / 8 * q ** 5
            return alpha * P + (1 - alpha) * np.sum(n * P, axis=1, keepdims=True) * n

        x = truths.in_ball(rng, 500, 3, 0.99 * cage)
        h = 1e-3
        J = np.stack([(N(x + h * e) - N(x - h * e)) / (2 * h) for e in np.eye(3)], axis=-1)
        np.testing.assert_allclose(truths.caged_curl(self.noise, x, gain, scale, cage), truths.curl(J), atol=2e-3)
        rim = cage * truths.isotropic(rng, 500, 3)
        outwards = np.sum(truths.caged_curl(self.noise, rim, gain, scale, cage) * rim, axis=1) / cage
        self.assertLess(np.abs(outwards).max(), 1e-8)
        self.assertLess(np.linalg.norm(positions_of("noise_aware", seed=1), axis=-1).max(), cage)


class ConstantSpeed(unittest.TestCase):
    def test_boids(self):
        lengths = step_lengths(positions_of("boids", steps=1, seconds=2))
        np.testing.assert_allclose(lengths, 1.0 / 50, rtol=1e-12)
        self.assertLess(step_lengths(positions_of("boids", steps=10, seconds=2)).max(), 1.0 / 50 * (1 + 1e-12))

    def test_rules_of_boids(self):
        x = np.array([[0.0, 0, 0], [2.0, 0, 0]])
        v = np.array([[0.0, 1, 0], [0.0, 0, 1]])
        far = truths.boids_steering(x, v, 3.0)  # beyond radius / 2: alignment and cohesion
        np.testing.assert_allclose(far[0], np.array([0, -1, 1]) / math.sqrt(2) + (1, 0, 0))
        near = truths.boids_steering(x, v, 5.0)
        np.testing.assert_allclose(near[0] - far[0], [-1.5, 0, 0], atol=1e-12)
        np.testing.assert_allclose(truths.boids_steering(x, v, 1.0), 0.0)

    def test_couzin(self):
        x = positions_of("couzin", seconds=10.1)
        np.testing.assert_allclose(step_lengths(x), 0.3, rtol=1e-9)
        u = headings(x)
        turns = np.arccos(np.clip(np.sum(u[1:] * u[:-1], axis=-1), -1, 1))
        self.assertLess(turns.max(), math.radians(100) * 0.1 + 1e-6)
        fine = positions_of("couzin", seconds=10, fps=50)
        np.testing.assert_allclose(fine[::5], x[:100], atol=1e-9)
        np.testing.assert_allclose(fine[2::5], 0.6 * x[:100] + 0.4 * x[1:], atol=1e-9)

    def test_zones_of_couzin(self):
        x = np.array([[0.0, 0, 0], [0.5, 0, 0], [0, 3.0, 0], [0, 0, 9.0]])
        u = np.array([[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0], [1.0, 0, 0]])
        wish = truths.zonal_wish(x, u, 1.0, 3.0, 8.0)
        np.testing.assert_allclose(wish[0], [-1, 0, 0])  # repulsion alone
        expected = u[0] + u[1] + (x[3] - x[2]) / np.linalg.norm(x[3] - x[2])
        np.testing.assert_allclose(wish[2], expected / np.linalg.norm(expected))
        np.testing.assert_allclose(truths.zonal_wish(x * 100, u, 1.0, 3.0, 8.0), u)  # nobody in sight

    def test_turning_is_bounded_and_arrives(self):
        u, target = np.array([[1.0, 0, 0]] * 3), np.array([[0.0, 1, 0], [math.cos(0.1), math.sin(0.1), 0], [-1.0, 0, 0]])
        turned = truths.turn_towards(np.random.default_rng(1), u, target, 0.3)
        np.testing.assert_allclose(turned[:2], [[math.cos(0.3), math.sin(0.3), 0], target[1]], atol=1e-12)
        self.assertAlmostEqual(turned[2, 0], math.cos(0.3))

    def test_vicsek_speed_and_limits_of_noise(self):
        for name, speed in (("vicsek", 0.2), ("vicsek_periodic", 0.5)):
            np.testing.assert_allclose(step_lengths(positions_of(name)), speed / 25, rtol=1e-9)
        order = np.linalg.norm(headings(positions_of("vicsek_periodic", settings={"eta": 0.0})).mean(axis=1), axis=-1)
        self.assertGreater(order[-1], 1 - 1e-9)
        order = np.linalg.norm(headings(positions_of("vicsek_periodic", settings={"eta": 2 * math.pi})).mean(axis=1), axis=-1)
        self.assertAlmostEqual(order.mean() / math.sqrt(math.pi / 4 / 60), 1.0, delta=0.15)

    def test_vicsek_moves_with_old_headings_and_turns_by_its_error(self):
        decide = truths.vicsek_decision(run_of(agents=2), 1.0, 5.0, 0.0, 0.5)
        x, theta = decide((np.zeros((2, 2)), np.array([0.0, math.pi / 2])))
        np.testing.assert_allclose(x, [[0.5, 0], [0, 0.5]], atol=1e-15)
        np.testing.assert_allclose(theta, math.pi / 4)
        u = headings(positions_of("vicsek", agents=1, seconds=400, settings={"eta": 1.5}))[:, 0]
        turns = np.arctan2(u[:-1, 0] * u[1:, 1] - u[:-1, 1] * u[1:, 0], np.sum(u[1:] * u[:-1], axis=-1))
        self.assertLess(np.abs(turns).max(), 0.75 + 1e-9)
        self.assertAlmostEqual(turns.var() / (1.5 ** 2 / 12), 1.0, delta=0.04)

    def test_vicsek_sees_across_the_edge_of_the_box(self):
        x, theta = np.array([[0.01, 0.5], [1.99, 0.5]]), np.array([0.0, 1.0])
        for box, expected in ((2.0, 0.5), (None, 0.0)):
            _, turned = truths.vicsek_decision(run_of(agents=2), 0.1, 0.3, 0.0, 0.1, box)((x, theta))
            self.assertAlmostEqual(turned[0], expected)


class Avoidance(unittest.TestCase):
    def test_the_whole_way_out_just_grazes(self):
        rng = np.random.default_rng(21)
        tau, radius, grazed = 2.0, 0.5, 0
        for _ in range(500):
            r = truths.isotropic(rng, 1, 3) * rng.uniform(1.05, 6.0)
            v, other = rng.normal(0, 1.5, (2, 3))
            points, normals = truths.half_spaces(np.zeros(3), v, r, other[None, :], radius, tau, 0.1)
            w = v - other + 2 * (points[0] - v)
            if w @ w < 1e-4:  # leaves at the apex: they never meet
                continue
            time = np.clip(r[0] @ w / (w @ w), 0, tau)
            nearest = np.linalg.norm(r[0] - w * time)
            if (w @ r[0]) > 0:
                self.assertAlmostEqual(nearest, 2 * radius, places=9)
                grazed += 1
            self.assertGreater(nearest, 2 * radius - 1e-9)
            self.assertAlmostEqual(np.linalg.norm(normals[0]), 1.0, places=12)
        self.assertGreater(grazed, 200)

    def test_velocities_keep_all_rules_and_are_the_nearest(self):
        rng = np.random.default_rng(22)
        at = {"wish": 0, "sphere": 0, "planes": 0}
        for _ in range(300):
            normals = truths.isotropic(rng, 6, 3)
            points = normals * rng.uniform(-1.0, 0.2, (6, 1))
            wish = rng.normal(0, 0.6, 3)
            w = truths.nearest_velocity(wish, points, normals, 1.0)
            inside = truths.in_ball(rng, 1000, 3, 1.0)
            inside = inside[np.all(inside @ normals.T >= np.sum(points * normals, axis=1), axis=1)]
            if w is None:
                self.assertEqual(len(inside), 0)
                continue
            self.assertLess(np.linalg.norm(w), 1 + 1e-10)
            self.assertGreater(np.min(np.sum((w - points) * normals, axis=1)), -1e-10)
            # The nearest point of a convex set sees all of it at no less than a right angle from the way to `wish`.
            self.assertTrue(np.all((inside - w) @ (wish - w) <= 1e-10))
            at["wish" if np.allclose(w, wish) else "sphere" if np.linalg.norm(w) > 1 - 1e-9 else "planes"] += 1
        self.assertGreater(min(at.values()), 20)

    def test_contradicting_rules_are_broken_equally(self):
        points, normals = np.array([[1.0, 0, 0], [-1.0, 0, 0]]), np.array([[1.0, 0, 0], [-1.0, 0, 0]])
        self.assertIsNone(truths.nearest_velocity(np.array([0.3, 0.4, 0]), points, normals, 5.0))
        w = truths.avoiding_velocity(np.array([0.3, 0.4, 0]), points, normals, 5.0)
        np.testing.assert_allclose(w, [0.0, 0.4, 0.0], atol=1e-8)

    def test_a_head_on_pair_passes(self):
        goal = np.array([[5.0, 0, 0], [-5.0, 0, 0]])
        x, v, rng, nearest = -goal, np.zeros((2, 3)), np.random.default_rng(23), np.inf
        for _ in range(400):
            wishes = truths.unit(goal - x) * np.minimum(1.0, np.linalg.norm(goal - x, axis=1, keepdims=True) / 0.05)
            v = truths.orca(x, v, wishes + 1e-3 * truths.isotropic(rng, 2, 3), 0.5, 2.0, 0.05, 1.0, 10.0, 10)
            x = x + 0.05 * v
            nearest = min(nearest, np.linalg.norm(x[1] - x[0]))
        self.assertGreater(nearest, 1.0 - 1e-6)
        self.assertLess(np.linalg.norm(x - goal, axis=1).max(), 0.05)

    def test_rvo(self):
        x = positions_of("rvo", seconds=3, fps=50, steps=1)
        self.assertLess(step_lengths(x).max(), 200.0 / 50 * (1 + 1e-9))
        self.assertGreater(min(truths.offsets(p)[1].min() for p in x), 30.0 - 1e-6)


class NoModelOfOurs(unittest.TestCase):
    def test_random_walk(self):
        steps = np.diff(positions_of("random_walk", seed=9, agents=100, seconds=20), axis=0)
        four = 4 / math.sqrt(steps.size)
        self.assertAlmostEqual(steps.var() * 3, 1.0, delta=3 * four)
        self.assertLess(abs(np.mean(steps[1:] * steps[:-1])) * 3, four)
        self.assertLess(abs(np.mean(steps[:, 1:] * steps[:, :-1])) * 3, four)
        self.assertLess(abs(np.mean(steps[..., 0] * steps[..., 1])) * 3, math.sqrt(3) * four)

    def test_pedestrians_are_pushed_down_their_potential(self):
        rng = np.random.default_rng(31)
        V0, sigma, stride = 2.1, 0.3, 2.0
        e = np.array([[1.0, 0.0], [-1.0, 0.0]])
        v = 1.3 * e

        def potential(a, b):
            r, y = a - b, stride * 1.3 * e[1]
            minor = math.sqrt((np.linalg.norm(r) + np.linalg.norm(r - y)) ** 2 - y @ y)
            return V0 * math.exp(-minor / 2 / sigma)

        for _ in range(20):
            x = rng.normal(0, 0.5, (2, 2))
            force = truths.pedestrian_repulsion(x, v, e, V0, sigma, stride, math.pi, 0.5)[0]
            h = 1e-6
            slope = [(potential(x[0] + d, x[1]) - potential(x[0] - d, x[1])) / (2 * h) for d in h * np.eye(2)]
            np.testing.assert_allclose(force, -np.array(slope), rtol=1e-4, atol=1e-6)

    def test_pedestrians_keep_to_their_corridor_and_speed(self):
        x = positions_of("crowd", seconds=10)
        self.assertLess(np.abs(x[..., 1]).max(), 2.5)
        self.assertLess(step_lengths(x).max() * 25, 1.3 * 2 * 1.34)
        alone = positions_of("crowd", agents=1, seconds=1, settings={"fluctuation": 0.0, "U0": 0.0, "length": 1e4})
        self.assertLess(np.ptp(step_lengths(alone)), 1e-9)

    def test_mixture(self):
        x = positions_of("mixture", steps=1, seconds=2)
        np.testing.assert_allclose(step_lengths(x)[:, 10:], 2.5, rtol=1e-9)
        self.assertGreater(step_lengths(x)[:, :10].std(), 0.3)


class Camera(unittest.TestCase):
    def lines(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            truths.main([*arguments, "--out", "-"])
        return out.getvalue().splitlines()

    def table(self, *arguments):
        lines = self.lines(*arguments)
        start = next(i for i, line in enumerate(lines) if not line.startswith("#"))
        return lines[:start + 1], np.array([[float(value) for value in line.split(",")] for line in lines[start + 1:]])

    def test_every_truth_writes_the_same_file_for_the_same_seed(self):
        for name in truths.TRUTHS:
            short = (name, "--seconds", "0.4", "--agents", "6", "--steps", "1")
            with self.subTest(name):
                first = self.lines(*short, "--seed", "2")
                self.assertEqual(first, self.lines(*short, "--seed", "2"))
                self.assertNotEqual(first[4:], self.lines(*short, "--seed", "3")[4:])
                self.assertNotIn("nan", "".join(first[4:]))

    def test_header_and_decimals(self):
        head, rows = self.table("vicsek", "--seconds", "1")
        self.assertEqual(head[1:], ["# unit: m", "# fps: 25", "id,frame,x,y"])
        self.assertEqual(rows.shape, (60 * 25, 4))
        for line in self.lines("vicsek", "--seconds", "1", "--decimals", "3")[4:]:
            self.assertRegex(line, r"^\d+,\d+,-?\d+\.\d{3},-?\d+\.\d{3}$")
        _, rows = self.table("brownian", "--seconds", "1", "--decimals", "17")
        x = positions_of("brownian", seconds=1)
        np.testing.assert_array_equal(rows[:, 2:].reshape(10, 100, 3), x.transpose(1, 0, 2))

    def test_localisation_error_is_a_share_of_the_distance_flown(self):
        x = positions_of("brownian")
        y, _, _ = truths.observe(x, 1, "brownian", error=0.04)
        self.assertAlmostEqual((y - x).std() / (0.04 * step_lengths(x).mean()), 1.0, delta=0.03)
        self.assertLess(abs(np.mean((y - x)[1:] * (y - x)[:-1])) / (y - x).var(), 0.04)

    def test_gaps(self):
        missed = truths.gaps(np.random.default_rng(41), 4000, 50, 0.02)
        edges = np.diff(np.pad(missed, ((1, 1), (0, 0))).astype(int), axis=0)
        lengths = np.concatenate([np.flatnonzero(edges[:, a] < 0) - np.flatnonzero(edges[:, a] > 0) for a in range(50)])
        self.assertEqual(sorted(set(lengths)), [1, 2, 3, 4, 5])
        self.assertAlmostEqual(lengths.mean(), 3.0, delta=0.1)
        self.assertAlmostEqual(missed.mean(), 0.06 / 1.06, delta=0.004)
        self.assertFalse(truths.gaps(np.random.default_rng(41), 100, 5, 0.0).any())

    def test_presence(self):
        there = truths.presence(np.random.default_rng(42), 400, 1000)
        self.assertTrue(np.all(np.abs(np.diff(np.pad(there, ((1, 1), (0, 0))).astype(int), axis=0)).sum(axis=0) == 2))  # one stretch
        self.assertGreaterEqual(there.sum(axis=0).min(), 10)
        self.assertGreater(np.ptp(there.sum(axis=0)), 200)
        crowd = there.sum(axis=1)
        self.assertGreater(crowd.min() / crowd.max(), 0.7)  # about as many at any time
        _, rows = self.table("brownian", "--presence", "irregular", "--gaps", "0.02")
        self.assertLess(len(rows), 0.95 * 5000)

    def test_wrapped_positions(self):
        _, jumps = self.table("vicsek_periodic", "--wrapped", "jumps")
        self.assertTrue(np.all((jumps[:, 2:] >= 0) & (jumps[:, 2:] <= 2.0)))
        jumped = np.linalg.norm(np.diff(jumps[:, 2:], axis=0), axis=1)[np.diff(jumps[:, 1]) == 1]
        self.assertGreater(jumped.max(), 1.9)
        _, tracks = self.table("vicsek_periodic", "--wrapped", "tracks")
        np.testing.assert_array_equal(sorted(map(tuple, tracks[:, 1:])), sorted(map(tuple, jumps[:, 1:])))
        flown = np.linalg.norm(np.diff(tracks[:, 2:], axis=0), axis=1)[np.diff(tracks[:, 0]) == 0]
        self.assertLess(flown.max(), 0.02 + 3e-6)
        self.assertGreater(len(set(tracks[:, 0])), 60)

    def test_truth_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "truth.json")
            self.lines("bswarm_white", "--seconds", "0.1", "--set", "lambda=500", "--truth", path)
            with open(path, encoding="utf-8") as file:
                written = json.load(file)
            self.assertEqual(written["model"], "bswarm[noise=white,avoidance=none]")
            self.assertEqual(written["parameters"], {"gamma": 0.008, "lambda": 500.0, "chi_rep": 200.0, "chi_att": 900.0, "r_rep": 20.0,
                                                     "r_att": 400.0})
            self.lines("random_walk", "--truth", path)
            with open(path, encoding="utf-8") as file:
                self.assertIsNone(json.load(file)["model"])


if __name__ == "__main__":
    unittest.main()
