#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Recordings of known origin, made by simulators that share no code with swarmfit.

    python3 truths.py NAME --seed 1 --out FILE.csv [--truth FILE.json] [--agents N] [--seconds S] [--fps F] [--steps K] [--exact]
                           [--set NAME=VALUE ...] [--error SIGMA] [--decimals D] [--gaps P] [--presence irregular]
                           [--wrapped jumps|tracks]
    python3 truths.py --list

Each truth is one function with the decorator `truth`. Its keyword arguments are its parameters, with swarmfit's names where swarmfit has
the model; it returns positions, frames x agents x dimensions. What a camera does to them (localisation error, gaps, animals that come
and go, rounding) is the same for all and stands in `observe`. Needs Python 3.9 and numpy.
"""

import argparse
import dataclasses
import functools
import inspect
import itertools
import json
import math
import os
import sys
import zlib

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices are tiny, and threads would change the last bits of sums
import numpy as np  # noqa: E402


# ---- what a truth is -----------------------------------------------------------------------------------------------------------

@dataclasses.dataclass
class Run:
    """What is asked of a truth: how many agents and frames, how finely to integrate, and where random numbers come from."""
    rng: np.random.Generator
    agents: int
    frames: int
    interval: float  # [s] between frames
    steps: int  # integration steps per frame
    exact: bool = False  # the exact transition law instead of an integrator, where there is one

    @property
    def h(self):
        """Integration step [s]."""
        return self.interval / self.steps


@dataclasses.dataclass(frozen=True)
class Truth:
    name: str
    make: object  # make(run, **parameters) -> positions
    model: object  # swarmfit's model, or None
    unit: str
    agents: int
    seconds: float
    fps: float
    steps: int
    exact: bool  # an exact transition law exists
    setup: tuple  # parameters that are not the model's but of how it starts or where it is

    @property
    def parameters(self):
        """{name: default}; a trailing underscore keeps Python's keywords apart from the field's symbols."""
        return {key.rstrip("_"): value.default for key, value in inspect.signature(self.make).parameters.items() if key != "run"}


TRUTHS = {}


def truth(unit, agents, seconds, fps, model=None, steps=10, exact=False, setup=()):
    """Register the decorated function as a truth of its own name."""
    def register(make):
        TRUTHS[make.__name__] = Truth(make.__name__, make, model, unit, agents, seconds, fps, steps, exact, setup)
        return make
    return register


def generate(name, seed=1, agents=None, seconds=None, fps=None, steps=None, exact=False, settings=None):
    """(positions, parameters, run) of the named truth; `settings` override its parameters. Same seed, same positions."""
    kind = TRUTHS[name]
    if exact and not kind.exact:
        raise SystemExit(f"{name}: no exact transition law is known; leave out --exact")
    unknown = set(settings or {}) - set(kind.parameters)
    if unknown:
        raise SystemExit(f"{name}: no parameter {', '.join(sorted(unknown))}; it has {', '.join(kind.parameters)}")
    fps = fps or kind.fps
    frames = round((seconds or kind.seconds) * fps)
    run = Run(generator(seed, name, "motion"), agents or kind.agents, frames, 1.0 / fps, steps or kind.steps, exact)
    parameters = {**kind.parameters, **(settings or {})}
    keywords = {key: parameters[key.rstrip("_")] for key in inspect.signature(kind.make).parameters if key != "run"}
    return kind.make(run, **keywords), parameters, run


def generator(seed, name, purpose):
    """Random numbers for one purpose, so that a camera's error does not change the motion it looks at."""
    return np.random.default_rng([seed, zlib.crc32(name.encode()), zlib.crc32(purpose.encode())])


# ---- tools of the integrators --------------------------------------------------------------------------------------------------

def unit(a):
    """a / |a| along the last axis; 0 where a is 0."""
    length = np.linalg.norm(a, axis=-1, keepdims=True)
    return np.divide(a, length, out=np.zeros_like(a), where=length > 0)


def offsets(x):
    """From each agent to each other: vectors r[i, j] = x[j] - x[i], and distances with infinity on the diagonal."""
    r = x[None, :, :] - x[:, None, :]
    d = np.linalg.norm(r, axis=-1)
    np.fill_diagonal(d, np.inf)
    return r, d


def total(weights, vectors):
    """Sum over j of weights[i, j] vectors[i, j]."""
    return np.einsum("ij,ijk->ik", weights.astype(float), vectors)


def mean_where(inside, vectors):
    """Mean over the j with inside[i, j] of vectors[i, j]; 0 where there is none."""
    return total(inside, vectors) / np.maximum(inside.sum(axis=1), 1)[:, None]


def isotropic(rng, n, dims):
    """Random directions, uniform on the sphere or circle."""
    return unit(rng.standard_normal((n, dims)))


def in_ball(rng, n, dims, radius):
    """Places uniform in a ball or disc about the origin."""
    return isotropic(rng, n, dims) * radius * rng.random((n, 1)) ** (1.0 / dims)


def perpendicular(rng, u):
    """A random unit vector at right angles to each u."""
    w = rng.standard_normal(u.shape)
    return unit(w - np.sum(w * u, axis=-1, keepdims=True) * u)


def record(run, state, step, warm_up=0.0):
    """Positions at every frame. `step(state)` is the state one integration step later, state[0] the positions."""
    for _ in range(round(warm_up / run.h)):
        state = step(state)
    positions = np.empty((run.frames,) + state[0].shape)
    for frame in range(run.frames):
        if frame:
            for _ in range(run.steps):
                state = step(state)
        positions[frame] = state[0]
    return positions


def record_map(run, state, decide, tau, warm_up=0):
    """Positions at every frame of a map with one decision every tau seconds, and straight flight in between."""
    for _ in range(warm_up):
        state = decide(state)
    times = np.arange(run.frames) * (run.interval / tau)  # [decisions]
    corners = [state[0]]
    while len(corners) < times[-1] + 2:
        state = decide(state)
        corners.append(state[0])
    corners = np.array(corners)
    before = np.floor(times + 1e-9).astype(int)
    share = np.maximum(times - before, 0.0)[:, None, None]
    return corners[before] + share * (corners[before + 1] - corners[before])


# ---- linear systems, exactly ---------------------------------------------------------------------------------------------------

