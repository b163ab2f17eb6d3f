# SPDX-License-Identifier: GPL-2.0-or-later
"""Density and coordination of the beds in the store, as the table of docs/beds.md.

usage: PYTHONPATH=build/python yade -j1 -n -x benchmarks/bed_table.py [folder of beds]

Measured on the inner grains, those further than two diameters from walls, floor and surface. Grains with
fewer than two contacts carry nothing and are left out of the second coordination number.
"""
from __future__ import annotations

import sys

import grainfall  # noqa: F401  registers what grainfall.beds needs
import numpy as np
from grainfall.beds import Bed, cache_folder, load_bed


def inner_coordination(bed: Bed) -> tuple[float, float, float]:
    """Coordination number of the inner grains, that of those which carry load, share of the others."""
    count, margin = len(bed.radii), 2 * bed.spec.diameter
    touching = np.bincount(bed.contacts[bed.contacts < count].ravel(), minlength=count)
    low = np.array([-bed.spec.length / 2, -bed.spec.width / 2, 0]) + margin
    high = np.array([bed.spec.length / 2, bed.spec.width / 2, bed.surface]) - margin
    inner = touching[np.all((bed.centres > low) & (bed.centres < high), axis=1)]
    carrying = inner >= 2
    return float(inner.mean()), float(inner[carrying].mean()), float(1 - carrying.mean())


def main(arguments: list[str]) -> None:
    """Print one row a bed."""
    print(
        "| grains | diameter, mm | E, Pa | friction | solid fraction, core (box) | z, inner | z, load-carrying |",
        end="",
    )
    print(" others | kinetic energy/(m g d) | unbalanced |")
    print("|" + "---|" * 10)
    for path in sorted(cache_folder(*arguments[:1]).glob("*.h5")):
        bed = load_bed(path)
        spec, report = bed.spec, bed.report
        z, z_carrying, others = inner_coordination(bed)
        diameter = f"{1e3 * spec.diameter:g}" + (f" +-{spec.spread:.0%}" if spec.spread else "")
        print(
            f"| {len(bed.radii)} | {diameter} | {spec.sand.young:.1e} | {spec.sand.friction} "
            f"| {report['solid_fraction_core']:.3f} ({report['solid_fraction_box']:.3f}) | {z:.2f} "
            f"| {z_carrying:.2f} | {others:.1%} | {report['kinetic_energy_per_grain_over_m_g_d']:.1e} "
            f"| {report['unbalanced_force']:.3f} |"
        )


main(sys.argv[1:])
