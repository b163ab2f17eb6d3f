# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts on the deformable wall, and what a scene without one does not load (MR-2629, Eq 22-27)."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from femlink_walls import POISSON, SAND, YOUNG, femlink, node_contacts, run_script

RADIUS = 0.01  # m, a coarse grain
GRAIN = (
    4 / 3 * 70e9 / (1 - 0.2**2) * RADIUS**0.5
)  # N/m^1.5, quartz on a wall that is rigid itself


def test_importing_grainfall_and_using_a_kept_wall_load_no_deal_ii(tmp_path: Path) -> None:
    femlink.cached_wall(femlink.box((1, 1, 1), (2, 2, 2)), SAND, cache=tmp_path)
    script = tmp_path / "scene.py"
    script.write_text(
        "import os\n"
        "from pathlib import Path\n"
        "import grainfall\n"
        "def mapped(name): return name in Path('/proc/self/maps').read_text()\n"
        "code = 1 * mapped('deal.ii') + 2 * mapped('femlink')\n"
        "from grainfall import femlink\n"
        "mesh = femlink.box((1, 1, 1), (2, 2, 2))\n"
        f"model = femlink.cached_wall(mesh, {SAND!r}, cache={str(tmp_path)!r})\n"
        "wall = femlink.Wall(model)\n"
        "wall.solve([0], [[0.0, 0.0]], free_overlap=[1e-5], coefficient=[1e9])\n"
        "code += 4 * mapped('deal.ii')\n"
        "femlink.Continuum(mesh, {0: (1e6, 0.3, 0.0)})\n"
        "code += 8 * (not mapped('deal.ii'))\n"
        "os._exit(code)\n"
    )
    run_script(script)


def test_a_kept_wall_is_the_wall_that_was_built(tmp_path: Path) -> None:
    mesh = femlink.box((0.1, 0.1, 0.05), (4, 4, 2))
    built = femlink.cached_wall(mesh, SAND, gravity=(0, 0, -9.81), cache=tmp_path)
    kept = femlink.cached_wall(mesh, SAND, gravity=(0, 0, -9.81), cache=tmp_path)
    assert len(list(tmp_path.iterdir())) == 1
    assert kept.key == built.key and kept.description == built.description
    assert (kept.compliance == built.compliance).all() and (kept.preload == built.preload).all()
    femlink.cached_wall(mesh, SAND, cache=tmp_path)
    assert len(list(tmp_path.iterdir())) == 2


def test_hertz_rigid_sphere_on_the_wall() -> None:
    contact_radius, sphere, cells_per_radius = 0.01, 0.1, 4
    indentation = contact_radius**2 / sphere
    mesh = femlink.half_space_block(
        1.25 * contact_radius, 100 * contact_radius, contact_radius / cells_per_radius, 1.4
    )
    model = femlink.Continuum(mesh, SAND).condense()
    nodes = model.surface.nodes
    distance = np.hypot(nodes[:, 0], nodes[:, 1])
    near = np.nonzero(distance < 1.3 * contact_radius)[0]
    faces, references = node_contacts(model.surface, near)
    free_overlap = indentation - distance[near] ** 2 / (2 * sphere)
    # Contacts stiffer than the wall by 1e4: a rigid sphere that touches node by node.
    stiffness = 1e4 / np.diag(model.compliance)[2::3].max()
    found = femlink.Wall(model).solve(
        faces,
        references,
        patch=0,
        free_overlap=list(free_overlap),
        relation="linear",
        coefficient=[stiffness] * len(faces),
        tolerance=1e-8,
    )
    assert found["converged"]
    hertz = 4 / 3 * YOUNG / (1 - POISSON**2) * sphere**0.5 * indentation**1.5
    # The block ends at a hundred contact radii, which makes it 1 % stiffer than a half-space.
    assert found["force"][:, 0].sum() == pytest.approx(hertz, rel=0.02)
    # Where it touches: Hertz's contact radius, to within a node.
    touching = distance[near][found["force"][:, 0] > 0]
    assert abs(touching.max() - contact_radius) < 1.5 * contact_radius / cells_per_radius


def sand_wall() -> femlink.Wall:
    """Half-space of sand with faces of 10 mm on 80 mm."""
    return femlink.Wall(
        femlink.Continuum(femlink.half_space_block(0.04, 1.0, 0.01, 1.5), SAND).condense()
    )


def middle_face(wall: femlink.Wall) -> int:
    """A face beside the wall's middle."""
    return wall.model.surface.closest((0.005, 0.005, 0))[0]


def test_compliance_hardly_depends_on_where_in_a_face_the_grain_sits() -> None:
    wall = sand_wall()
    face = middle_face(wall)
    places = [[x, y] for x in np.linspace(-1, 1, 7) for y in np.linspace(-1, 1, 7)]

    def ripple(patch: float) -> float:
        values = [wall.compliance([face], [place], patch=patch)[0, 0] for place in places]
        return max(values) / min(values)

    assert ripple(0.0) > 3  # a point load, as in Eq 27
    assert ripple(1.25) < 1.03
    assert ripple(1.5) < 1.03


