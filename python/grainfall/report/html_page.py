# SPDX-License-Identifier: GPL-2.0-or-later
"""One self-contained page that tells a run: result, pictures, parameters, what ran and what it cost."""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

_STYLE = """
:root { color-scheme: light dark; --ink: #1d2328; --paper: #fdfcf9; --soft: #6d7780;
        --line: #dcd8cd; --mark: #2166ac; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e4de; --paper: #16191c; --soft: #98a2ab; --line: #363c42; --mark: #7fb3e6; }
  img { background: #fff; }
}
body { margin: 0 auto; max-width: 62rem; padding: 2rem 1.2rem 4rem; background: var(--paper); color: var(--ink);
       font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .2rem; } h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem; }
.lead { color: var(--soft); margin: 0 0 1.4rem; }
.results { display: grid; grid-template-columns: repeat(auto-fit, minmax(10.5rem, 1fr)); gap: .8rem; }
.results div { border: 1px solid var(--line); border-radius: 6px; padding: .7rem .9rem; }
.results b { display: block; font-size: 1.3rem; white-space: nowrap; color: var(--mark); }
.results span { color: var(--soft); font-size: .85rem; }
img { max-width: 100%; height: auto; border-radius: 6px; }
table { border-collapse: collapse; width: 100%; font-size: .92rem; }
td, th { text-align: left; padding: .28rem .6rem .28rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td.number { font-variant-numeric: tabular-nums; } .note { color: var(--soft); font-size: .88rem; }
"""

#: Keys of the summary shown large, with their names.
_RESULTS = (
    ("depth_m", "depth"),
    ("impact_speed_m_per_s", "impact speed"),
    ("peak_force_camera_N", "peak force, camera mean"),
    ("peak_force_N", "peak force, one row of the trace"),
    ("stop_time_s", "time to stop"),
    ("energy_residual_relative", "energy residual"),
)

#: Units as keys end in them, longest first.
_UNITS = (
    "N_s_per_m",
    "m_per_s",
    "N_per_m",
    "kg_per_m3",
    "per_s",
    "deg",
    "kg",
    "Pa",
    "Hz",
    "m",
    "s",
    "N",
    "J",
)


def split_unit(key: str) -> tuple[str, str]:
    """'impact_speed_m_per_s' -> ('impact speed', 'm/s'); keys without a unit give ''."""
    for unit in _UNITS:
        if key.endswith("_" + unit):
            name = key[: -len(unit) - 1]
            written = unit.replace("_per_", "/").replace("per_", "1/").replace("_", " ")
            return name.replace("_", " "), re.sub(r"m3$", "m³", written)
    return key.replace("_", " "), ""


def number(value: Any) -> str:
    """A value as a reader wants it: four figures, yes and no, a dash for nothing."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}".replace(",", " ")
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(number(v) for v in value)
    return str(value)


def write_page(
    summary: Mapping[str, Any],
    pictures: Iterable[Path],
    path: str | Path,
    columns: Sequence[str] = (),
) -> Path:
    """Write the page; the pictures (PNG) are embedded, so the file can be sent by itself.

    Parameters
    ----------
    summary : mapping
        Contents of ``summary.json``.
    columns : sequence of str
        Keys whose lists, all of one length, stand side by side in a table of results.
    """
    title = str(summary.get("title", f"Drop {summary.get('preset', '')}"))
    body = [f"<h1>{html.escape(title)}</h1>", f'<p class="lead">{html.escape(_lead(summary))}</p>']
    body += _results(summary)
    body += _columns({key: summary[key] for key in columns if key in summary})
    for picture in pictures:
        encoded = base64.b64encode(Path(picture).read_bytes()).decode("ascii")
        caption = html.escape(Path(picture).stem.replace("_", " "))
        body.append(
            f'<h2>{caption}</h2><img alt="{caption}" src="data:image/png;base64,{encoded}">'
        )
    shown = {key for key, _ in _RESULTS} | set(columns)
    nested = {k: v for k, v in summary.items() if isinstance(v, Mapping)}
    plain = {
        k: v for k, v in summary.items() if k not in nested and k not in shown and k != "title"
    }
    notes = plain.pop("notes", [])
    body += _price(nested.pop("price", {}))
    for name, table in nested.items():
        body += _table(name.replace("_", " "), table)
    body += _table("run", plain)
    body += [f'<p class="note">{html.escape(str(note))}</p>' for note in notes]
    text = (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)}</title><style>{_STYLE}</style></head>\n<body>\n"
        + "\n".join(body)
        + "\n</body></html>\n"
    )
    path = Path(path)
    path.write_text(text, encoding="utf-8")
    return path


def _lead(summary: Mapping[str, Any]) -> str:
    parts = [f"preset {summary.get('preset', '?')}", f"{number(summary.get('particles'))} grains"]
    if "steps" in summary:
        parts.append(f"{number(summary['steps'])} steps")
    if "simulated_seconds" in summary and "wall_seconds" in summary:
        simulated, wall = number(summary["simulated_seconds"]), number(summary["wall_seconds"])
        parts.append(f"{simulated} s simulated in {wall} s")
    return ", ".join(parts)


def _results(summary: Mapping[str, Any]) -> list[str]:
    cells = []
    for key, name in _RESULTS:
        if key not in summary:
            continue
        unit = split_unit(key)[1]
        value = f"{number(summary[key])} {unit}".strip()
        cells.append(f"<div><b>{html.escape(value)}</b><span>{html.escape(name)}</span></div>")
    return ['<div class="results">', *cells, "</div>"]


def _columns(table: Mapping[str, Sequence[Any]]) -> list[str]:
    """Lists of one length, side by side under their names and units."""
    if not table:
        return []
    heads = []
    for key in table:
        name, unit = split_unit(key)
        heads.append(f"<th>{html.escape(name)}{html.escape(f' [{unit}]' if unit else '')}</th>")
    rows = [
        "".join(f'<td class="number">{html.escape(number(value))}</td>' for value in row)
        for row in zip(*table.values())
    ]
    return [
        "<h2>results</h2><table>",
        f"<tr>{''.join(heads)}</tr>",
        *(f"<tr>{row}</tr>" for row in rows),
        "</table>",
    ]


def _price(price: Mapping[str, Any]) -> list[str]:
    """Seconds by engine and effect, the dearest first."""
    seconds = {k: v for k, v in price.items() if isinstance(v, (int, float))}
    total = sum(seconds.values())
    if not total:
        return []
    rows: Sequence[tuple[str, float]] = sorted(seconds.items(), key=lambda item: -item[1])
    lines = [
        f'<tr><td>{html.escape(name)}</td><td class="number">{value:.2f} s</td>'
        f'<td class="number">{100 * value / total:.1f} %</td></tr>'
        for name, value in rows
    ]
    return ["<h2>price: wall time by engine</h2><table>", *lines, "</table>"]


def _table(name: str, table: Mapping[str, Any]) -> list[str]:
    rows = []
    for key, value in table.items():
        label, unit = split_unit(str(key))
        text = f"{number(value)} {unit}".strip()
        rows.append(
            f'<tr><td>{html.escape(label)}</td><td class="number">{html.escape(text)}</td></tr>'
        )
    return [f"<h2>{html.escape(name)}</h2><table>", *rows, "</table>"] if rows else []
