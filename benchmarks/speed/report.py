# SPDX-License-Identifier: GPL-2.0-or-later
"""Results as JSON, as tables in docs/performance.md and as a figure beside it."""
from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

LABELS = {
    "stock_yade_default": "stock YADE, default",
    "stock_yade": "stock YADE, tuned",
    "general": "Grainfall, general path",
    "flat": "Grainfall, flat path",
    "lammps_granular": "LAMMPS granular",
    "lammps_hertz_history": "LAMMPS gran/hertz/history",
    "liggghts": "LIGGGHTS hertz history",
    "kernel": "bare kernel and leapfrog",
}
COLOURS = dict(
    zip(
        LABELS,
        ("#9aa7b5", "#5b6b7c", "#f0a35e", "#c8451b", "#4f9d8c", "#8cc5b8", "#7a86c7", "#222222"),
    )
)


def write(results: dict[str, Any], folder: Path, page: Path | None) -> None:
    """Write the JSON and the figure; with a page, the figure beside it and the tables between its marks."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "speed.json").write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    if page is None:
        draw(results, folder / "speed.png")
        return
    draw(results, page.parent / "images" / "speed.png")
    fill(page, "speed tables", tables(results))


def fill(page: Path, name: str, content: str) -> None:
    """Replace what stands between the marks `name` of a page."""
    begin, end = f"<!-- {name} -->", f"<!-- end {name} -->"
    text = page.read_text(encoding="utf-8")
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(text):
        raise ValueError(f"{page}: no place for {name} ({begin} ... {end})")
    page.write_text(pattern.sub(lambda _: f"{begin}\n{content}\n{end}", text), encoding="utf-8")


def tables(results: dict[str, Any]) -> str:
    """All tables in Markdown."""
    parts = [_conditions(results)]
    for kind, heading in (("settled", "At rest"), ("moving", "Projectile moving")):
        if results[kind]:
            parts += [f"### {heading}", _times(results[kind])]
    if results["ratios"]:
        parts += ["### Ratios", _ratios(results)]
    if results.get("growth"):
        parts += ["### Growth", _growth(results["growth"]["lines"])]
    if results.get("memory"):
        parts += ["### Memory", _memory(results["memory"])]
    return "\n\n".join(parts)


def _conditions(results: dict[str, Any]) -> str:
    machine = results["machine"]
    cases = results["settled"] + results["moving"]
    grown = results.get("growth", {"others_busy_processors": [], "rounds": []})
    busy = max((c["others_busy_processors"]["median"] for c in cases), default=0)
    busy_growing = max(grown["others_busy_processors"], default=0)
    rounds = [c["rounds"] for c in cases] + grown["rounds"]
    spoken = " to ".join(map(str, sorted({min(rounds), max(rounds)})))
    lines = [
        f"{machine['date']}, {machine['processor']}, {machine['cores']} cores; medians of {spoken} "
        f"rounds, quartiles in brackets. Other programs kept {busy:g} processors busy"
        + (
            f", {busy_growing:g} while growth was measured (in processor time)."
            if grown["rounds"]
            else "."
        )
    ]
    if busy > 0.1:
        lines.append(
            "**The machine was not idle: trust ratios, not times; not even ratios on two threads.**"
        )
    lines += [
        f"Skipped: {LABELS[name]} ({why})." for name, why in results["skipped"].items() if why
    ]
    return "\n\n".join(lines)


def _times(cases: list[dict[str, Any]]) -> str:
    columns = [(c["grains"], c["threads"]) for c in cases]
    rows = [
        ["ms a step"]
        + [f"{g // 1000}k grains, {_threads(t)}" for g, t in columns]
        + ["ns a contact*"]
    ]
    rows.append(["---"] * len(rows[0]))
    for name, label in LABELS.items():
        entries = [case["contenders"].get(name) for case in cases]
        if any(entries):
            alone = [e for e, (_, t) in zip(entries, columns) if e and t == 1]
            cells = [_time(e) for e in entries]
            rows.append([label, *cells, f"{alone[-1]['ns_per_contact']:.0f}" if alone else ""])
    return f"{_markdown(rows)}\n\n*one thread, largest bed: {cases[-1]['contacts']} contacts."


def _threads(count: int) -> str:
    return "1 thread" if count == 1 else f"{count} threads"


def _time(entry: dict[str, Any] | None) -> str:
    if not entry:
        return ""
    low, high = entry["step_ms_quartiles"]
    return f"{entry['step_ms']:.3g} [{low:.3g}, {high:.3g}]"


def _ratios(results: dict[str, Any]) -> str:
    rows = [["ratio", "median", "quartiles"], ["---"] * 3]
    for name, value in results["ratios"].items():
        low, high = results["ratio_quartiles"][name]
        rows.append([f"`{name}`", f"{value:.2f}", f"{low:.2f} to {high:.2f}"])
    return _markdown(rows)


def whole_run(report: dict[str, Any]) -> str:
    """Table of the runs of `speed.table1`."""
    rows = [["path", "threads", "wall [s]", "processor [s]", "others busy", "depth [mm]"]]
    rows.append(["---"] * 6)
    for path, run in report["runs"].items():
        numbers = [f"{run[key]:.0f}" for key in ("wall_seconds", "processor_seconds")]
        rows.append(
            [
                path,
                str(run["threads"]),
                *numbers,
                f"{run['others_busy_processors']:g}",
                f"{1e3 * run['depth_m']:.1f}",
            ]
        )
    ratio = report.get("stock_over_flat")
    last = f"\n\nStock over flat: {ratio:.2f}." if ratio else ""
    return _markdown(rows) + last


def _growth(growth: dict[str, Any]) -> str:
    sizes = max((line["grains"] for line in growth.values()), key=len)
    rows = [["microseconds a step and grain", *map(str, sizes), "exponent"]]
    rows.append(["---"] * len(rows[0]))
    for name, line in growth.items():
        times = dict(zip(line["grains"], line["step_ms"]))
        cells = [f"{1e3 * times[n] / n:.3g}" if n in times else "" for n in sizes]
        rows.append([LABELS[name], *cells, str(line.get("exponent", ""))])
    return _markdown(rows)


def _memory(memory: dict[str, Any]) -> str:
    rows = [
        ["bytes", "a grain", "a contact, candidate pairs included", "a grain, contacts included"]
    ]
    rows.append(["---"] * 4)
    for name, entry in memory.items():
        keys = ("bytes_per_grain", "bytes_per_contact", "bytes_per_grain_contacts_included")
        rows.append([LABELS[name], *(str(entry.get(key, "")) for key in keys)])
    return _markdown(rows)


def _markdown(rows: list[list[str]]) -> str:
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def draw(results: dict[str, Any], file: Path) -> None:
    """Bars of the step times on the largest bed, and the growth if it was measured."""
    cases = [(kind, c) for kind in ("settled", "moving") for c in results[kind]]
    largest = max((c["grains"] for _, c in cases), default=0)
    cases = [(kind, c) for kind, c in cases if c["grains"] == largest]
    growth = results.get("growth")
    panels = len(cases) + bool(growth)
    if not panels:
        return
    columns = panels if panels <= 3 else math.ceil(panels / 2)
    lines = math.ceil(panels / columns)
    figure, axes = plt.subplots(
        lines,
        columns,
        figsize=(1.2 + 3.1 * columns, 3.6 * lines),
        layout="constrained",
        squeeze=False,
    )
    for number, (kind, case) in enumerate(cases):
        _bars(axes.flat[number], kind, case, with_names=number % columns == 0)
    if growth:
        _lines(axes.flat[panels - 1], growth["lines"])
    for unused in axes.flat[panels:]:
        unused.set_axis_off()
    figure.savefig(file, dpi=110)
    plt.close(figure)


def _bars(panel: Any, kind: str, case: dict[str, Any], with_names: bool) -> None:
    names = list(LABELS)[::-1]
    for place, name in enumerate(names):
        entry = case["contenders"].get(name)
        if not entry:
            continue
        low, high = entry["step_ms_quartiles"]
        middle = entry["step_ms"]
        spread = [[max(middle - low, 0)], [max(high - middle, 0)]]
        panel.barh(place, middle, xerr=spread, color=COLOURS[name], error_kw={"lw": 0.8})
        panel.annotate(
            f"{middle:.3g}",
            (high, place),
            xytext=(3, 0),
            textcoords="offset points",
            va="center",
            fontsize=7,
        )
    panel.set_yticks(
        range(len(names)), [LABELS[n] for n in names] if with_names else [], fontsize=8
    )
    panel.set_ylim(-0.6, len(names) - 0.4)
    panel.margins(x=0.16)
    state = "at rest" if kind == "settled" else "projectile moving"
    panel.set_title(
        f"{case['grains'] // 1000}k grains, {state}, {_threads(case['threads'])}", fontsize=8
    )
    clock = "processor time" if case["threads"] == 1 else "wall time"
    panel.set_xlabel(f"{clock} of a step [ms]", fontsize=8)
    panel.tick_params(axis="x", labelsize=7)


def _lines(panel: Any, growth: dict[str, Any]) -> None:
    for name, line in growth.items():
        label = LABELS[name]
        if "exponent" in line:
            label += f": n^{line['exponent']:.2f}"
        panel.loglog(
            line["grains"], line["step_ms"], "o-", ms=3, lw=1, color=COLOURS[name], label=label
        )
    panel.set_title("one thread, at rest", fontsize=8)
    panel.set_xlabel("grains", fontsize=8)
    panel.set_ylabel("processor time of a step [ms]", fontsize=8)
    panel.grid(True, which="both", lw=0.3)
    panel.tick_params(labelsize=7)
    panel.legend(fontsize=6)
