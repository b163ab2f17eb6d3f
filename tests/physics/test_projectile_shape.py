# SPDX-License-Identifier: GPL-2.0-or-later
"""SolidOfRevolution as a YADE object: measures, wrong input, presets, files for display."""

from __future__ import annotations

import json
import math
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from projectile_scene import material, vector
from yade import O, Vector3, wrapper

from grainfall.projectile_mesh import surface_mesh, write_stl, write_vtp
from grainfall.projectiles import (
    PRESETS,
    Projectile,
    cone,
    flat_cylinder,
    hemisphere,
    make_projectile,
    ogive,
    pointing,
    projectile,
    sphere,
)

CONE = [(0, 0, 0), (1, 0.5, 0), (1, 0, 0)]


def test_measures_of_a_hemispherical_rod_are_the_textbook_ones():
    a, length = 0.02, 0.1
    shape = hemisphere(2 * a, length).shape()
    body, cap = math.pi * a**2 * (length - a), 2 / 3 * math.pi * a**3
    assert shape.volume == pytest.approx(body + cap, rel=1e-12)
    assert list(shape.zoneAreas) == pytest.approx(
        [2 * math.pi * a**2, 2 * math.pi * a * (length - a), math.pi * a**2], rel=1e-12
    )
    assert shape.surfaceArea == pytest.approx(sum(shape.zoneAreas), rel=1e-12)
    assert shape.frontalArea == pytest.approx(math.pi * a**2, rel=1e-12)
    centroid = (body * (a + 0.5 * (length - a)) + cap * 5 / 8 * a) / (body + cap)
    assert shape.centroid == pytest.approx(centroid, rel=1e-12)
    assert (shape.length, shape.maxRadius) == pytest.approx((length, a), rel=1e-12)
    assert shape.noseZ == pytest.approx(-centroid, rel=1e-12)


def test_inertia_follows_from_density_or_mass():
    a, length, density = 0.03, 0.2, 1130.0
    shape = flat_cylinder(2 * a, length).shape()
    mass = density * math.pi * a**2 * length
    transverse = mass * (3 * a**2 + length**2) / 12
    expected = [transverse, transverse, 0.5 * mass * a**2]
    assert list(shape.inertia(density)) == pytest.approx(expected, rel=1e-12)
    assert list(shape.inertiaOfMass(mass)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("attributes", "complaint"),
    [
        ({"profile": []}, "profile: 0 vertices; allowed: at least 2"),
        ({"profile": [(0, 0), 3, (1, 0)]}, "profile: vertex 1 is 3; allowed: (z, r) or (z, r"),
        ({"profile": [(0, 0), (1, "a"), (1, 0)]}, "profile: vertex 1 is (1, 'a'); allowed"),
        ({"profile": [(0, 0, 0)]}, "profile: 1 vertices; allowed: at least 2"),
        ({"edgeRadius": 0.001}, "profile: 0 vertices; allowed: at least 2"),
        ({"profile": [(0, 0, 0), (1, -0.5, 0), (1, 0, 0)]}, "r of vertex 1 is -0.5 m; allowed"),
        ({"profile": [(0, 0.1, 0), (1, 0.5, 0), (1, 0, 0)]}, "r of vertex 0 is 0.1 m; allowed"),
        ({"profile": [(0, 0, 99), (1, 0.5, 0), (1, 0, 0)]}, "bulge of vertex 0 is 99; allowed"),
        ({"profile": [(0, 0, 0), (math.nan, 0.5, 0), (1, 0, 0)]}, "z of vertex 1 is nan; allowed"),
        ({"profile": [(1, 0, 0), (1, 0.5, 0), (0, 0, 0)]}, "order of the vertices"),
        ({"profile": [(0, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0, 0)]}, "meeting of segments 0 and 2"),
        ({"profile": CONE, "zones": ["nose"]}, "zones: 1 entries; allowed: one for each of the 2"),
        ({"profile": CONE, "zones": ["nose", "tail"]}, "entry 1 is 'tail'; allowed: 'nose'"),
        ({"profile": CONE, "edgeRadius": -1}, "edgeRadius = -1 m; allowed: >= 0"),
        ({"profile": CONE, "edgeRadius": math.inf}, "edgeRadius = inf m; allowed: >= 0"),
    ],
)
def test_a_wrong_attribute_is_refused_with_attribute_value_and_range(attributes, complaint):
    with pytest.raises(ValueError) as error:
        wrapper.SolidOfRevolution(**attributes)
    assert str(error.value).startswith("SolidOfRevolution.")
    assert complaint in str(error.value)


