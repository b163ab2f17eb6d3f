# SPDX-License-Identifier: GPL-2.0-or-later
"""Slice through the bed with the contact forces in colour, as in the report's Figure 11."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure


@dataclass
class Snapshot:
    """State of a drop at one moment.

    Parameters
    ----------
    time : float
        Since the first touch [s]; negative before it.
    centres, radii : numpy.ndarray, shapes (n, 3) and (n,)
        Grains [m].
    contact_points : numpy.ndarray, shape (c, 3, 2)
        Both ends of each contact's branch [m].
    contact_force : numpy.ndarray, shape (c,)
        Magnitude [N].
    position : numpy.ndarray, shape (3,)
        Centroid of the projectile [m].
    rotation : numpy.ndarray, shape (3, 3)
        From the projectile's axes to the scene's; its axis is z, nose at -z.
    outline : numpy.ndarray, shape (m, 2)
        Points (z, r) of the projectile's profile [m].
    box : numpy.ndarray, shape (3,)
        Inside of the box [m].
    """

    time: float
    centres: np.ndarray
    radii: np.ndarray
    contact_points: np.ndarray
    contact_force: np.ndarray
    position: np.ndarray
    rotation: np.ndarray
    outline: np.ndarray
    box: np.ndarray


def load_snapshot(path: str | Path) -> Snapshot:
    """Read a snapshot that a drop wrote."""
    with np.load(path) as data:
        return Snapshot(
            time=float(data["time"]),
            centres=data["centres"],
            radii=data["radii"],
            contact_points=data["contact_points"],
            contact_force=data["contact_force"],
            position=data["projectile_position"],
            rotation=_rotation_matrix(data["projectile_orientation"]),
            outline=data["outline"],
            box=data["box"],
        )


def _rotation_matrix(quaternion: np.ndarray) -> np.ndarray:
    """Rotation matrix (3, 3) of a unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def draw_bed(snapshot: Snapshot, path: str | Path, thickness: float | None = None) -> Path:
    """Draw the slice through the projectile that is parallel to x and z.

    Parameters
    ----------
    snapshot : Snapshot
        State to draw.
    path : str or Path
        PNG file to write.
    thickness : float, optional
        Thickness of the slice of contacts [m]; default three mean grain diameters.

    Returns
    -------
    Path
    """
    s = snapshot
    middle = s.position[1]
    if thickness is None:
        thickness = 6 * float(s.radii.mean())
    height = 7.0
    width = height * 1.06 * float(s.box[0]) / _top(s) + 2.2  # the axes keep the scene's proportions
    figure = Figure(figsize=(max(width, 5.0), height + 0.6), layout="constrained")
    axes = figure.subplots()
    axes.locator_params(axis="x", nbins=5)
    _draw_grains(axes, s, middle)
    coloured = _draw_forces(axes, s, middle, thickness)
    _draw_projectile(axes, s)

    length, _, _ = s.box
    axes.plot(
        [-length / 2, -length / 2, length / 2, length / 2], _wall_heights(s), color="0.35", lw=2
    )
    axes.set_aspect("equal")
    axes.set_xlim(-0.53 * length, 0.53 * length)
    axes.set_ylim(-0.01 * length, _top(s))
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m]")
    moment = f"{s.time * 1e3:.1f} ms after first touch" if s.time >= 0 else "before first touch"
    axes.set_title(f"contact forces {moment}, slice of {thickness * 1e3:.0f} mm")
    if coloured is not None:
        figure.colorbar(coloured, ax=axes, label="contact force [N]", shrink=0.85)
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)
    return path


def _top(s: Snapshot) -> float:
    """Height of the picture [m]: the projectile's upper end or the bed's surface, with a margin."""
    upper = s.position[2] + float(np.max((s.rotation @ _ring(s))[2]))
    surface = float(np.max(s.centres[:, 2])) if len(s.centres) else 0.0
    return 1.03 * max(upper, surface)


def _wall_heights(s: Snapshot) -> list[float]:
    return [_top(s), 0.0, 0.0, _top(s)]


def _ring(s: Snapshot) -> np.ndarray:
    """The outline in the x-z plane of the projectile, both sides, shape (3, 2m)."""
    z, r = s.outline[:, 0], s.outline[:, 1]
    x = np.concatenate((r, -r[::-1]))
    return np.vstack((x, np.zeros_like(x), np.concatenate((z, z[::-1]))))


def _draw_grains(axes, s: Snapshot, middle: float) -> None:
    """Cut circles of the grains that the plane meets."""
    offset = s.centres[:, 1] - middle
    cut = np.abs(offset) < s.radii
    radius = np.sqrt(s.radii[cut] ** 2 - offset[cut] ** 2)
    axes.add_collection(
        EllipseCollection(
            2 * radius,
            2 * radius,
            np.zeros_like(radius),
            units="xy",
            offsets=s.centres[cut][:, [0, 2]],
            offset_transform=axes.transData,
            facecolor="#efe6d2",
            edgecolor="#c9b98f",
            linewidth=0.3,
        )
    )


def _draw_forces(axes, s: Snapshot, middle: float, thickness: float):
    """Branches of the contacts within the slice, coloured and widened by force; the strongest on top."""
    near = np.all(np.abs(s.contact_points[:, 1, :] - middle) < thickness / 2, axis=1)
    near &= s.contact_force > 0
    if not np.any(near):
        return None
    order = np.argsort(s.contact_force[near])
    force = s.contact_force[near][order]
    lines = np.swapaxes(s.contact_points[near][order][:, [0, 2], :], 1, 2)
    highest = max(float(force[-1]), 1e-12)
    norm = LogNorm(vmin=highest * 1e-3, vmax=highest)
    widths = 0.3 + 3.2 * np.sqrt(force / highest)
    collection = LineCollection(
        lines, linewidths=widths, cmap="inferno_r", norm=norm, capstyle="round"
    )
    collection.set_array(np.clip(force, highest * 1e-3, None))
    return axes.add_collection(collection)


def _draw_projectile(axes, s: Snapshot) -> None:
    points = s.rotation @ _ring(s) + s.position[:, None]
    axes.fill(
        points[0], points[2], facecolor="#5b7083", edgecolor="#26333d", linewidth=1.2, zorder=3
    )