def matrix_exponential(a):
    """By Taylor's series of a / 2^s, squared s times."""
    squarings = max(0, math.ceil(math.log2(max(np.abs(a).sum(axis=1).max(), 1e-300))) + 2)
    a = a / 2.0 ** squarings
    term = result = np.eye(len(a))
    for n in range(1, 20):
        term = term @ a / n
        result = result + term
    for _ in range(squarings):
        result = result @ result
    return result


def transition(a, q, h):
    """(Phi, Sigma) of dz = a z dt + noise of intensity q: z(t + h) is normal about Phi z(t) with covariance Sigma (Van Loan 1978)."""
    n = len(a)
    scale = np.abs(q).max()  # Sigma is linear in q; a large q would cost digits of everything else
    e = matrix_exponential(h * np.block([[-a, q / scale], [np.zeros((n, n)), a.T]]))
    phi = e[n:, n:].T
    sigma = scale * phi @ e[:n, n:]
    return phi, (sigma + sigma.T) / 2


def stationary_covariance(a, q):
    """S with a S + S a^T + q = 0."""
    eye = np.eye(len(a))
    s = np.linalg.solve(np.kron(a, eye) + np.kron(eye, a), -q.ravel()).reshape(a.shape)
    return (s + s.T) / 2


def linear_start(run, a, q, dims=3):
    """A state from the stationary law: components x agents x dimensions, the position first."""
    factor = np.linalg.cholesky(stationary_covariance(a, q))
    return np.einsum("ab,bij->aij", factor, run.rng.standard_normal((len(a), run.agents, dims)))


def record_linear(run, a, q, z):
    """Positions at every frame of the linear system, by its exact transition law over a frame."""
    phi, sigma = transition(a, q, run.interval)
    factor = np.linalg.cholesky(sigma)
    positions = np.empty((run.frames,) + z.shape[1:])
    for frame in range(run.frames):
        if frame:
            z = np.einsum("ab,bij->aij", phi, z) + np.einsum("ab,bij->aij", factor, run.rng.standard_normal(z.shape))
        positions[frame] = z[0]
    return positions


# ---- independent particles -----------------------------------------------------------------------------------------------------

def brownian_system(gamma1, D, k):
    return np.array([[0.0, 1.0], [-k, gamma1]]), np.array([[0.0, 0.0], [0.0, 2.0 * D]])


def brownian_step(run, gamma1, gamma2, D, k, C_r=0.0, l_r=1.0):
    """Semi-implicit Euler-Maruyama: positions move on with the new velocities."""
    kick = math.sqrt(2.0 * D * run.h)

    def step(state):
        x, v = state
        force = (gamma1 - gamma2 * np.sum(v * v, axis=1, keepdims=True)) * v - k * x
        if C_r:
            r, d = offsets(x)
            force -= total(C_r / l_r * np.exp(-d / l_r) / d, r)
        v = v + force * run.h + kick * run.rng.standard_normal(x.shape)
        return x + v * run.h, v

    return step


@truth("mm", 10, 5, 100, model="brownian", exact=True)
def brownian(run, gamma1=-1.67, gamma2=0.0, D=28167.0, k=5.0, C_r=0.0):
    """Damped Brownian particles in a harmonic trap.

        dx = v dt,   dv = (gamma1 v - k x) dt + sqrt(2 D) dW        gamma1 = -1.67 /s (friction), D = 28167 mm²/s³, k = 5 /s²

    Source: Uhlenbeck and Ornstein 1930; Schweitzer, Ebeling and Tilch 1998 with constant friction. Starts from the stationary law. gamma2
    and C_r are swarmfit's, and 0. --exact: the law of the differential equation itself, without any step.

    Facts, per axis: <v²> = D / |gamma1| = 130² (mm/s)², <x²> = D / (|gamma1| k) = 58² mm². Over frames T short against 1 / |gamma1| the
    second differences of positions have variance 2 D T³ (2/3 + 1 / (3 n²)) and lag-1 correlation (n² - 1) / (4 n² + 2) with n steps per
    frame: 2 D T³ and 0 for n = 1, 2/3 of it and 1/4 for n large and for --exact.
    """
    if gamma2 or C_r:
        raise SystemExit("brownian: gamma2 and C_r are 0 here; see rayleigh")
    a, q = brownian_system(gamma1, D, k)
    z = linear_start(run, a, q)
    return record_linear(run, a, q, z) if run.exact else record(run, tuple(z), brownian_step(run, gamma1, 0.0, D, k))


@truth("mm", 12, 5, 100, model="brownian")
def rayleigh(run, gamma1=2.0, gamma2=5e-5, D=20000.0, k=5.0, C_r=0.0, l_r=20.0):
    """Active Brownian particles with Rayleigh-Helmholtz friction in a harmonic trap.

        dv = ((gamma1 - gamma2 v²) v - k x + F) dt + sqrt(2 D) dW        gamma1 = 2 /s, gamma2 = 5e-5 s/mm², D = 20000 mm²/s³, k = 5 /s²
        F  = sum over j of C_r / l_r exp(-d / l_r) (x - x_j) / d         C_r = 0: off; l_r = 20 mm

    Source: Rayleigh's friction as in Erdmann, Ebeling, Schimansky-Geier and Schweitzer 2000; repulsion of D'Orsogna et al. 2006. Warm-up of
    10 s.

    Facts: the preferred speed is sqrt(gamma1 / gamma2) = 200 mm/s. Without trap (k = 0) speeds are distributed as
    v² exp((gamma1 v² / 2 - gamma2 v⁴ / 4) / D). F adds no momentum.
    """
    x = run.rng.standard_normal((run.agents, 3)) * math.sqrt(gamma1 / gamma2 / max(k, 1.0) / 3.0)
    v = isotropic(run.rng, run.agents, 3) * math.sqrt(gamma1 / gamma2)
    return record(run, (x, v), brownian_step(run, gamma1, gamma2, D, k, C_r, l_r), warm_up=10.0)


def langevin_system(tau_v, k, tau_eta, sigma_eta):
    a = np.array([[0.0, 1.0, 0.0], [-k, -1.0 / tau_v, 1.0], [0.0, 0.0, -1.0 / tau_eta]])
    return a, np.diag([0.0, 0.0, 2.0 * sigma_eta ** 2 / tau_eta])


def langevin_step(run, tau_v, k, tau_eta, sigma_eta):
    """Semi-implicit Euler-Maruyama; the noise comes first, then the velocity, then the position."""
    kick = sigma_eta * math.sqrt(2.0 * run.h / tau_eta)

    def step(state):
        x, v, eta = state
        eta = eta - eta / tau_eta * run.h + kick * run.rng.standard_normal(x.shape)
        v = v + (eta - v / tau_v - k * x) * run.h
        return x + v * run.h, v, eta

    return step