def test_wrong_arguments_of_methods_and_functors_are_refused():
    shape = wrapper.SolidOfRevolution(profile=CONE)
    with pytest.raises(ValueError, match="density = -1 kg/m3; allowed: > 0"):
        shape.inertia(-1)
    with pytest.raises(ValueError, match="mass = 0 kg; allowed: > 0"):
        shape.inertiaOfMass(0)
    with pytest.raises(ValueError, match="meridians: 2; allowed: 3 or more"):
        shape.mesh(2)
    with pytest.raises(ValueError, match="turnMargin = 0; allowed: > 0"):
        wrapper.Bo1_SolidOfRevolution_Aabb(turnMargin=0)
    with pytest.raises(AttributeError):
        shape.profile = CONE


@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda: ogive(0.05, 0.01), "length = 0.01 m; allowed: >= 0.0559"),
        (lambda: ogive(0.05, 0.2, 0.4), "calibre_radius_head = 0.4; allowed: > 0.5"),
        (lambda: ogive(0.05, 0.2, 1.5, 0.03), "tip_radius = 0.03; allowed: 0 to < 0.025"),
        (lambda: cone(0.05, 0.2, -1), "nose_length = -1; allowed: > 0"),
        (lambda: sphere(0), "diameter = 0; allowed: > 0"),
        (lambda: hemisphere(math.nan, 1), "diameter = nan; allowed: > 0"),
        (lambda: sphere(1).scaled(0), "factor = 0; allowed: > 0"),
        (lambda: projectile("m71"), "projectile = 'm71'; allowed: m70-full, m70-half, table1"),
        (lambda: make_projectile(sphere(0.1)), "mass = None, density = None; allowed: exactly one"),
        (lambda: make_projectile("table1"), "material: not given"),
        (lambda: pointing((0, 0, 0)), "direction: its norm = 0"),
    ],
)
def test_a_wrong_outline_is_refused_with_name_value_and_range(make, complaint):
    with pytest.raises(ValueError) as error:
        make()
    assert complaint in str(error.value)


def test_presets_have_the_reports_length_diameter_and_mass():
    # MR-2629, section 3.3 and Table 1.
    given = {
        "m70-full": (0.170, 0.05678, 0.40964),
        "m70_half": (0.08505, 0.02835, 0.05119),
        "table1": (None, 0.057, 10.0),
    }
    for name, (length, diameter, mass) in given.items():
        chosen = projectile(name)
        shape = chosen.shape()
        assert chosen.mass == mass
        assert 2 * shape.maxRadius == pytest.approx(diameter, rel=1e-9)
        if length:
            assert shape.length == pytest.approx(length, rel=1e-9)
        assert chosen.source.startswith(("Length", "Mass"))


def test_the_replicas_weigh_what_printed_plastic_weighs_and_scale_with_each_other():
    # Resins and filaments for printing lie between 1040 (ABS) and 1250 kg/m3 (PLA).
    densities = [PRESETS[n].mass / PRESETS[n].shape().volume for n in ("m70-full", "m70-half")]
    assert 1040 < densities[0] < 1250
    assert densities[1] == pytest.approx(densities[0], rel=0.003)
    assert PRESETS["m70-full"].scaled(0.5).mass == pytest.approx(PRESETS["m70-half"].mass, rel=1e-3)


def test_blunted_noses_are_smooth_and_of_the_length_asked_for():
    for outline in (ogive(0.05, 0.2, 1.5, 0.004), cone(0.05, 0.2, 0.1, 0.003), ogive(0.05, 0.2, 3)):
        shape = outline.shape()
        assert shape.length == pytest.approx(0.2, rel=1e-12)
        assert outline.profile[0][:2] == (0.0, 0.0)
        # Beside a smooth joint the normals of both pieces agree.
        for z, r, _ in outline.profile[1 : -2 if "cone" not in outline.name else 2]:
            normals = [
                vector(shape.closestPoint((r, 0, z + shift - shape.centroid))[2])
                for shift in (-1e-7, 1e-7)
            ]
            assert np.linalg.norm(normals[0] - normals[1]) < 2e-4


