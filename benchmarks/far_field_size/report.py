# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and figure of the size study."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

from far_field_size.study import COMPARED_AT, CONTINUUM, FORCE_OVER, LARGER, NEAR, RIGID, WHOLE

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

FIGURE = Path("docs/images/far_field_size.png")
Row = dict[str, Any]


def write(rows: list[Row], interval: int) -> None:
    """Print the tables and draw the figure."""
    print("\n".join([*size_table(rows, interval), "", *interval_table(rows)]))
    draw(rows, interval)


def of(rows: list[Row], half_width: float, outside: str, interval: int) -> list[Row]:
    """Rows of a setting, one a packing."""
    return [
        row
        for row in rows
        if (row["half_width"], row["outside"]) == (half_width, outside)
        and row["interval"] == (interval if outside == CONTINUUM else 0)
    ]


def spread(values: list[float], scale: float, digits: int) -> str:
    """Mean, and half of what lies between the smallest and the largest packing."""
    mean, half = np.mean(values), np.ptp(values) / 2
    if len(values) == 1:
        return f"{scale * mean:.{digits}f}"
    return f"{scale * mean:.{digits}f} ± {scale * half:.{digits}f}"


def size_table(rows: list[Row], interval: int) -> list[str]:
    """Force, depth, cost by near field and what is outside."""
    depth = f"depth after {1e3 * COMPARED_AT:.0f} ms, mm"
    force = f"mean of {1e3 * FORCE_OVER:.0f} ms, N"
    lines = [
        f"| half-width, diameters | outside | grains | peak, camera mean, N | {force} | {depth} | "
        "contacts on it | drop, s | settling, s | set-up, s |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for half_width in (*NEAR, WHOLE, *LARGER):
        for outside in (RIGID, CONTINUUM):
            found = of(rows, half_width, outside, interval)
            if not found:
                continue
            settled = [r["settling_s"] for r in rows if r["half_width"] == half_width]
            settled = [seconds for seconds in settled if seconds]
            cells = [
                f"{half_width:g}",
                "rigid box" if outside == RIGID else "continuum",
                f"{np.mean([r['grains'] for r in found]):.0f}",
                spread([r["peak_force_camera_N"] for r in found], 1, 1),
                spread([r["mean_force_N"] for r in found], 1, 1),
                spread([r["depth_m"] for r in found], 1e3, 2),
                "" if outside == RIGID else f"{np.mean([r['contacts'] for r in found]):.0f}",
                f"{np.mean([r['drop_s'] for r in found]):.0f}",
                f"{np.mean(settled):.0f}" if settled else "-",
                "" if outside == RIGID else f"{np.mean([r['setup_s'] for r in found]):.1f}",
            ]
            lines.append("| " + " | ".join(cells) + " |")
    return lines


def interval_table(rows: list[Row]) -> list[str]:
    """What fewer common solutions change, packing by packing in the smallest near field."""
    lines = [
        "| interval | seed | peak, camera mean, N | depth, mm | energy residual | disagreement | drop, s |",
        "|---|---|---|---|---|---|---|",
    ]
    found = [r for r in rows if r["half_width"] == NEAR[0] and r["outside"] == CONTINUUM]
    for row in sorted(found, key=lambda r: (r["seed"], r["interval"])):
        lines.append(
            f"| {row['interval']} | {row['seed']} | {row['peak_force_camera_N']:.2f} | {1e3 * row['depth_m']:.3f} | "
            f"{row['energy_residual_relative']:.1e} | {row['largest_disagreement']:.1e} | {row['drop_s']:.0f} |"
        )
    return lines


def draw(rows: list[Row], interval: int) -> None:
    """Depth and mean force over half-width, one point a packing."""
    figure, panels = plt.subplots(1, 3, figsize=(11, 3.6))
    quantities = (
        ("depth_m", 1e3, f"depth {1e3 * COMPARED_AT:.0f} ms after touch [mm]"),
        ("mean_force_N", 1, f"mean force of {1e3 * FORCE_OVER:.0f} ms from touch [N]"),
        ("drop_s", 1, "processor time of the drop [s]"),
    )
    kinds = (
        (RIGID, "s", "tab:grey", "rigid box", -0.03),
        (CONTINUUM, "o", "tab:blue", "continuum outside", 0.03),
    )
    for axes, (name, scale, label) in zip(panels, quantities):
        for outside, marker, colour, text, shift in kinds:
            found = [r for r in rows if r["outside"] == outside and r["interval"] in (0, interval)]
            axes.plot(
                [r["half_width"] + shift for r in found],
                [scale * r[name] for r in found],
                marker,
                color=colour,
                label=text,
                ms=5,
                alpha=0.8,
            )
        for half_width in NEAR:
            for row in of(rows, half_width, CONTINUUM, interval):
                same = [r for r in of(rows, half_width, RIGID, 0) if r["seed"] == row["seed"]]
                axes.plot(
                    [half_width - 0.03, half_width + 0.03],
                    [scale * same[0][name], scale * row[name]],
                    "-",
                    color="black",
                    lw=0.7,
                    zorder=1,
                    label="same packing" if half_width == NEAR[0] else None,
                )
        largest = [scale * r[name] for r in of(rows, LARGER[-1], RIGID, 0)]
        if largest and name != "drop_s":
            axes.axhspan(
                min(largest),
                max(largest),
                color="tab:orange",
                alpha=0.25,
                lw=0,
                label="largest box",
            )
        axes.set(xlabel="half-width of the grains, diameters", ylabel=label)
        axes.grid(True, lw=0.3)
    texts = dict(zip(*reversed(panels[0].get_legend_handles_labels())))
    panels[2].legend(texts.values(), texts.keys(), fontsize=7, loc="upper left")
    figure.tight_layout()
    FIGURE.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(FIGURE, dpi=110)
    plt.close(figure)