@truth("mm", 10, 5, 100, model="langevin", exact=True)
def langevin(run, tau_v=0.6, k=5.0, tau_eta=0.1, sigma_eta=600.0):
    """Damped oscillators driven by coloured noise.

        dv = (-v / tau_v - k x + eta) dt,   deta = -eta / tau_eta dt + sigma_eta sqrt(2 / tau_eta) dW
        tau_v = 0.6 s, k = 5 /s², tau_eta = 0.1 s, sigma_eta = 600 mm/s²

    Source: Okubo 1986; A. M. Reynolds, Sinhuber and Ouellette 2017; Sawford 1991 for the noise. Starts from the stationary law.

    Facts, per axis, with a = 1 / tau_eta, g = 1 / tau_v, s = sigma_eta² / (k + a g + a²): <eta²> = sigma_eta², <v²> = s a / g, that is
    133² (mm/s)², and <x²> = s (a / g + 1) / k = 64² mm².
    """
    a, q = langevin_system(tau_v, k, tau_eta, sigma_eta)
    z = linear_start(run, a, q)
    return record_linear(run, a, q, z) if run.exact else record(run, tuple(z), langevin_step(run, tau_v, k, tau_eta, sigma_eta))


@truth("mm", 20, 6, 50)
def random_walk(run, step_rms=1.0):
    """Steps that know nothing of each other. No model of swarmfit.

        x(t + T) = x(t) + step_rms / sqrt(3) times a standard normal vector;   step_rms = 1 mm, start normal with 30 mm per axis

    Facts: per axis increments have variance step_rms² / 3 and no correlation in time, between axes or between agents.
    """
    steps = run.rng.standard_normal((run.frames, run.agents, 3)) * step_rms / math.sqrt(3.0)
    steps[0] = run.rng.standard_normal((run.agents, 3)) * 30.0 * step_rms
    return np.cumsum(steps, axis=0)


# ---- noise fields --------------------------------------------------------------------------------------------------------------

CORNERS = np.array(list(itertools.product((0, 1), repeat=3)))
# Perlin 2002: the middles of a cube's edges, and four of them again to make 16.
GRADIENTS = np.array([(1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (1, 0, 1), (-1, 0, 1), (1, 0, -1), (-1, 0, -1),
                      (0, 1, 1), (0, -1, 1), (0, 1, -1), (0, -1, -1), (1, 1, 0), (0, -1, 1), (-1, 1, 0), (0, -1, -1)], dtype=float)


class Perlin:
    """Three independent scalar fields of improved Perlin noise (Perlin 2002), one lattice cell per unit of length."""

    def __init__(self, rng):
        self.tables = np.array([rng.permutation(256) for _ in range(3)])
        self.shifts = rng.random((3, 3)) * 256.0  # without them all three vanish at the lattice points

    def __call__(self, x):
        """(P, J) at points x: values P[point, field] and derivatives J[point, field, axis]."""
        u = x[:, None, :] + self.shifts
        cell = np.floor(u).astype(int)
        f = u - cell
        fade = ((6.0 * f - 15.0) * f + 10.0) * f ** 3
        slope = 30.0 * (f * (f - 1.0)) ** 2
        corner = (cell[:, :, None, :] + CORNERS) & 255  # point, field, corner, axis
        field = np.arange(3)[None, :, None]
        hashed = self.tables[field, corner[..., 0]]
        hashed = self.tables[field, (hashed + corner[..., 1]) & 255]
        hashed = self.tables[field, (hashed + corner[..., 2]) & 255]
        gradient = GRADIENTS[hashed & 15]
        ramp = np.einsum("pfca,pfca->pfc", gradient, f[:, :, None, :] - CORNERS)
        share = np.where(CORNERS, fade[:, :, None, :], 1.0 - fade[:, :, None, :])
        rise = np.where(CORNERS, slope[:, :, None, :], -slope[:, :, None, :])
        weight = share.prod(axis=-1)
        change = np.stack([rise[..., a] * share[..., b] * share[..., c] for a, b, c in ((0, 1, 2), (1, 0, 2), (2, 0, 1))], axis=-1)
        values = np.einsum("pfc,pfc->pf", weight, ramp)
        return values, np.einsum("pfc,pfca->pfa", weight, gradient) + np.einsum("pfc,pfca->pfa", ramp, change)


def curl(J):
    """Curl of a field with derivatives J[point, component, axis]."""
    return np.column_stack([J[:, 2, 1] - J[:, 1, 2], J[:, 0, 2] - J[:, 2, 0], J[:, 1, 0] - J[:, 0, 1]])


def caged_curl(noise, x, gain, scale, cage):
    """Velocities curl N of Wang et al. 2014, eq 2 and 3, in a sphere about the origin: N = alpha P + (1 - alpha) (n P) n.

    With n = grad d, curl n = 0 and grad alpha along n:  curl N = alpha curl P + grad alpha x P + (1 - alpha) grad(n P) x n.
    """
    P, J = noise(x / scale)
    P, J = gain * P, gain / scale * J
    radius = np.linalg.norm(x, axis=1, keepdims=True)
    n = -x / np.maximum(radius, 1e-12)
    d0 = min(scale, cage)
    depth = (cage - radius) / d0
    q = np.clip(depth, 0.0, 1.0)
    alpha = q * (15.0 - 10.0 * q ** 2 + 3.0 * q ** 4) / 8.0
    slope = np.where((depth > 0.0) & (depth < 1.0), 15.0 * (1.0 - q ** 2) ** 2 / 8.0 / d0, 0.0)
    across = P - n * np.sum(n * P, axis=1, keepdims=True)
    change = np.einsum("pf,pfa->pa", n, J) - across / np.maximum(radius, 1e-12)  # grad(n P); n turns with x, too
    return alpha * curl(J) + np.cross(slope * n, P) + (1.0 - alpha) * np.cross(change, n)


@truth("mm", 20, 6, 50, model="noise_aware", steps=4)
def noise_aware(run, scale=100.0, gain=12000.0, cage=250.0):
    """Agents without inertia or interaction, carried by curl noise inside a cage.

        dx/dt = curl N(x),   N = alpha P + (1 - alpha) (n P) n,   P = gain Perlin(x / scale),   alpha = ramp(d / scale)
        d: distance to the cage, n: its inward normal, ramp(q) = (15 q - 10 q³ + 3 q⁵) / 8
        scale = 100 mm, gain = 12000 mm²/s, cage: sphere of 250 mm about the origin

    Source: Wang et al. 2014, eq 1 to 3, without goal and minimum distance; Bridson et al. 2007. Runge and Kutta's fourth-order step; starts
    uniform in nine tenths of the cage's radius, and an incompressible flow keeps it so but for the rim.

    Facts: div V = 0; V is tangential at the cage, so nobody leaves; away from the cage the rms speed is 1.72 gain / scale = 206 mm/s.
    """
    noise = Perlin(run.rng)
    h = run.h

    def velocity(x):
        return caged_curl(noise, x, gain, scale, cage)

    def step(state):
        x, = state
        k1 = velocity(x)
        k2 = velocity(x + h / 2.0 * k1)
        k3 = velocity(x + h / 2.0 * k2)
        k4 = velocity(x + h * k3)
        return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4),

    return record(run, (in_ball(run.rng, run.agents, 3, 0.9 * cage),), step)


