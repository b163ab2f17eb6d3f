# SPDX-License-Identifier: GPL-2.0-or-later
"""Members that Python cannot reach, read at their declared place in a running scene and compared with what it shows."""
from __future__ import annotations

import abi_probe
import pytest
import yade
import yade.wrapper
from comparison import declared
from declarations import Member
from yade import utils
from yade.minieigenHP import Vector3

O = yade.wrapper.Omega()  # noqa: E741  YADE's own name
POINTER = 8
SHARED = 16


class At:
    """The object of a class at an address; attributes are read at the declared places."""

    def __init__(self, class_name: str, address: int) -> None:
        self.class_name, self.address = class_name, address

    def place(self, name: str) -> int:
        return self.address + self._member(name).offset

    def value(self, name: str):
        return abi_probe.read(self.place(name), self._member(name).type)

    def _member(self, name: str) -> Member:
        return declared().classes[self.class_name].members[name]

    def pointer(self, name: str) -> int:
        return abi_probe.pointer(self.place(name))

    def length(self, name: str, element: int) -> int:
        """Number of elements of a vector, from its first two pointers and the element's size in bytes."""
        begin, end = (abi_probe.pointer(self.place(name) + POINTER * i) for i in (0, 1))
        return (end - begin) // element

    def map_size(self, name: str) -> int:
        """Number of entries of a std::map: the last word of its 48 bytes."""
        return abi_probe.read(self.place(name) + 40, "unsigned long")


def at(instance, class_name: str | None = None) -> At:
    return At(class_name or type(instance).__name__, abi_probe.address(instance))


@pytest.fixture
def parts() -> dict[str, At]:
    """A scene after one step: two touching spheres on a facet far away, energies traced."""
    O.trackEnergy = True
    O.bodies.append(utils.sphere((0, 0, 0), 0.1, fixed=True))
    O.bodies.append(utils.sphere((0, 0.05, 0.19), 0.1))
    O.bodies.append(utils.facet([(5, 0, 0), (6, 0, 0), (5, 2, 0)]))
    O.engines = [
        yade.ForceResetter(),
        yade.InsertionSortCollider([yade.Bo1_Sphere_Aabb(), yade.Bo1_Facet_Aabb()]),
        yade.InteractionLoop(
            [yade.Ig2_Sphere_Sphere_ScGeom()],
            [yade.Ip2_FrictMat_FrictMat_FrictPhys()],
            [yade.Law2_ScGeom_FrictPhys_CundallStrack(label="law")],
        ),
        yade.NewtonIntegrator(gravity=(0, 0, -9.81)),
    ]
    O.dt = 1e-6
    O.run(3, True)
    return {name: At(name, address) for name, address in abi_probe.scene_parts().items()}


def test_the_scene_s_clock_and_flags(parts):
    scene = parts["Scene"]
    assert scene.address == abi_probe.address(O._sceneObj)
    assert (scene.value("dt"), scene.value("iter"), scene.value("time")) == (1e-6, 3, O.time)
    assert scene.value("hostNameMax") == 255
    assert scene.value("trackEnergy") is True and scene.value("isPeriodic") is False
    O.periodic = True
    assert scene.value("isPeriodic") is True


def test_the_scene_s_containers(parts):
    scene = parts["Scene"]
    assert scene.length("engines", SHARED) == len(O.engines) == 4
    assert scene.length("_nextEngines", SHARED) == 0
    assert scene.length("materials", SHARED) == len(O.materials) == 1
    for member, part in (("bodies", "BodyContainer"), ("interactions", "InteractionContainer")):
        assert scene.pointer(member) == parts[part].address
    assert scene.pointer("energy") == parts["EnergyTracker"].address == abi_probe.address(O.energy)
    assert scene.pointer("cell") == parts["Cell"].address  # there even when nothing is periodic
    assert scene.place("forces") == parts["ForceContainer"].address


def test_bodies_and_their_contacts(parts):
    bodies = parts["BodyContainer"]
    assert bodies.length("body", SHARED) == len(O.bodies) == 3
    assert abi_probe.pointer(bodies.pointer("body") + SHARED) == abi_probe.address(O.bodies[1])
    assert at(O.bodies[0]).map_size("intrs") == 1
    assert at(O.bodies[2]).map_size("intrs") == 0


def test_an_interaction_and_its_cached_functors(parts):
    contact = O.interactions[0, 1]
    container, read = parts["InteractionContainer"], at(contact)
    assert (
        container.length("linIntrs", SHARED)
        == container.value("currSize")
        == len(O.interactions)
        == 1
    )
    assert abi_probe.pointer(container.pointer("linIntrs")) == abi_probe.address(contact)
    assert container.pointer("bodies") == parts["BodyContainer"].place("body")
    assert read.value("linIx") == 0
    loop = O.engines[2]
    functors = (
        loop.geomDispatcher.functors[0],
        loop.physDispatcher.functors[0],
        loop.lawDispatcher.functors[0],
    )
    cached = [abi_probe.pointer(read.place("functorCache") + 8 + SHARED * i) for i in range(3)]
    assert cached == [abi_probe.address(functor) for functor in functors]
    assert at(functors[2], "Functor").pointer("scene") == parts["Scene"].address
    bound_functor = O.engines[1].boundDispatcher.functors[0]
    assert at(O.bodies[0].shape, "Shape").pointer("boundFunctor") == abi_probe.address(
        bound_functor
    )


def test_forces_of_this_step(parts):
    forces = parts["ForceContainer"]
    assert forces.value("size") >= 3 and forces.value("nThreads") >= 1
    assert forces.value("lastReset") == 2
    O.forces.f(1, sync=True)
    summed = forces.value("_force")
    assert summed[1] == O.forces.f(1) != Vector3(0, 0, 0)
    assert forces.value("synced") is True
    assert forces.value("_torque")[1] == O.forces.t(1)
    O.forces.setPermF(1, (1, 2, 3))
    assert (
        forces.value("_permForce")[1] == Vector3(1, 2, 3) and forces.value("permForceUsed") is True
    )


