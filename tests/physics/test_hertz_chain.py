# SPDX-License-Identifier: GPL-2.0-or-later
"""Sound and solitary waves in a row of equal spheres.

Pressed together by a force F_0 the row is a chain of springs k_n = 3/2 F_0/overlap and masses a distance d
apart. Small waves obey omega = 2 sqrt(k_n/m) sin(q d/2), so long ones travel at d sqrt(k_n/m), which grows
as F_0^(1/6) (Nesterenko 2001, Dynamics of Heterogeneous Materials). Without precompression
there is no sound; a blow travels as a solitary wave, in the long-wave limit at V = (16/25)^(1/5) c^(4/5)
v^(1/5), c^2 = 2E/(pi rho (1 - nu^2)), v the largest speed of a sphere (same book).
"""
from __future__ import annotations

import math

import contact_scenes as cs
import numpy as np
import pytest
from yade import O

GLASS = cs.Solid(7.0e10, 0.2, 2500)
RADIUS = 0.005
MASS = cs.sphere_mass(GLASS.density, RADIUS)
HERTZ = 4 / 3 * GLASS.plane_modulus / 2 * math.sqrt(RADIUS / 2)  # N/m^1.5


def chain(count: int, overlap: float) -> list[int]:
    """Ids of `count` free spheres along z between two fixed ones, all overlapping alike [m]."""
    O.reset()
    O.materials.append(GLASS.material())
    pitch = 2 * RADIUS - overlap
    ends = (0, count + 1)
    ids = [cs.add_sphere((0, 0, i * pitch), RADIUS, 0, fixed=i in ends) for i in range(count + 2)]
    cs.set_engines(cs.grain_law())
    return ids[1:-1]


def speeds(ids: list[int]) -> np.ndarray:
    """Velocities along the chain, shape (n,) [m/s]."""
    return np.array([O.bodies[i].state.vel[2] for i in ids])


def mode_frequencies(force: float, count: int, modes: np.ndarray) -> np.ndarray:
    """Angular frequencies [rad/s] of standing waves in a chain pressed with `force` [N], one per mode."""
    overlap = (force / HERTZ) ** (2 / 3)
    ids = chain(count, overlap)
    fastest = 2 * math.sqrt(1.5 * force / overlap / MASS)
    shapes = np.sin(np.pi * np.outer(modes, np.arange(1, count + 1)) / (count + 1))
    # Displacements of 1e-5 of the overlap: the spring is linear to the square of that.
    for body, speed in zip(ids, 1e-5 * overlap * fastest * shapes.mean(axis=0)):
        O.bodies[body].state.vel = (0, 0, speed)
    O.dt = 0.05 / fastest
    samples: list[np.ndarray] = []
    cs.set_engines(cs.grain_law(), lambda: samples.append(shapes @ speeds(ids)), period=10)
    O.run(1200, True)
    return np.array([frequency(series, 10 * O.dt) for series in np.array(samples).T])


def frequency(series: np.ndarray, interval: float) -> float:
    """Angular frequency of a cosine [rad/s]: a(t + h) + a(t - h) = 2 cos(omega h) a(t), by least squares.

    h is a sixth of the period or so, whatever the sampling interval.
    """
    crossings = np.count_nonzero(np.diff(np.sign(series)))
    shift = max(1, round(len(series) / max(crossings, 1) / 3))
    middle = series[shift:-shift]
    neighbours = series[2 * shift :] + series[: -2 * shift]
    return math.acos(middle @ neighbours / (2 * middle @ middle)) / (shift * interval)


def test_standing_waves_have_the_dispersion_of_the_discrete_chain():
    force, count = 100.0, 40
    modes = np.array([1, 3, 8, 15, 25, 33, 40])
    stiffness = 1.5 * force / (force / HERTZ) ** (2 / 3)
    expected = 2 * math.sqrt(stiffness / MASS) * np.sin(np.pi * modes / (2 * (count + 1)))
    # The step shifts a frequency by (omega dt)^2/24, 1e-4 at most.
    assert mode_frequencies(force, count, modes) == pytest.approx(expected, rel=1.5e-4)


def test_sound_travels_at_the_spacing_times_the_root_of_stiffness_over_mass():
    force, count = 100.0, 40
    overlap = (force / HERTZ) ** (2 / 3)
    spacing = 2 * RADIUS - overlap
    wave_number = math.pi / ((count + 1) * spacing)
    sound = mode_frequencies(force, count, np.array([1]))[0] / wave_number
    # 41 spacings to half a wave: dispersion lowers the speed by (q d)^2/24 = 2.4e-4.
    assert sound == pytest.approx(spacing * math.sqrt(1.5 * force / overlap / MASS), rel=3e-4)


def test_sound_speed_grows_with_the_sixth_root_of_the_force():
    first, second = (mode_frequencies(force, 20, np.array([1]))[0] for force in (1.0, 64.0))
    # The same number of springs to the wave, so the spacing drops out.
    assert second / first == pytest.approx(2.0, rel=1e-4)


def solitary_wave(speed: float) -> tuple[float, float]:
    """Speed of the wave and largest speed of a sphere in it [m/s] after a blow at `speed` [m/s]."""
    count = 48
    ids = chain(count, 0.0)
    O.bodies[ids[0]].state.vel = (0, 0, speed)
    impact = cs.HertzImpact.of_equal_spheres(GLASS, RADIUS, speed)
    O.dt = impact.duration / 100
    peaks = np.zeros(count)
    arrivals = np.zeros(count)

    def note_peaks():
        now = speeds(ids)
        higher = now > peaks
        peaks[higher] = now[higher]
        arrivals[higher] = O.time

    cs.set_engines(cs.grain_law(), note_peaks)
    cs.run_for(28 * impact.duration)
    near, far = 20, 40  # formed after some ten spheres; not yet at the end
    wave = (far - near) * 2 * RADIUS / (arrivals[far] - arrivals[near])
    assert peaks[far] == pytest.approx(peaks[near], rel=2e-3)
    return wave, peaks[near:far].mean()


def test_a_blow_travels_as_a_solitary_wave_at_nesterenko_s_speed():
    sound = math.sqrt(2 * GLASS.plane_modulus / (math.pi * GLASS.density))
    waves, peaks = np.array([solitary_wave(speed) for speed in (0.05, 0.5)]).T
    # The long-wave theory is applied to a wave five spheres long: 0.8 % too fast. The scaling is exact.
    assert waves == pytest.approx((16 / 25) ** 0.2 * sound**0.8 * peaks**0.2, rel=0.01)
    assert waves[1] / waves[0] == pytest.approx(10**0.2, rel=1e-6)