# ---- bswarm --------------------------------------------------------------------------------------------------------------------

def bswarm_force(x, v, gamma, chi_rep, chi_att, r_rep, r_att):
    """Repulsion, attraction and drag of Ren et al. 2016, eq 3 and 5, with g = -1 and +1: unit vectors averaged over each zone."""
    drag = -gamma * np.linalg.norm(v, axis=1, keepdims=True) * v
    if not (chi_rep or chi_att):
        return drag
    r, d = offsets(x)
    rhat = unit(r)
    repulsion = mean_where(d < r_rep, rhat)
    attraction = mean_where((d >= r_rep) & (d <= r_rep + r_att), rhat)
    return chi_att * attraction - chi_rep * repulsion + drag


@truth("mm", 15, 5, 100, model="bswarm[noise=white,avoidance=none]")
def bswarm_white(run, gamma=0.008, lambda_=404.0, chi_rep=200.0, chi_att=900.0, r_rep=20.0, r_att=400.0):
    """Insect swarm by repulsion, attraction, quadratic drag and white noise.

        dv/dt = chi_att <rhat>_att - chi_rep <rhat>_rep - gamma |v| v + lambda sqrt(3 / h) W     W: uniform on [-1, 1) per component and step
        rhat: unit vectors to the others, averaged over d < r_rep and over r_rep <= d <= r_rep + r_att
        gamma = 0.008 /mm, lambda = 404 mm/s^1.5, chi_rep = 200, chi_att = 900 mm/s², r_rep = 20 mm, r_att = 400 mm

    Source: Ren et al. 2016, eq 2 to 5, noise W; scaled with the step h so that diffusion does not depend on it: the sum of many kicks is
    Brownian with intensity D = lambda² / 2 per axis. Semi-implicit Euler, warm-up of 8 s, no avoidance.

    Facts: a lone agent without attraction has speeds distributed as v² exp(-gamma v³ / (3 D)).
    """
    def step(state):
        x, v = state
        kicks = run.rng.uniform(-1.0, 1.0, x.shape) * (lambda_ * math.sqrt(3.0 * run.h))
        v = v + bswarm_force(x, v, gamma, chi_rep, chi_att, r_rep, r_att) * run.h + kicks
        return x + v * run.h, v

    start = in_ball(run.rng, run.agents, 3, 100.0), isotropic(run.rng, run.agents, 3) * 150.0
    return record(run, start, step, warm_up=8.0)


@truth("mm", 15, 5, 100, model="bswarm[avoidance=none]", steps=5)
def bswarm_curl(run, gamma=0.02, noise=897.0, scale=50.0, chi_rep=600.0, chi_att=900.0, r_rep=40.0, r_att=400.0):
    """The same swarm with curl noise, a field fixed in space and the same for all.

        force: noise / 0.9962 curl P(x / scale) instead of lambda sqrt(3 / h) W
        gamma = 0.02 /mm, noise = 897 mm/s² (root mean square per component), scale = 50 mm, chi_rep = 600, chi_att = 900 mm/s², r_rep = 40 mm, r_att = 400 mm

    Source: Ren et al. 2016, eq 2 to 5, noise C; Perlin 2002; Bridson et al. 2007. Semi-implicit Euler, warm-up of 5 s, no avoidance.

    Facts: the field has no divergence and 1.73 noise rms; two agents at one place and velocity feel the same force.
    """
    field = Perlin(run.rng)

    def step(state):
        x, v = state
        force = bswarm_force(x, v, gamma, chi_rep, chi_att, r_rep, r_att) + noise / 0.9962 * curl(field(x / scale)[1])
        v = v + force * run.h
        return x + v * run.h, v

    start = in_ball(run.rng, run.agents, 3, 100.0), isotropic(run.rng, run.agents, 3) * 150.0
    return record(run, start, step, warm_up=5.0)


# ---- constant speed ------------------------------------------------------------------------------------------------------------

def boids_steering(x, v, radius):
    """Separation, alignment and cohesion."""
    r, d = offsets(x)
    seen = d < radius
    separation = -total((d < radius / 2) / d ** 2, r)
    alignment = mean_where(seen, v[None, :, :] - v[:, None, :])
    cohesion = mean_where(seen, r)
    return 1.5 * unit(separation) + unit(alignment) + unit(cohesion)


@truth("m", 25, 6, 50, model="boids")
def boids(run, speed=1.0, radius=6.0, tau=1.5):
    """Reynolds' rules at constant speed, in the two-parameter form of Ren et al. 2016.

        v = speed unit(v + speed / tau h (1.5 unit(S) + unit(A) + unit(C))),   x = x + v h
        S = sum over d < radius / 2 of (x - x_j) / d²,   A and C: means over d < radius of v_j - v and of x_j - x
        speed = 1 m/s, radius = 6 m, tau = 1.5 s

    Source: C. W. Reynolds 1987; constant speed and weights as described for swarmfit. Deterministic but for its start, in a ball of that
    radius with random headings: a transient, in which all turn. Flocks of these rules end in parallel flight, this one after some 7 s.

    Facts: every step is `speed` h long; frames are `speed` T apart but for the bend of the path between them.
    """
    def step(state):
        x, v = state
        v = speed * unit(v + speed / tau * run.h * boids_steering(x, v, radius))
        return x + v * run.h, v

    start = in_ball(run.rng, run.agents, 3, radius), isotropic(run.rng, run.agents, 3) * speed
    return record(run, start, step)


