# SPDX-License-Identifier: GPL-2.0-or-later
"""The same bed in LAMMPS and LIGGGHTS: input files, and reading what they print.

The formulas of the peers, and what makes them the same as ours:

- LAMMPS `pair granular` with hertz, mindlin/force, tsuji: the same; its polynomial of the
  restitution is inverted for our dashpot, and `limit_damping` forbids attraction as our law does.
- LAMMPS `gran/hertz/history`: dashpots grow with overlap^(1/2) instead of ^(1/4); their constants are
  chosen to be ours at the mean overlap of the bed. Attraction is allowed.
- LIGGGHTS `model hertz tangential history`: the same dashpots for the same restitution; `limitForce`.

Where a large projectile moves, LAMMPS lists neighbours by size ("multi"); LIGGGHTS 3.8 does not, because its
multi lists lose contacts between grains (the benchmark's check of the positions found it).

All walk by velocity Verlet, half a step from YADE's leapfrog, and list pairs nearer than the same skin.
"""
from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from speed import bed as beds

# Memory of the first rank, whose process number the shell that starts the program put into `pid`.
_MEMORY = "shell grep VmRSS /proc/${pid}/status >> memory"
# LIGGGHTS wants one format for the whole line.
_DUMP_FORMAT = 'format "%d' + 9 * " %.17g" + '"'


def damping_ratio() -> float:
    """Of stock YADE's dashpot at the restitution of the benchmark."""
    log = -math.log(beds.RESTITUTION)
    return math.sqrt(5 / 6) * log / math.hypot(log, math.pi)


def lammps_restitution() -> float:
    """Restitution for which LAMMPS's Tsuji polynomial gives our dashpot.

    LAMMPS damps with alpha sqrt(m k), k = F/overlap; ours is 2 zeta sqrt(m 3/2 k).
    """
    wanted = 2 * damping_ratio() * math.sqrt(1.5)

    def excess(e: float) -> float:
        coefficients = (4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728)
        return float(np.polyval(coefficients, e)) - wanted

    return brentq(excess, 0.05, 0.95)


def shear_over_normal_damping() -> float:
    """c_t/c_n = sqrt(k_t/k_n) of spheres of one material."""
    return math.sqrt(2 * (1 - beds.POISSON) / (2 - beds.POISSON))


def stiffness_coefficients() -> tuple[float, float]:
    """4/3 E* and 8 G* of grains of one material [Pa]."""
    modulus = beds.YOUNG / (2 * (1 - beds.POISSON**2))
    shear_modulus = beds.YOUNG / (4 * (1 + beds.POISSON) * (2 - beds.POISSON))
    return 4 / 3 * modulus, 8 * shear_modulus


def granular_law() -> str:
    """Contact law of `pair granular` and its walls.

    Stiffnesses are given as numbers: from `hertz/material` the walls of this LAMMPS take others than its pairs.
    """
    normal, shear = stiffness_coefficients()
    return (
        f"hertz {normal:.9g} {lammps_restitution():.9g} "
        f"tangential mindlin/force {shear:.9g} {shear_over_normal_damping():.9g} {beds.FRICTION:g} "
        "damping tsuji limit_damping"
    )


def hertz_history_law(overlap: float) -> str:
    """Coefficients of `gran/hertz/history`: K_n, K_t, gamma_n, gamma_t, mu, tangential damping on.

    F = sqrt(overlap R*) (K overlap - m* gamma v), so gamma is our c/(m* sqrt(overlap R*)) at `overlap` [m].
    """
    normal, shear = stiffness_coefficients()
    radius, mass = beds.RADIUS / 2, beds.MASS / 2
    root = math.sqrt(radius * overlap)
    critical = 2 * damping_ratio() / math.sqrt(mass * root)
    gamma_n = critical * math.sqrt(1.5 * normal)
    gamma_t = critical * math.sqrt(shear)
    return f"{normal:.9g} {shear:.9g} {gamma_n:.9g} {gamma_t:.9g} {beds.FRICTION:g} 1"


def write_data(bed: beds.Bed, file: Path) -> None:
    """The bed as a data file of atom style sphere; type 2 is the projectile."""
    rows = bed.bodies()
    half, top = bed.side / 2, float(rows[:, 2].max()) + 0.1
    number = np.arange(1, len(rows) + 1)
    kind = np.where(rows[:, 9] == rows[0, 9], 1, 2)
    density = rows[:, 10] / (4 / 3 * math.pi * rows[:, 9] ** 3)
    atoms = np.column_stack((number, kind, 2 * rows[:, 9], density, rows[:, :3]))
    speeds = np.column_stack((number, rows[:, 3:9]))
    margin = 2 * beds.RADIUS
    with open(file, "w", encoding="ascii") as out:
        out.write(f"bed\n\n{len(rows)} atoms\n{kind.max()} atom types\n")
        for axis in "xy":
            low, high = -half - margin, half + margin
            out.write(f"{low:.9g} {high:.9g} {axis}lo {axis}hi\n")
        out.write(f"{-margin:.9g} {top:.9g} zlo zhi\n\nAtoms\n\n")
        np.savetxt(out, atoms, fmt="%d %d" + 5 * " %.17g")
        out.write("\nVelocities\n\n")
        np.savetxt(out, speeds, fmt="%d" + 6 * " %.17g")


