# SPDX-License-Identifier: GPL-2.0-or-later
"""Table and figure of a study."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

PAGE = Path("docs/accuracy.md")
IMAGES = Path("docs/images")


def write(name: str, results: dict[str, Any]) -> None:
    """Draw docs/images/accuracy_<name>.png and replace the table of this case in docs/accuracy.md."""
    draw(results, IMAGES / f"accuracy_{name}.png")
    page = PAGE.read_text(encoding="utf-8")
    begin, end = f"<!-- table {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise ValueError(f"{PAGE}: no place for the table of {name} ({begin} ... {end})")
    block = f"{begin}\n{table(results)}\n{end}"
    PAGE.write_text(pattern.sub(lambda _: block, page), encoding="utf-8")


def table(results: dict[str, Any]) -> str:
    """Markdown table of the points."""
    extras = list(results["points"][0]["extra"])
    head = ["knob", "setting", "error", "processor time [s]", *extras]
    rows = [head, ["---"] * len(head)]
    for point in results["points"]:
        numbers = [f"{point['error']:.2g}", f"{point['cpu_seconds']:.3g}"]
        numbers += [f"{point['extra'][key]:.4g}" for key in extras]
        rows.append([point["knob"], point["setting"], *numbers])
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return f"Error: {results['error']}. Time: {results['cost']}.\n\n" + "\n".join(lines)


def draw(results: dict[str, Any], file: Path) -> None:
    """Error against processor time, one line a knob, each point with its setting."""
    figure, axes = plt.subplots(figsize=(7.5, 5.4), layout="constrained")
    knobs = dict.fromkeys(point["knob"] for point in results["points"])
    for marker, knob in zip("osD^vP*", knobs):
        points = [p for p in results["points"] if p["knob"] == knob]
        x = [p["cpu_seconds"] for p in points]
        y = [p["error"] for p in points]
        numeric = all(re.fullmatch(r"[-+.\de]+", p["setting"]) for p in points)
        axes.plot(x, y, marker + ("-" if numeric else ""), label=knob, ms=5, lw=1)
        for p, px, py in zip(points, x, y):
            axes.annotate(
                p["setting"], (px, py), xytext=(4, 3), textcoords="offset points", fontsize=6
            )
    axes.set(
        xscale="log",
        yscale="log",
        xlabel=f"processor time of {results['cost']} [s]",
        ylabel=results["error"],
    )
    axes.grid(True, which="both", lw=0.3)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, fontsize=7)
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=110)
    plt.close(figure)