def zonal_wish(x, u, r_rep, r_ori, r_att):
    """The direction each agent wants: away from the near ones, else along with those about it and towards the far ones."""
    r, d = offsets(x)
    rhat = unit(r)
    near = d <= r_rep
    orientation = (d > r_rep) & (d <= r_rep + r_ori)
    attraction = (d > r_rep + r_ori) & (d <= r_rep + r_ori + r_att)
    wish = np.where(near.any(axis=1)[:, None], -total(near, rhat), orientation.astype(float) @ u + total(attraction, rhat))
    return np.where(np.linalg.norm(wish, axis=1, keepdims=True) > 1e-12, unit(wish), u)


def turn_towards(rng, u, target, most):
    """Unit vectors u turned towards unit vectors `target` by at most `most` radians, through a random side if they are opposite."""
    cosine = np.sum(u * target, axis=1, keepdims=True)
    side = target - cosine * u
    sine = np.linalg.norm(side, axis=1, keepdims=True)
    side = np.where(sine > 1e-12, side / np.maximum(sine, 1e-12), perpendicular(rng, u))
    angle = np.minimum(np.arctan2(sine, cosine), most)
    return unit(np.cos(angle) * u + np.sin(angle) * side)


@truth("su", 30, 30, 10, model="zonal")
def couzin(run, speed=3.0, turning=math.radians(100.0), sigma=0.2, r_rep=1.0, r_ori=2.5, r_att=8.0, tau=0.1):
    """Repulsion, orientation and attraction in nested zones, a bounded rate of turning, decisions every tau.

        anybody within r_rep:  D = -sum of rhat over them;   else D = sum of u_j over the shell r_ori + sum of rhat over the shell r_att
        D turned by a normal angle of standard deviation sigma;  u turned towards D by at most turning tau;  x = x + speed tau u
        speed = 3 /s, turning = 100 deg/s, sigma = 0.2 rad, r_rep = 1, widths r_ori = 2.5, r_att = 8, tau = 0.1 s; unit: r_rep

    Source: Couzin et al. 2002, eq 1 to 3, in the form of Strömbom 2013, section 1.2.1 (sums over both zones, no blind angle). Turning and
    sigma are the largest of table 1 of 2002: with 40 deg/s and 0.05 rad 30 agents mill or freeze. Warm-up of 60 s. More than one frame per
    decision (--fps) shows straight flight in between, where swarmfit's zonal flies arcs.

    Facts: frames a decision apart are speed tau apart; headings turn by at most turning tau.
    """
    def decide(state):
        x, u = state
        wish = zonal_wish(x, u, r_rep, r_ori, r_att)
        error = run.rng.normal(0.0, sigma, (run.agents, 1))
        wish = unit(np.cos(error) * wish + np.sin(error) * perpendicular(run.rng, wish))
        u = turn_towards(run.rng, u, wish, turning * tau)
        return x + speed * tau * u, u

    start = in_ball(run.rng, run.agents, 3, 4.0), isotropic(run.rng, run.agents, 3)
    return record_map(run, start, decide, tau, warm_up=600)


def vicsek_decision(run, speed, radius, eta, tau, box=None):
    """One step of Vicsek et al. 1995, eq 1 and 2: positions move with the old headings, neighbours are those before the move."""
    def decide(state):
        x, theta = state
        r = x[None, :, :] - x[:, None, :]
        if box:
            r = r - box * np.round(r / box)
        seen = np.linalg.norm(r, axis=-1) < radius  # itself included
        heading = np.angle(seen.astype(float) @ np.exp(1j * theta))
        move = speed * tau * np.column_stack([np.cos(theta), np.sin(theta)])
        return x + move, heading + run.rng.uniform(-eta / 2.0, eta / 2.0, run.agents)

    return decide


@truth("m", 60, 8, 25, model="vicsek", setup=("disc",))
def vicsek(run, speed=0.2, radius=0.3, eta=2.2, tau=0.0, disc=0.5):
    """Alignment with noise in the open plane, one decision per frame.

        theta(t + T) = arg sum over d < radius of exp(i theta_j(t)) + U[-eta/2, eta/2],   x(t + T) = x(t) + speed T e(theta(t))
        speed = 0.2 m/s, radius = 0.3 m, eta = 2.2 rad, T = tau, 0: the frame interval; start in a disc of radius 0.5 m

    Source: Vicsek et al. 1995, eq 1 and 2. Nothing but alignment holds them together; they start dense enough to stay aligned for as long
    as the recording. The first ten decisions, in which they align, are left out. Noise is per decision: another tau is another model.

    Facts: frames are speed T apart; with eta = 0 the order parameter goes to 1.
    """
    tau = tau or run.interval
    start = in_ball(run.rng, run.agents, 2, disc), run.rng.uniform(-math.pi, math.pi, run.agents)
    return record_map(run, start, vicsek_decision(run, speed, radius, eta, tau), tau, warm_up=10)


@truth("m", 60, 8, 25, model="vicsek", setup=("box",))
def vicsek_periodic(run, speed=0.5, radius=0.3, eta=2.0, tau=0.0, box=2.0):
    """Alignment with noise in a periodic box, as published.

        as vicsek; speed = 0.5 m/s, radius = 0.3 m, eta = 2 rad, box = 2 m; warm-up of 250 decisions

    Positions are written unwrapped: tracks are continuous, but neighbours across an edge of the box are not near each other in the file.
    --wrapped jumps writes them in the box, with a jump at each crossing; --wrapped tracks begins a new id there, as a camera above the box
    would.

    Facts: as vicsek; unwrapped frames are speed T apart, wrapped positions lie in [0, box).
    """
    tau = tau or run.interval
    start = run.rng.random((run.agents, 2)) * box, run.rng.uniform(-math.pi, math.pi, run.agents)
    positions = record_map(run, start, vicsek_decision(run, speed, radius, eta, tau, box), tau, warm_up=250)
    return positions - box * np.floor(positions[0] / box)


# ---- collision avoidance -------------------------------------------------------------------------------------------------------