def test_a_body_stands_where_its_nose_was_asked_to_be_and_moves_as_asked():
    material()
    body = make_projectile(
        replace(PRESETS["m70-full"], mass=0.5),
        nose_at=(0.1, 0, 0.3),
        orientation=pointing((1, 0, 0)),
        velocity=(1, 2, 3),
        angular_velocity=(0, 0, 7),
    )
    tip = body.state.pos + body.state.ori * Vector3(0, 0, body.shape.noseZ)
    assert list(tip) == pytest.approx([0.1, 0, 0.3], abs=1e-15)
    assert (body.state.mass, body.aspherical) == (0.5, True)
    assert list(body.state.vel) == [1, 2, 3]
    # Lying along x it turns about z with its transverse inertia.
    assert body.state.angMom[2] == pytest.approx(7 * body.state.inertia[0], rel=1e-12)


def test_a_shape_survives_saving_and_is_listed_as_yades_own(tmp_path):
    material()
    zones = ["nose", "nose", "shaft", "base"]
    outline = replace(PRESETS["m70-full"], zones=tuple(zones))
    O.bodies.append(make_projectile(outline, edgeRadius=0.001, color=(1, 0, 0)))
    expected = O.bodies[0].shape.dict()
    volume = O.bodies[0].shape.volume
    path = str(tmp_path / "shape.xml.gz")
    O.save(path)
    O.reset()
    O.load(path)
    shape = O.bodies[0].shape
    assert [list(v) for v in shape.profile] == [list(v) for v in expected["profile"]]
    assert (shape.zones, shape.edgeRadius, shape.volume) == (zones, 0.001, volume)
    assert O.isChildClassOf("SolidOfRevolution", "Shape")


# Read in a process of its own: ParaView's vtk, where that package is installed, cannot be imported inside YADE.
READ_MESHES = """
import json, sys, vtk
volumes = []
for reader, name in ((vtk.vtkSTLReader(), "p.stl"), (vtk.vtkXMLPolyDataReader(), "p.vtp")):
    reader.SetFileName(sys.argv[1] + "/" + name)
    reader.Update()
    measure = vtk.vtkMassProperties()
    measure.SetInputData(reader.GetOutput())
    measure.Update()
    volumes.append(measure.GetVolume())
zones = reader.GetOutput().GetCellData().GetArray("zone").GetNumberOfTuples()
print(json.dumps([volumes, zones]))
"""


def test_mesh_files_hold_the_solid_where_it_stands(tmp_path):
    material()
    body = make_projectile("m70-half", position=(1, 2, 3), orientation=pointing((1, 1, 0)))
    points, triangles, zones = surface_mesh(body, 90)
    corners = points[triangles]
    parts = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    inner = parts.sum()
    assert inner == pytest.approx(body.shape.volume, rel=2e-3)
    assert set(zones) == {0, 1, 2}
    write_stl(tmp_path / "p.stl", body, 90)
    write_vtp(tmp_path / "p.vtp", body, 90)
    read = subprocess.run(
        ["/usr/bin/python3", "-c", READ_MESHES, str(tmp_path)],
        check=True,
        capture_output=True,
        text=True,
    )
    volumes, tuples = json.loads(read.stdout)
    assert volumes == pytest.approx([inner, inner], rel=1e-4), "STL has single precision"
    assert tuples == len(triangles)
    centroid = parts @ corners.sum(axis=1) / 4 / inner
    assert np.linalg.norm(centroid - (1, 2, 3)) < 1e-3 * body.shape.length


def test_straight_pieces_need_no_bulge():
    pairs = wrapper.SolidOfRevolution(profile=[(z, r) for z, r, _ in CONE])
    assert pairs.volume == wrapper.SolidOfRevolution(profile=CONE).volume


def test_an_outline_of_ones_own_is_a_list_of_vertices():
    mine = Projectile("mine", tuple(CONE), density=2000.0)
    assert mine.shape().volume == pytest.approx(math.pi * 0.25 / 3, rel=1e-12)