def test_energies_by_name_and_by_thread(parts):
    tracker = parts["EnergyTracker"]
    sums = At("OpenMPArrayAccumulator<double>", tracker.place("energies"))
    assert tracker.map_size("names") == sums.value("elements") == len(O.energy.keys())
    threads = sums.value("threads")
    assert threads == sums.length("chunks", POINTER)
    chunks = sums.pointer("chunks")
    total = sum(
        abi_probe.read(abi_probe.pointer(chunks + POINTER * thread) + 8 * i, "Real")
        for thread in range(threads)
        for i in range(sums.value("elements"))
    )
    assert total == pytest.approx(O.energy.total(), rel=1e-14)  # another order of summation
    assert (sums.value("cacheLineBytes"), sums.value("perCacheLine")) == (64, 8)


def test_an_engine_s_scene_and_timing(parts):
    engine = at(O.engines[3], "Engine")
    assert engine.pointer("scene") == parts["Scene"].address
    O.engines[3].execCount, O.engines[3].execTime = 17, 1 << 33
    timing = At("TimingInfo", engine.place("timingInfo"))
    assert (timing.value("nExec"), timing.value("nsec")) == (17, 1 << 33)


def test_an_integrator_s_places_in_the_energies_and_its_caches(parts):
    integrator = at(O.engines[3], "NewtonIntegrator")
    sums = At("OpenMPArrayAccumulator<double>", parts["EnergyTracker"].place("energies"))

    def energy(member: str, class_name: str = "NewtonIntegrator") -> float:
        index = At(class_name, integrator.address).value(member)
        chunks, threads = sums.pointer("chunks"), sums.value("threads")
        rows = (abi_probe.pointer(chunks + POINTER * thread) for thread in range(threads))
        return sum(abi_probe.read(row + 8 * index, "Real") for row in rows)

    assert energy("nonviscDampIx") == O.energy["nonviscDamp"] > 0
    assert energy("kinEnergyIx") == O.energy["kinetic"] > 0
    assert energy("fieldWorkIx", "FieldApplier") == O.energy["gravWork"] != 0
    assert integrator.value("kinEnergyTransIx") == integrator.value("kinEnergyRotIx") == -1
    assert integrator.length("threadMaxVelocitySq", 8) == O.numThreads
    assert integrator.value("densityScaling") is False


def test_an_integrator_s_view_of_a_deforming_cell():
    O.periodic = True
    O.cell.setBox(4, 5, 6)
    O.engines = [yade.ForceResetter(), yade.NewtonIntegrator()]
    O.dt = 1e-3
    O.cell.velGrad = O.cell.hSize / 100
    O.run(3, True)
    integrator = at(O.engines[1], "NewtonIntegrator")
    assert integrator.value("cellChanged") is True
    assert integrator.value("homoDeform") == O.cell.homoDeform == 2
    assert integrator.value("prevCellSize") == O.cell.size
    assert integrator.value("dVelGrad").norm() == 0  # the gradient did not change in the last step


def test_references_point_into_their_own_object(parts):
    state, geometry = at(O.bodies[1].state), at(O.interactions[0, 1].geom)
    pose = At("Se3<double>", state.place("se3"))
    assert state.pointer("pos") == pose.place("position")
    assert state.pointer("ori") == pose.place("orientation")
    assert pose.value("position") == O.bodies[1].state.pos
    radii = at(O.interactions[0, 1].geom, "GenericSpheresContact")
    assert geometry.pointer("radius1") == radii.place("refR1")
    assert geometry.pointer("radius2") == radii.place("refR2")
    axis, normal = geometry.value("orthonormal_axis"), O.interactions[0, 1].geom.normal
    assert (
        abs(axis.dot(normal)) < 1e-12
    )  # the axis of the contact's turning lies in the contact plane


def test_a_facet_s_derived_lengths(parts):
    facet = at(O.bodies[2].shape)
    lengths = [abi_probe.read(facet.place("vl") + 8 * i, "Real") for i in range(3)]
    assert lengths == [vertex.norm() for vertex in O.bodies[2].shape.vertices]
    edge_normal = abi_probe.read(facet.place("ne"), "Vector3r")
    assert edge_normal.norm() == pytest.approx(1, abs=1e-12)
    sides = (1, 2, 5**0.5)
    inscribed = 2 * O.bodies[2].shape.area / sum(sides)
    assert facet.value("icr") == pytest.approx(inscribed, rel=1e-12)


def test_the_periodic_cell_s_caches(parts):
    O.periodic = True
    O.cell.setBox(4, 5, 6)
    O.cell.velGrad = O.cell.hSize / 100
    O.run(2, True)  # a velocity gradient acts from the step after the one in which it was set
    cell = At("Cell", abi_probe.address(O.cell))
    assert cell.value("_size") == O.cell.size
    assert cell.value("_shearTrsf") == O.cell.shearTrsf
    assert cell.value("_unshearTrsf") == O.cell.unshearTrsf
    assert cell.value("_hasShear") is False
    assert (cell.value("_invTrsf") * O.cell.trsf - cell.value("_shearTrsf")).norm() < 1e-12
    assert (cell.value("_vGradTimesPrevH") - O.cell.velGrad * O.cell.prevHSize).norm() < 1e-9


def test_the_class_factory_lists_stock_and_own_classes():
    names = abi_probe.plugin_classes()
    assert {"Sphere", "Scene", "AbiSample", "GrainMat"} <= set(names)