def half_spaces(p, v, others_p, others_v, radius, tau, h):
    """(points, normals): velocities w with (w - point) normal >= 0 avoid the others for tau if these do their half.

    Van den Berg et al. 2011, section 4: in relative velocities the obstacle is a cone with its apex at 0, tangent to the ball of radius
    R / tau about r / tau and cut off by it. Half of the shortest way out of it is for this agent to go. Overlapping agents part within h.
    """
    r, w = others_p - p, v - others_v
    R = 2.0 * radius
    distance = np.linalg.norm(r, axis=1)
    overlapping = distance <= R
    time = np.where(overlapping, h, tau)[:, None]
    e = r / np.maximum(distance, 1e-12)[:, None]
    sine = np.minimum(R / np.maximum(distance, 1e-12), 1.0)[:, None]
    along = np.sum(w * e, axis=1, keepdims=True)
    side = unit(w - along * e)
    lost = ~side.any(axis=1)  # flying straight at the other: any side will do
    if lost.any():
        side[lost] = unit(np.cross(e[lost], np.where(np.abs(e[lost, :1]) < 0.9, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))))
    cone = np.sqrt(1.0 - sine ** 2) * side - sine * e  # outward normal of the cone
    from_centre = w - r / time
    cap = unit(from_centre)
    # In front of the circle where ball and cone touch, the nearest surface is the ball's.
    in_front = overlapping[:, None] | (np.sum(cap * e, axis=1, keepdims=True) < -sine)
    normal = np.where(in_front, cap, cone)
    depth = np.where(in_front, R / time - np.linalg.norm(from_centre, axis=1, keepdims=True), -np.sum(w * cone, axis=1, keepdims=True))
    return v + depth * normal / 2.0, normal


@functools.lru_cache(maxsize=None)
def subsets(n, size):
    """All choices of `size` among n, one per row."""
    return np.array(list(itertools.combinations(range(n), size)), dtype=int).reshape(-1, size)


def nearest_velocity(wish, points, normals, most, slack=0.0):
    """The w nearest to `wish` with (w - point) normal >= -slack for all and |w| <= most, or None if there is none.

    The nearest point of a convex set is nearest on the surfaces it lies on, so it is among the points nearest to `wish` on every
    intersection of at most three planes, and of at most two with the sphere. All of them are tried: a few hundred for ten neighbours.
    """
    levels = np.sum(points * normals, axis=1) - slack
    tolerance = 1e-11 * most

    def allowed(w):
        return np.all(w @ normals.T >= levels - tolerance, axis=1) & (np.linalg.norm(w, axis=1) <= most + tolerance)

    # Nearest for one broken rule alone, and within all the others: nearest for all. Saves most of the work.
    lacking = levels - normals @ wish
    candidates = [wish[None, :], min(1.0, most / max(np.linalg.norm(wish), 1e-300)) * wish[None, :]]
    candidates.append((wish + lacking[:, None] * normals)[lacking > 0.0])
    alone = np.concatenate(candidates)
    alone = alone[allowed(alone)]
    if len(alone):
        return alone[np.argmin(np.linalg.norm(alone - wish, axis=1))]
    for size in (1, 2, 3):
        chosen = subsets(len(levels), size)
        n = normals[chosen]
        gram = n @ n.transpose(0, 2, 1)
        usable = np.linalg.det(gram) > 1e-12
        n, gram, level = n[usable], gram[usable], levels[chosen][usable]
        if not len(n):
            continue
        on_planes = wish + np.einsum("ca,caj->cj", np.linalg.solve(gram, (level - n @ wish)[..., None])[..., 0], n)
        candidates.append(on_planes)
        if size < 3:
            middle = np.einsum("ca,caj->cj", np.linalg.solve(gram, level[..., None])[..., 0], n)
            left = most ** 2 - np.sum(middle ** 2, axis=1, keepdims=True)
            meets = left[:, 0] >= 0.0
            away = unit(on_planes - middle)
            candidates.append((middle + np.sqrt(np.maximum(left, 0.0)) * away)[meets])
    candidates = np.concatenate(candidates)
    candidates = candidates[allowed(candidates)]
    return candidates[np.argmin(np.linalg.norm(candidates - wish, axis=1))] if len(candidates) else None


def avoiding_velocity(wish, points, normals, most):
    """The allowed velocity nearest to `wish`; where there is none, one that breaks the worst rule least, by bisection of a common slack."""
    velocity = nearest_velocity(wish, points, normals, most)
    if velocity is not None:
        return velocity
    low, high = 0.0, 2.0 * most + np.max(np.abs(np.sum(points * normals, axis=1)))
    while high - low > 1e-10 * most:
        middle = (low + high) / 2.0
        if nearest_velocity(wish, points, normals, most, middle) is None:
            low = middle
        else:
            high = middle
    return nearest_velocity(wish, points, normals, most, high)


def orca(x, v, wishes, radius, tau, h, most, reach, count):
    """New velocities of all agents: each looks at its `count` nearest within `reach`."""
    _, d = offsets(x)
    new = np.empty_like(v)
    for i, wish in enumerate(wishes):
        near = np.argsort(d[i], kind="stable")[:count]
        near = near[d[i, near] < reach]
        new[i] = avoiding_velocity(wish, *half_spaces(x[i], v[i], x[near], v[near], radius, tau, h), most)
    return new


@truth("mm", 15, 8, 25, model="rvo")
def rvo(run, neighbour_distance=150.0, max_neighbours=8, radius=15.0, max_speed=200.0, time_horizon=1.0, goal_radius=150.0, goal_time=5.0,
        jitter=0.001):
    """Agents that head for goals and avoid each other.

        wish = max_speed unit(goal - x) + jitter,   v = the velocity nearest to it that avoids all near for time_horizon,   x = x + v h
        goals uniform in a ball of radius goal_radius, new when nearer than two agents' radii or after goal_time
        neighbour_distance = 150 mm, max_neighbours = 8, radius = 15 mm, max_speed = 200 mm/s, time_horizon = 1 s, goal_radius = 150 mm,
        goal_time = 5 s, jitter = 0.001 max_speed

    Source: van den Berg, Guy, Lin and Manocha 2011, sections 4 and 5, in three dimensions. Warm-up of 2 s.

    Facts: nobody is faster than max_speed; agents that start apart stay 2 radius apart; a lone agent flies straight at its goal.
    """
    def step(state):
        x, v, goal, age = state
        new = (np.linalg.norm(goal - x, axis=1) < 2.0 * radius) | (age >= goal_time)
        goal = np.where(new[:, None], in_ball(run.rng, run.agents, 3, goal_radius), goal)
        age = np.where(new, 0.0, age + run.h)
        wishes = max_speed * (unit(goal - x) + jitter * isotropic(run.rng, run.agents, 3))
        v = orca(x, v, wishes, radius, time_horizon, run.h, max_speed, neighbour_distance, int(max_neighbours))
        return x + v * run.h, v, goal, age

    x = in_ball(run.rng, run.agents, 3, goal_radius)
    while offsets(x)[1].min() < 2.5 * radius:
        x = in_ball(run.rng, run.agents, 3, goal_radius)
    start = x, np.zeros_like(x), in_ball(run.rng, run.agents, 3, goal_radius), np.zeros(run.agents)
    return record(run, start, step, warm_up=2.0)