def lammps_input(bed: beds.Bed, law: str, warm_up: int, steps: int, skin: float) -> str:
    """Input for LAMMPS; `law` is 'granular' or 'hertz/history'."""
    half = bed.side / 2
    granular = law == "granular"
    simple = hertz_history_law(beds.mean_overlap(bed.bodies()[: bed.grains]))
    style = "granular" if granular else f"gran/hertz/history {simple}"
    coefficients = granular_law() if granular else ""
    wall = f"granular {granular_law()}" if granular else f"hertz/history {simple}"
    struck = len(bed.bodies()) > bed.grains
    return f"""\
atom_style sphere
units si
boundary f f f
newton off
processors * 1 1
neighbor {skin} {"multi" if struck else "bin"}
comm_modify vel yes {"mode multi" if struck else ""}
{_MEMORY}
read_data bed.data
neigh_modify delay 0 every 1 check yes
pair_style {style}
pair_coeff * * {coefficients}
fix gravity all gravity {beds.GRAVITY} vector 0 0 -1
fix motion all nve/sphere
fix x all wall/gran {wall} xplane {-half!r} {half!r}
fix y all wall/gran {wall} yplane {-half!r} {half!r}
fix z all wall/gran {wall} zplane 0.0 NULL
{_timed_run(warm_up, steps, "format float %.17g")}"""


def liggghts_input(bed: beds.Bed, warm_up: int, steps: int, skin: float) -> str:
    """Input for LIGGGHTS."""
    half = bed.side / 2
    types = 1 + int(len(bed.bodies()) > bed.grains)

    def per_type(value: float) -> str:
        return " ".join(types * [repr(value)])

    def per_pair(value: float) -> str:
        return f"{types} " + " ".join(types * types * [repr(value)])

    walls = "\n".join(
        f"fix {name} all wall/gran model hertz tangential history "
        f"primitive type 1 {plane} {place!r} limitForce on"
        for name, plane, place in (
            ("x1", "xplane", -half),
            ("x2", "xplane", half),
            ("y1", "yplane", -half),
            ("y2", "yplane", half),
            ("z1", "zplane", 0.0),
        )
    )
    return f"""\
atom_style granular
hard_particles yes
units si
boundary f f f
newton off
processors * 1 1
neighbor {skin} bin
communicate single vel yes
{_MEMORY}
read_data bed.data
neigh_modify delay 0 every 1 check yes
fix young all property/global youngsModulus peratomtype {per_type(beds.YOUNG)}
fix poisson all property/global poissonsRatio peratomtype {per_type(beds.POISSON)}
fix bounce all property/global coefficientRestitution peratomtypepair {per_pair(beds.RESTITUTION)}
fix slide all property/global coefficientFriction peratomtypepair {per_pair(beds.FRICTION)}
pair_style gran model hertz tangential history limitForce on
pair_coeff * *
{walls}
fix gravity all gravity {beds.GRAVITY} vector 0.0 0.0 -1.0
fix motion all nve/sphere
{_timed_run(warm_up, steps, _DUMP_FORMAT)}"""


def _timed_run(warm_up: int, steps: int, precision: str) -> str:
    # Processor time of the first rank in ns, then other numbers.
    clock = "shell cat /proc/${pid}/schedstat >> processor"
    return f"""\
timestep {beds.TIME_STEP}
thermo {warm_up + steps}
run {warm_up}
{clock}
run {steps} pre no
{clock}
{_MEMORY}
dump bodies all custom 1 bodies id x y z vx vy vz omegax omegay omegaz
dump_modify bodies sort id {precision}
run 0
"""


def read_bodies(file: Path, bed: beds.Bed) -> np.ndarray:
    """Bodies that LAMMPS or LIGGGHTS dumped, in the columns of a bed, shape (n, 11)."""
    rows = bed.bodies()
    rows[:, :9] = np.loadtxt(file, skiprows=9)[:, 1:10]
    return rows


def read_log(text: str) -> tuple[float, int]:
    """Seconds of the timed run, and how often neighbours were looked up in it."""
    loops = [float(x) for x in re.findall(r"^Loop time of (\S+)", text, re.M)]
    builds = [int(x) for x in re.findall(r"^Neighbor list builds = (\d+)", text, re.M)]
    if len(loops) < 2 or len(builds) < 2:
        raise RuntimeError(f"no two runs in the log:\n{text[-2000:]}")
    return loops[1], builds[1]