def test_the_law_on_the_displaced_wall_gives_the_force_the_wall_was_solved_for() -> None:
    wall = sand_wall()
    surface = wall.model.surface
    face = middle_face(wall)
    for stiffness_ratio in (1e-3, 1.0, 1e3, 1e6):
        own = wall.compliance([face], [[0.2, -0.3]])[0, 0]
        coefficient = stiffness_ratio / own / 1e-5**0.5
        found = wall.solve(
            [face], [[0.2, -0.3]], free_overlap=[1e-5], relation="hertz", coefficient=[coefficient]
        )
        force = found["force"][0, 0]
        yielded = 1e-5 - (force / coefficient) ** (2 / 3)
        assert own * force == pytest.approx(yielded, rel=1e-9)
        # The mean displacement of the loaded nodes is what the contact saw.
        nodal, moved = found["nodal_force"], found["displacement"]
        assert (nodal * moved).sum() == pytest.approx(force * yielded, rel=1e-9)
        assert nodal.sum(axis=0) == pytest.approx([0, 0, -force], rel=1e-12, abs=1e-12 * force)
        moment = np.cross(surface.nodes, nodal).sum(axis=0)
        place = surface.nodes[surface.faces[face]].mean(axis=0) + [0.2 * 0.005, -0.3 * 0.005, 0]
        assert moment == pytest.approx(np.cross(place, [0, 0, -force]), abs=1e-12 * force)


def test_grains_beside_each_other_sink_deeper_and_slide_at_the_friction_limit() -> None:
    wall = sand_wall()
    places = [(x, y) for x in (-0.02, 0.0, 0.02) for y in (-0.02, 0.0, 0.02)]
    faces, references = [], []
    for x, y in places:
        face, point = wall.model.surface.closest((x + 1e-4, y + 1e-4, 0))
        faces.append(face)
        references.append(point.reference)
    alone = wall.solve(faces[:1], references[:1], free_overlap=[1e-5], coefficient=[GRAIN])
    found = wall.solve(
        faces,
        references,
        free_overlap=[1e-5] * 9,
        free_shear=np.tile([1e-4, 0.0], (9, 1)),
        coefficient=[GRAIN] * 9,
        shear_stiffness=1e6,
        friction=0.5,
    )
    force = found["force"]
    assert found["converged"]
    assert (force[:, 0] < alone["force"][0, 0]).all()
    assert force[4, 0] < force[[0, 2, 6, 8], 0].min()  # its neighbours have pushed the middle down
    assert np.linalg.norm(force[:, 1:], axis=1) == pytest.approx(0.5 * force[:, 0], rel=1e-9)


def test_staggered_exchange_is_refused_where_it_diverges() -> None:
    wall = sand_wall()
    face = middle_face(wall)
    with pytest.raises(
        ValueError, match="^coupling = 'staggered': must be 'implicit' here: .* diverges"
    ):
        wall.solve([face], [[0, 0]], free_overlap=[1e-5], coefficient=[GRAIN], coupling="staggered")
    soft = 0.5 / wall.compliance([face], [[0, 0]])[0, 0]
    options = dict(free_overlap=[1e-5], relation="linear", coefficient=[soft])
    exchanged = wall.solve([face], [[0, 0]], coupling="staggered", **options)
    implicit = wall.solve([face], [[0, 0]], **options)
    assert exchanged["force"] == pytest.approx(implicit["force"], rel=1e-8)
    assert exchanged["sweeps"] > 20 > implicit["sweeps"]


def test_bad_input_is_refused_in_one_sentence(tmp_path: Path) -> None:
    model = femlink.Continuum(femlink.box((1, 1, 1), (2, 2, 2)), SAND).condense()
    wall = femlink.Wall(model)
    good = dict(free_overlap=[1e-5], coefficient=[1e9])
    for arguments, options, expected in [
        (([9], [[0, 0]]), good, "face = 9: must be in [0, 3]"),
        (([0], [[0, 2]]), good, "references = 2: must be in [0, 1]"),
        (([0], [[0, 0]]), {**good, "friction": -1}, "friction = -1: must be >= 0 and finite"),
        (([0], [[0, 0]]), {**good, "relation": "cubic"}, "relation = 'cubic': must be"),
        (([0], [[0, 0]]), {**good, "coupling": "both"}, "coupling = 'both': must be"),
        (([0], [[0, 0]]), {**good, "coefficient": [0.0]}, "coefficient = 0: must be > 0"),
        (([0], [[0, 0]]), {**good, "free_overlap": []}, "free_overlap = list of length 0"),
    ]:
        with pytest.raises(ValueError) as caught:
            wall.solve(*arguments, **options)
        assert str(caught.value).startswith(expected)
    with pytest.raises(RuntimeError, match="^wall file 'absent.gfw': cannot be read$"):
        femlink.load_wall("absent.gfw")