# ---- none of swarmfit's models -------------------------------------------------------------------------------------------------

def pedestrian_repulsion(x, v, e, V0, sigma, stride, sight, behind):
    """Minus the gradient of the elliptical potentials of Helbing and Molnár 1995, weaker from behind."""
    r = x[:, None, :] - x[None, :, :]  # from b to a
    y = stride * np.linalg.norm(v, axis=1, keepdims=True) * e  # where b will be
    d1 = np.linalg.norm(r, axis=-1)
    d2 = np.linalg.norm(r - y, axis=-1)
    b = np.sqrt(np.maximum((d1 + d2) ** 2 - np.sum(y * y, axis=-1), 1e-8)) / 2.0
    slope = ((d1 + d2) / (4.0 * b))[..., None] * (unit(r) + unit(r - y))  # grad b
    force = (V0 / sigma * np.exp(-b / sigma))[..., None] * slope
    seen = np.einsum("aj,abj->ab", e, -force) >= np.linalg.norm(force, axis=-1) * math.cos(sight)
    weight = np.where(seen, 1.0, behind)
    np.fill_diagonal(weight, 0.0)
    return np.einsum("ab,abj->aj", weight, force)


@truth("m", 30, 20, 25, steps=8)
def crowd(run, v0=1.34, v0_sd=0.26, tau=0.5, V0=2.1, sigma=0.3, U0=10.0, R=0.2, stride=2.0, sight=math.radians(100.0), behind=0.5,
          fluctuation=0.1, length=15.0, width=5.0):
    """Pedestrians with goals on the two sides of a corridor, by social forces. No model of swarmfit.

        dw/dt = (v0 e - w) / tau + repulsion from others and walls + fluctuations,   v = w, at most 1.3 v0
        potentials: V0 exp(-b / sigma) of others, b half the minor axis of the ellipse through the walker whose foci are where the other is
        and will be after `stride`; U0 exp(-d / R) of walls. Others at more than `sight` from the walker's direction count `behind`
        v0 normal, 1.34 and 0.26 m/s; tau = 0.5 s, V0 = 2.1 and U0 = 10 m²/s², sigma = 0.3 and R = 0.2 m, stride = 2 s, sight = 100 deg,
        behind = 0.5, fluctuation = 0.1 m/s^1.5, corridor 15 m x 5 m

    Source: Helbing and Molnár 1995, sections II and III, without attraction. Who arrives turns round, so that all stay. Warm-up of 5 s.

    Facts: nobody is faster than 1.3 v0 or outside the walls; a lone walker without fluctuations approaches v0 at rate 1 / tau.
    """
    wanted = np.clip(run.rng.normal(v0, v0_sd, (run.agents, 1)), v0 / 2.0, 2.0 * v0)

    def step(state):
        x, v, goal = state
        goal = np.where(x[:, :1] > length / 2.0, -1.0, np.where(x[:, :1] < -length / 2.0, 1.0, goal))
        e = np.hstack([goal, np.zeros_like(goal)])
        walls = np.exp(-(width / 2.0 + x[:, 1]) / R) - np.exp(-(width / 2.0 - x[:, 1]) / R)
        force = (wanted * e - v) / tau + pedestrian_repulsion(x, v, e, V0, sigma, stride, sight, behind)
        force[:, 1] += U0 / R * walls
        v = v + force * run.h + fluctuation * math.sqrt(run.h) * run.rng.standard_normal(x.shape)
        speed = np.linalg.norm(v, axis=1, keepdims=True)
        v = v * np.minimum(1.0, 1.3 * wanted / np.maximum(speed, 1e-12))
        return x + v * run.h, v, goal

    x = (run.rng.random((run.agents, 2)) - 0.5) * (length, 0.8 * width)
    goal = np.where(np.arange(run.agents) % 2, 1.0, -1.0)[:, None]
    return record(run, (x, wanted * np.hstack([goal, np.zeros_like(goal)]), goal), step, warm_up=5.0)


@truth("mm", 20, 5, 100)
def mixture(run, tau_v=0.6, k=5.0, tau_eta=0.1, sigma_eta=600.0, speed=250.0, k_turn=6.0, D_r=0.3):
    """Two kinds in one swarm, langevin's oscillators (first half of the ids) and cruisers at constant speed. No model of swarmfit.

        oscillators: as langevin;   cruisers: dx = speed u dt,   du = across u of (-k_turn x / speed dt + sqrt(2 D_r) dW)
        tau_v = 0.6 s, k = 5 /s², tau_eta = 0.1 s, sigma_eta = 600 mm/s²; speed = 250 mm/s, k_turn = 6 /s², D_r = 0.3 /s

    Source: as langevin; active Brownian particles, Romanczuk et al. 2012, section 3, with a centripetal turn. Cruisers warm up for 10 s.

    Facts: the speed of the second half is constant, that of the first has langevin's law.
    """
    half = run.agents // 2
    first = langevin(dataclasses.replace(run, agents=half), tau_v, k, tau_eta, sigma_eta)

    def step(state):
        x, u = state
        push = -k_turn / speed * x * run.h + math.sqrt(2.0 * D_r * run.h) * run.rng.standard_normal(x.shape)
        u = unit(u + push - np.sum(push * u, axis=1, keepdims=True) * u)
        return x + speed * u * run.h, u

    start = in_ball(run.rng, run.agents - half, 3, 100.0), isotropic(run.rng, run.agents - half, 3)
    return np.concatenate([first, record(run, start, step, warm_up=10.0)], axis=1)


# ---- what a camera makes of it -------------------------------------------------------------------------------------------------

