# SPDX-License-Identifier: GPL-2.0-or-later
"""Count the instructions of a contact law per contact and step, with valgrind's callgrind.

    /usr/bin/python3 benchmarks/instruction_count.py [build directory] [--all]

Passes if the law composed from policies (constant friction, dry) costs at most 1 % more
instructions than a law written by hand for that alone, and computes the same forces. ``--all`` adds
the price of each other effect. Instruction counts, unlike times, are the same on a busy machine.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

CONTACTS, STEPS = 1000, 100
ALLOWED_RATIO = 1.01
EFFECTS = "frictionless undamped report partial-slip energy-book"
CURVES = "power-law exponential asperity table mixed-curves"


def count(program: Path, law: str) -> tuple[float, list[float]]:
    """Run one law under callgrind.

    Returns
    -------
    (instructions per contact and step, [sum of forces in N, of stiffnesses in N/m, slides])
    """
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run(
            [
                "valgrind",
                "--tool=callgrind",
                "--collect-atstart=no",
                "--toggle-collect=*counted_steps*",
                f"--callgrind-out-file={folder}/out",
                str(program),
                law,
                str(CONTACTS),
                str(STEPS),
            ],
            capture_output=True,
            text=True,
        )
    if result.returncode != 0:
        sys.exit(f"{program} {law} failed under valgrind:\n{result.stderr}")
    collected = re.search(r"Collected : (\d+)", result.stderr)
    if collected is None or int(collected.group(1)) == 0:
        sys.exit(f"callgrind counted nothing for {law}:\n{result.stderr}")
    sums = [float(word) for word in result.stdout.split()]
    return int(collected.group(1)) / (CONTACTS * STEPS), sums


def main() -> None:
    """Print the table and exit with 1 if the composed law is dearer than allowed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", default="build", type=Path, help="build directory")
    parser.add_argument("--all", action="store_true", help="also the price of each other effect")
    options = parser.parse_args()
    program = options.build / "benchmarks" / "kernel_cost"
    if not program.exists():
        sys.exit(f"{program} does not exist: build first (cmake --build {options.build})")

    by_hand, expected = count(program, "handwritten")
    composed, sums = count(program, "template")
    ratio = composed / by_hand
    sliding = expected[2] / (CONTACTS * STEPS)
    print(f"instructions per contact and step, {sliding:.0%} of the contacts sliding")
    print(f"{'handwritten':14s} {by_hand:8.1f}")
    print(f"{'template':14s} {composed:8.1f}   {ratio:.4f} of handwritten")
    for law in f"{EFFECTS} {CURVES}".split() if options.all else ():
        cost, _ = count(program, law)
        print(f"{law:14s} {cost:8.1f}   {cost / by_hand:.4f}")

    if any(abs(got - want) > 1e-12 * abs(want) for got, want in zip(sums, expected)):
        sys.exit(f"FAIL: the two laws differ: sums {sums} against {expected}")
    if ratio > ALLOWED_RATIO:
        sys.exit(f"FAIL: {ratio:.4f} is above the allowed {ALLOWED_RATIO}")
    print(f"PASS: ratio {ratio:.4f} <= {ALLOWED_RATIO}, same forces")


if __name__ == "__main__":
    main()
