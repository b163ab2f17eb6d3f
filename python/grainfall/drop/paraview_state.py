# SPDX-License-Identifier: GPL-2.0-or-later
"""A ParaView state as a Python script: grains, projectile, and one half of the continuum around them.

Written beside the files that it shows; ``paraview --script=vtk/scene.py`` opens it.
"""
from __future__ import annotations

from pathlib import Path

SCRIPT = """# Shows this drop: paraview --script=scene.py
from paraview.simple import *

scene = PVDReader(FileName={collection!r})  # change this where the folder has been moved
view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().GoToLast()


def part(name):
    return ExtractBlock(Input=scene, Selectors=["/Root/" + name])


grains = Glyph(Input=part("grains"), GlyphType="Sphere", GlyphMode="All Points")
grains.OrientationArray = ["POINTS", "No orientation array"]
grains.ScaleArray = ["POINTS", "radii"]
grains.ScaleFactor = 2.0
ColorBy(Show(grains, view), ("POINTS", "linVelVec", "Magnitude"))

shown = Show(part("projectile"), view)
ColorBy(shown, None)
shown.DiffuseColor = [0.8, 0.3, 0.1]

# The half behind the impact, so that one looks into the cavity.
continuum = Clip(Input=part("continuum"), ClipType="Plane")
continuum.ClipType.Origin = [0.0, 0.0, 0.0]
continuum.ClipType.Normal = [0.0, 1.0, 0.0]
continuum.Invert = 0
shown = Show(continuum, view)
shown.Representation = "Surface With Edges"
ColorBy(shown, ("POINTS", "displacement", "Magnitude"))
shown.SetScalarBarVisibility(view, True)

view.CameraPosition = [0.0, -{distance}, {distance}]
view.CameraFocalPoint = [0.0, 0.0, 0.0]
view.CameraViewUp = [0.0, 0.0, 1.0]
Render(view)
"""


def write_state(folder: Path, size: float) -> None:
    """Write ``scene.py`` into the folder of ``scene.pvd``; `size`: of what is shown [m]."""
    text = SCRIPT.format(collection=str((folder / "scene.pvd").resolve()), distance=round(size, 3))
    (folder / "scene.py").write_text(text, encoding="ascii")
