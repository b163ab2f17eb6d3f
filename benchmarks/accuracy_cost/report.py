# SPDX-License-Identifier: GPL-2.0-or-later
"""Table and figure of a study. An error below the scatter of its samples is marked: chance alone could make it."""
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


def within_scatter(point: dict[str, Any]) -> bool:
    """Is the error no more than two runs differ by chance?"""
    return point["scatter"] is not None and point["error"] <= point["scatter"]


def table(results: dict[str, Any]) -> str:
    """Markdown table of the points."""
    points = results["points"]
    sampled = any(point["samples"] > 1 for point in points)
    extras = list(points[0]["extra"])
    head = ["knob", "setting", "error", "processor time [s]", *extras]
    if sampled:
        head[3:3] = ["scatter", "samples"]
    rows = [head, ["---"] * len(head)]
    for point in points:
        row = [point["knob"], point["setting"], f"{point['error']:.2g}"]
        if sampled:
            scatter = "-" if point["scatter"] is None else f"{point['scatter']:.2g}"
            row[2] += " (below scatter)" if within_scatter(point) else ""
            row += [scatter, str(point["samples"])]
        row.append(f"{point['cpu_seconds']:.3g}")
        rows.append(row + [f"{point['extra'][key]:.4g}" for key in extras])
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    about = f"Error: {results['error']}. Time: {results['cost']}."
    if sampled:
        about += " Scatter: standard deviation of the samples, in the error's unit; all else: their mean."
    return about + "\n\n" + "\n".join(lines)


def draw(results: dict[str, Any], file: Path) -> None:
    """Error against processor time, one line a knob, each point with its setting.

    Bars: scatter of the samples. Hollow: the error is below the scatter.
    """
    figure, axes = plt.subplots(figsize=(7.5, 5.4), layout="constrained")
    knobs = dict.fromkeys(point["knob"] for point in results["points"])
    for marker, knob in zip("osD^vP*", knobs):
        points = [p for p in results["points"] if p["knob"] == knob]
        x = [p["cpu_seconds"] for p in points]
        y = [p["error"] for p in points]
        numeric = all(re.fullmatch(r"[-+.\de]+", p["setting"]) for p in points)
        (line,) = axes.plot(x, y, marker + ("-" if numeric else ""), label=knob, ms=5, lw=1)
        draw_scatter(axes, points, marker, line.get_color())
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


def draw_scatter(axes: Any, points: list[dict[str, Any]], marker: str, colour: str) -> None:
    """Bars of the scatter, cut where they would leave a logarithmic axis, and hollow markers below it."""
    for p in points:
        if p["scatter"] is None:
            continue
        x, y, half = p["cpu_seconds"], p["error"], p["scatter"]
        below = min(half, 0.6 * y)
        axes.errorbar([x], [y], [[below], [half]], color=colour, lw=0.8, capsize=2)
        if within_scatter(p):
            axes.plot([x], [y], marker, mec=colour, mfc="white", ms=5, zorder=3)
