# SPDX-License-Identifier: GPL-2.0-or-later
"""What each effect costs in the contact loop of YADE, on and off: instructions, nanoseconds, bytes per contact.

    /usr/bin/python3 benchmarks/effect_cost/measure.py [build directory] [--check] [--json FILE] [--docs FILE]

Instructions are counted by valgrind's callgrind in a running YADE. The yardstick is a build in which no effect
exists: plain_law.cpp, the plain kernel in functors of its own, and for what comes on top of another effect that
effect without it (plain_effects.cpp). Passes if YADE's step takes at most 1 % more instructions per contact with
effects off than with the yardstick, and our functor by itself, the choice of the kernel included, at most 1 % or,
where it is short or finds a bridge, 1.5 %; if a contact takes no more bytes, if the step is the same within 1 %
before and after grainfall is loaded, and if no case loads a library besides our own. ``--check`` leaves the times
out, which takes a minute.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from callgrind_file import read_dumps

HERE = Path(__file__).resolve().parent
YADE_PYTHON = "/usr/lib/x86_64-linux-gnu/yade-double/py"
ALLOWED_RATIO, ALLOWED_CHANGE_OF_STEP = 1.01, 0.01
#: Choosing the kernel is 6 instructions, 1.1 % of the shortest law with a shear spring.
ALLOWED_SHORT_RATIO = 1.015
#: A wet contact finds its dry kernel in a table and its bridge in an object of its own: 15 instructions, 1.3 %, none of
#: them the film's doing.
ALLOWED_WET_RATIO = 1.015
#: What bookkeeping of the heap and bytes of the engines, shared by all contacts, may come to: half of malloc's grain.
ALLOWED_BYTES = 8
FUNCTOR, STEP = r"Law2_ScGeom_\w+::go\(", r"Scene::moveToNextTimeStep"
#: Cases with an effect off, the build without it that they are held against, and how far above it they may be.
YARDSTICKS = {
    "all effects off": ("plain build", ALLOWED_RATIO),
    "damping off": ("plain build, no damping", ALLOWED_SHORT_RATIO),
    "tangential force off": ("plain build, frictionless", ALLOWED_RATIO),
    # Without moisture and load scaling, and with them.
    "friction: power law": ("plain build, power law", ALLOWED_RATIO),
    "moisture in friction (power law)": ("plain build, power law", ALLOWED_RATIO),
    "load scaling (power law)": ("plain build, power law", ALLOWED_RATIO),
    # Without a viscous film.
    "liquid bridges": ("plain build, liquid bridges", ALLOWED_WET_RATIO),
}
#: Dry contacts with constant friction: no bytes for what they do not have.
BARE = ("all effects off", "damping off", "tangential force off")
LIBRARY = "_core.so"
#: YADE started from plain Python: its own start script takes several times as long under valgrind.
LAUNCH = """
import os, sys
sys.path.insert(1, {yade!r})
import yade
sys.argv = sys.argv[1:]
exec(compile(open(sys.argv[0]).read(), sys.argv[0], "exec"), dict(__name__="__main__", __file__=sys.argv[0]))
sys.stdout.flush()
os._exit(0)
"""


def run_cases(build: Path, folder: Path, mode: str) -> dict[str, Any]:
    """Run cases.py in a YADE process, under callgrind if it is to count; its answer."""
    launch, output = folder / "launch.py", folder / f"{mode}.json"
    launch.write_text(LAUNCH.format(yade=YADE_PYTHON))
    command = ["/usr/bin/python3", str(launch), str(HERE / "cases.py")]
    command += [str(build / "benchmarks"), str(output), mode]
    if mode == "count":
        if shutil.which("valgrind") is None:
            sys.exit("valgrind is missing: run tools/install-dependencies.sh")
        options = ["--instr-atstart=no", "--collect-atstart=no", f"--toggle-collect=*{STEP}*"]
        out_file = f"--callgrind-out-file={folder}/calls"
        command = ["valgrind", "--tool=callgrind", *options, out_file, *command]
    environment = {
        **os.environ,
        "PYTHONPATH": str(build / "python"),
        "OMP_NUM_THREADS": "1",
        "MALLOC_ARENA_MAX": "1",
    }
    run = subprocess.run(command, capture_output=True, text=True, env=environment)
    if not output.exists():
        sys.exit(f"cases.py {mode} failed:\n{run.stdout[-2000:]}\n{run.stderr[-4000:]}")
    return json.loads(output.read_text())


def count(build: Path) -> dict[str, dict[str, Any]]:
    """Instructions per contact and step by case: of the whole step, of the functor."""
    with tempfile.TemporaryDirectory() as folder:
        answer = run_cases(build, Path(folder), "count")
        dumps = read_dumps(Path(folder), "calls")
    result: dict[str, dict[str, Any]] = {}
    for name, facts in answer["cases"].items():
        dump = dumps[name]
        contacts = facts["contacts"]
        calls, functor = dump.inclusive(FUNCTOR)
        # A contact may open or form within the few steps.
        if abs(calls / (contacts * answer["steps"]) - 1) > 0.005:
            sys.exit(
                f"{name}: {calls} calls of the law for {contacts} contacts: nothing to compare"
            )
        result[name] = {
            "contacts": contacts,
            "sliding": facts["sliding"],
            "step_instructions": dump.total / calls,
            "functor_instructions": functor / calls,
            "bytes": facts["heap"] / contacts,
            "libraries": facts["libraries"],
        }
    return result


def add_times(build: Path, cases: dict[str, dict[str, Any]]) -> None:
    """Nanoseconds that each case takes more than all effects off, per contact and step; bytes without valgrind."""
    with tempfile.TemporaryDirectory() as folder:
        answer = run_cases(build, Path(folder), "time")["cases"]
    base = answer["all effects off"]["step_seconds"]
    for name, facts in answer.items():
        cases[name]["bytes"] = facts["heap"] / facts["contacts"]
        if "step_seconds" in facts:
            more = [
                1e9 * (own - b) / facts["contacts"] for own, b in zip(facts["step_seconds"], base)
            ]
            low, _, high = quantiles(more, n=4)
            cases[name]["nanoseconds_more"] = median(more)
            cases[name]["nanoseconds_more_quartiles"] = [low, high]
            cases[name]["step_nanoseconds"] = (
                1e9 * median(facts["step_seconds"]) / facts["contacts"]
            )


def judge(cases: dict[str, dict[str, Any]]) -> list[str]:
    """What is not as it should be, a sentence each."""
    faults = []
    for name, (yardstick, allowed) in YARDSTICKS.items():
        own, plain = (cases[n] for n in (name, yardstick))
        ratio = own["functor_instructions"] / plain["functor_instructions"]
        own["ratio_to_plain_build"] = ratio
        if ratio > allowed:
            faults.append(f"{name}: {ratio:.4f} of {yardstick}, above {allowed}")
        step = own["step_instructions"] / plain["step_instructions"]
        own["step_ratio_to_plain_build"] = step
        if step > ALLOWED_RATIO:
            faults.append(f"{name}: its step {step:.4f} of {yardstick}'s, above {ALLOWED_RATIO}")
        if name in BARE and abs(own["bytes"] - plain["bytes"]) > ALLOWED_BYTES:
            faults.append(f"{name}: {own['bytes'] - plain['bytes']:+.0f} bytes beside {yardstick}")
    for name, case in cases.items():
        expected = [LIBRARY] if name in ours(cases) else []
        if case["libraries"] != expected:
            faults.append(f"{name}: has loaded {case['libraries']}, not {expected}")
    alone, beside = (cases[n] for n in ("plain build", "plain build beside grainfall"))
    ratio = beside["step_instructions"] / alone["step_instructions"]
    if abs(ratio - 1) > ALLOWED_CHANGE_OF_STEP:
        faults.append(f"loading grainfall changes a step that does not use it: {ratio:.4f}")
    return faults


def ours(cases: dict[str, dict[str, Any]]) -> list[str]:
    """Cases that ran after grainfall had been imported."""
    names = list(cases)
    return names[names.index("plain build beside grainfall") :]


def table(cases: dict[str, dict[str, Any]]) -> str:
    """Markdown: differences are to all effects off."""
    base = cases["all effects off"]
    timed = "nanoseconds_more" in cases["partial slip"]
    columns = ["case", "law", "more", "step", "bytes more"] + (
        ["ns more (quartiles)"] if timed else []
    )
    lines = ["| " + " | ".join(columns) + " |", "| --- |" + " ---: |" * (len(columns) - 1)]
    for name, case in cases.items():
        row = [
            name,
            f"{case['functor_instructions']:.0f}",
            f"{case['functor_instructions'] - base['functor_instructions']:+.0f}",
            f"{case['step_instructions']:.0f}",
            f"{case['bytes'] - base['bytes']:+.0f}",
        ]
        if timed and "nanoseconds_more" in case:
            low, high = case["nanoseconds_more_quartiles"]
            row.append(f"{case['nanoseconds_more']:+.0f} ({low:+.0f} to {high:+.0f})")
        elif timed:
            row.append("")
        lines.append("| " + " | ".join(row) + " |")
    return "\n".join(lines)


def main() -> None:
    """Count, time unless told not to, write, judge."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", nargs="?", default="build", type=Path, help="build directory")
    parser.add_argument("--check", action="store_true", help="instructions alone; write nothing")
    results = HERE.parent / "results" / "effect_cost.json"
    parser.add_argument("--json", type=Path, default=results, help="where the numbers go")
    docs = HERE.parents[1] / "docs" / "effects.md"
    parser.add_argument("--docs", type=Path, default=docs, help="page whose table is renewed")
    options = parser.parse_args()
    build = options.build.resolve()
    cases = count(build)
    if not options.check:
        add_times(build, cases)
    faults = judge(cases)
    print(table(cases))
    if not options.check:
        options.json.write_text(json.dumps(cases, indent=1) + "\n")
        begin, end = "<!-- table effect_cost -->\n", "<!-- end of table -->"
        text = options.docs.read_text()
        head, rest = text.split(begin)
        options.docs.write_text(head + begin + table(cases) + "\n" + end + rest.split(end)[1])
    for name in YARDSTICKS:
        case = cases[name]
        print(
            f"{name}: {case['ratio_to_plain_build']:.4f} of the plain build, "
            f"the step {case['step_ratio_to_plain_build']:.4f}"
        )
    if faults:
        sys.exit("FAIL: " + "; ".join(faults))
    print(
        f"PASS: effects that are off cost at most {ALLOWED_RATIO - 1:.1%} of a step's instructions and no bytes"
    )


if __name__ == "__main__":
    main()