def gaps(rng, frames, agents, probability, longest=5):
    """Where an agent is missed: at a frame after one in which it was seen a gap of 1 to `longest` frames begins with `probability`."""
    missed = np.zeros((frames, agents), dtype=bool)
    for agent in range(agents):
        frame = 0
        while frame < frames:
            if frame and not missed[frame - 1, agent] and rng.random() < probability:
                length = int(rng.integers(1, longest + 1))
                missed[frame:frame + length, agent] = True
                frame += length
            else:
                frame += 1
    return missed


def presence(rng, frames, agents, shortest=10):
    """Where an agent is there: one stretch each, a quarter to all of the recording long, of which it may cut off either end."""
    shortest = min(shortest, frames)
    length = rng.integers(max(frames // 4, shortest), frames + 1, agents)
    first = rng.integers(shortest - length, frames - shortest + 1)
    frame = np.arange(frames)[:, None]
    return (frame >= first) & (frame < first + length)


def flown_per_frame(positions):
    """Mean distance over agents and frames."""
    return float(np.linalg.norm(np.diff(positions, axis=0), axis=-1).mean()) if len(positions) > 1 else 0.0


def observe(positions, seed, name, error=0.0, gap=0.0, irregular=False, box=None, wrapped=None):
    """(positions, seen, tracks) as a tracker would report them.

    `error` is in units of the mean distance flown per frame. tracks[frame, agent] numbers the visits of an agent to a wrapped box.
    """
    frames, agents, _ = positions.shape
    noise = error * flown_per_frame(positions) * generator(seed, name, "error").standard_normal(positions.shape)
    tracks = np.zeros((frames, agents), dtype=int)
    if wrapped:
        cell = np.floor(positions / box)
        positions = np.mod(positions, box)
        if wrapped == "tracks":
            tracks[1:] = np.cumsum(np.any(np.diff(cell, axis=0) != 0, axis=-1), axis=0)
    positions = positions + noise
    seen = ~gaps(generator(seed, name, "gaps"), frames, agents, gap)
    if irregular:
        seen &= presence(generator(seed, name, "presence"), frames, agents)
    return positions, seen, tracks


def csv_lines(positions, seen, tracks, kind, fps, decimals):
    """The file's lines; ids count from 1 in the order of agents and visits."""
    number = "%.17g" if decimals >= 17 else f"%.{decimals}f"
    yield f"# synthetic: made by tests/independent/truths.py, {kind.name}"
    yield f"# unit: {kind.unit}"
    yield f"# fps: {fps:.17g}"
    yield "id,frame," + ",".join("xyz"[:positions.shape[2]])
    row = "%d,%d" + f",{number}" * positions.shape[2]
    name = 0
    for agent in range(positions.shape[1]):
        for visit in range(tracks[-1, agent] + 1):
            frames = np.flatnonzero(seen[:, agent] & (tracks[:, agent] == visit))
            name += len(frames) > 0
            for frame in frames:
                yield row % (name, frame, *positions[frame, agent])


# ---- command line --------------------------------------------------------------------------------------------------------------

def setting(text):
    key, _, value = text.partition("=")
    try:
        return key, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: expected NAME=NUMBER") from None


def arguments(argv):
    parser = argparse.ArgumentParser(description="Recordings of known origin, made by simulators that share no code with swarmfit.")
    parser.add_argument("name", nargs="?", choices=sorted(TRUTHS), metavar="NAME", help="truth; --list names them")
    parser.add_argument("--list", action="store_true", help="name the truths and stop")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", help="CSV file to write; - for standard output")
    parser.add_argument("--truth", help="JSON file to write: model and parameters")
    parser.add_argument("--agents", type=int)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--fps", type=float)
    parser.add_argument("--steps", type=int, help="integration steps per frame")
    parser.add_argument("--exact", action="store_true", help="the exact transition law instead of an integrator")
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="NAME=VALUE", help="another value of a parameter")
    parser.add_argument("--error", type=float, default=0.0, metavar="SIGMA",
                        help="white Gaussian localisation error per axis, in units of the mean distance flown per frame")
    parser.add_argument("--decimals", type=int, default=6, help="of the positions; 17: full precision")
    parser.add_argument("--gaps", type=float, default=0.0, metavar="P", help="probability that a gap of 1 to 5 frames begins")
    parser.add_argument("--presence", choices=["all", "irregular"], default="all", help="irregular: individuals come and go")
    parser.add_argument("--wrapped", choices=["jumps", "tracks"], help="periodic box: write positions within it")
    options = parser.parse_args(argv)
    if not options.list and not (options.name and options.out):
        parser.error("expected NAME and --out FILE.csv, or --list")
    if options.wrapped and "box" not in TRUTHS[options.name].parameters:
        parser.error(f"--wrapped: {options.name} has no periodic box")
    return options


def write(path, text):
    if path == "-":
        sys.stdout.write(text)
        return
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def main(argv=None):
    options = arguments(argv)
    if options.list:
        for kind in TRUTHS.values():
            summary = inspect.getdoc(kind.make).splitlines()[0]
            print(f"{kind.name:16} {kind.model or '-':36} {summary}")
        return
    kind = TRUTHS[options.name]
    positions, parameters, run = generate(kind.name, options.seed, options.agents, options.seconds, options.fps, options.steps,
                                          options.exact, dict(options.set))
    fps = options.fps or kind.fps
    observed = observe(positions, options.seed, kind.name, options.error, options.gaps, options.presence == "irregular",
                       parameters.get("box"), options.wrapped)
    write(options.out, "\n".join(csv_lines(*observed, kind, fps, options.decimals)) + "\n")
    if options.truth:
        write(options.truth, json.dumps(description(kind, parameters, run, options, positions), indent=2) + "\n")


def description(kind, parameters, run, options, positions):
    """What a reader of the file is not told: where it comes from."""
    flown = flown_per_frame(positions)
    setup = {key: value for key, value in parameters.items() if key in kind.setup}
    model = {key: value for key, value in parameters.items() if key not in kind.setup}
    return {
        "name": kind.name, "model": kind.model, "parameters": model, "setup": setup, "unit": kind.unit, "fps": options.fps or kind.fps,
        "agents": run.agents, "frames": run.frames, "steps": None if run.exact else run.steps, "exact": run.exact, "seed": options.seed,
        "flown_per_frame": flown, "error_sd": options.error * flown, "gaps": options.gaps, "presence": options.presence,
        "decimals": options.decimals, "wrapped": options.wrapped,
    }


if __name__ == "__main__":
    main()
