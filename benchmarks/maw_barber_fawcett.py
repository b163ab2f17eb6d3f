# SPDX-License-Identifier: GPL-2.0-or-later
"""Oblique impact with and without partial slip, beside the exact solution and the experiment.

usage: PYTHONPATH=build/python yade -n -x benchmarks/maw_barber_fawcett.py
       [--output docs/images/maw_barber_fawcett.png]

Left: rebound against incidence of the contact patch in Maw, Barber & Fawcett's numbers, elastic, nu =
0.3. Right: tangential restitution of 5 mm aluminium oxide spheres, Kharaz, Gorham & Salman (2001) as
digitised from Chung & Ooi (2011), test 4. Prints the largest and the root-mean-square difference of
each law from either.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

import grainfall  # noqa: F401
import matplotlib
import numpy as np

HERE = (
    Path(__file__ if __file__.endswith("maw_barber_fawcett.py") else sys.argv[0]).resolve().parent
)
sys.path.insert(0, str(HERE.parent / "tests" / "physics"))

import contact_scenes as cs  # noqa: E402
import maw_barber_fawcett_impact as maw  # noqa: E402
import test_chung_ooi_4_oblique_impact as chung_ooi_4  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

LAWS = {"mindlin-deresiewicz": "C0", "incremental": "C1"}
OXIDE = chung_ooi_4.SOLIDS["aluminium oxide"]


def tell(law: str, against: str, difference: np.ndarray) -> None:
    largest, mean = np.max(np.abs(difference)), np.sqrt(np.mean(difference**2))
    print(f"{law:20s} {against:22s} largest {largest:8.5f}   rms {mean:8.5f}")


def draw_elastic_impact(axes: plt.Axes) -> None:
    """psi2 against psi1 of each law and of the reference."""
    incidence = np.linspace(0.05, 7, 60)
    expected = maw.reference_rebound(incidence)
    axes.plot(incidence, expected, "k", lw=4, alpha=0.25, label="spring by spring")
    for law, colour in LAWS.items():
        found = maw.rebound(incidence, law)
        axes.plot(incidence, found, colour, label=law)
        tell(law, "Maw, Barber & Fawcett", found - expected)
    for psi, top, words in ((1, 1.05, "sticks first"), (4 * maw.CHI - 1, 0.6, "slides throughout")):
        axes.axvline(psi, color="0.7", lw=0.8)
        axes.annotate(words, (psi, top), rotation=90, va="top", ha="right", color="0.4", size=8)
    axes.set_xlabel(r"incidence $\psi_1$")
    axes.set_ylabel(r"rebound $\psi_2$")
    axes.set_title("elastic sphere on a plane, Poisson's ratio 0.3", size=10)
    axes.legend(loc="upper center", frameon=False)


def draw_experiment(axes: plt.Axes) -> None:
    """vt'/vt against the angle of incidence, of each law and as measured."""
    angles, measured = cs.read_csv("chung_ooi_2011/test4_tangential_restitution_experiment.csv").T
    degrees = np.concatenate([np.arange(1.5, 12, 0.75), np.arange(12, 86, 2.0)])
    for law, colour in LAWS.items():
        axes.plot(degrees, chung_ooi_4.rebound(OXIDE, degrees, law).tangential, colour, label=law)
        found = chung_ooi_4.rebound(OXIDE, angles, law).tangential
        tell(law, "Kharaz et al.", found - measured)
    codes = cs.read_csv("chung_ooi_2011/test4_tangential_restitution_aluminium_oxide.csv").T
    axes.plot(*codes, "x", color="0.5", label="codes in Chung & Ooi (2011)")
    axes.plot(angles, measured, "ko", mfc="w", label="measured, Kharaz et al. (2001)")
    axes.set_xlabel("angle of incidence from the normal [degrees]")
    axes.set_ylabel("tangential restitution vt'/vt [-]")
    axes.set_title("5 mm aluminium oxide on glass, 3.9 m/s", size=10)
    axes.legend(loc="lower right", frameon=False)


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = HERE.parent / "docs" / "images" / "maw_barber_fawcett.png"
    parser.add_argument("--output", type=Path, default=default, help="picture to write")
    options = parser.parse_args(arguments)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    draw_elastic_impact(left)
    draw_experiment(right)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(options.output, dpi=130)
    print(f"written: {options.output}")


main(sys.argv[1:])
