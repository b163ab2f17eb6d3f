# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares what headers declare with live objects of the running YADE.

Two sentinels per member: one written through YADE's Python and read at the place that the headers give it, one written
there and read back through YADE's Python. What Python cannot reach is compared with a table of measured places.
"""
from __future__ import annotations

import csv
from functools import cache
from pathlib import Path

import abi_probe
import yade
import yade.wrapper
from declarations import Class, Declarations, Member, compile_declarations
from yade.minieigenHP import Matrix3, Quaternion, Vector3, Vector3i

MEASURED = Path(__file__).with_name("measured_offsets.csv")

# Two values for each type that the memory probe can read and write.
SENTINELS: dict[str, tuple] = {
    "Real": (0.8125, -3.28125),
    "int": (1234567, -76543),
    "unsigned": (1234567, 76543),
    "long": (1 << 41, -(1 << 43)),
    "unsigned long": (1 << 41, 1 << 43),
    "bool": (True, False),
    "string": ("a sentinel longer than any small buffer", "short"),
    "Vector3r": (Vector3(1.5, -2.25, 3.125), Vector3(-7, 0.5, 11)),
    "Vector3i": (Vector3i(4, -5, 6), Vector3i(-7, 8, -9)),
    "Quaternionr": (Quaternion(0.5, 0.5, 0.5, 0.5), Quaternion(0, 1, 0, 0)),
    "Matrix3r": (Matrix3(1, 2, 3, 4, 5, 7, 8, 9, 11), Matrix3(2, 0, 0, 1, 3, 0, 0, 1, 5)),
    "Se3r": (
        (Vector3(1, 2, 3), Quaternion(0, 0, 1, 0)),
        (Vector3(4, 5, 6), Quaternion(1, 0, 0, 0)),
    ),
    "vector<int>": ([3, 1, 4], [15, 9]),
    "vector<string>": (["one", "two"], ["three"]),
    "vector<Vector3r>": ([Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 2, 0)],) * 2,
}
OBJECTS = {
    "material": "FrictMat",
    "state": "State",
    "shape": "Sphere",
    "bound": "Aabb",
    "geom": "ScGeom",
    "phys": "FrictPhys",
    "subD": "Box",
}
# Python shows this member in another form than memory does: sentinel in memory -> what Python says.
PYTHON_FORM = {("State", "blockedDOFs"): {9: "xX", 32: "Z"}}
# YADE computes these anew whenever attributes are set; then only agreement can be asked for.
COMPUTED = {("Facet", "normal"), ("Facet", "area"), ("Cell", "prevHSize")}


@cache
def declared() -> Declarations:
    """What yade-headers/ declares (compiled once)."""
    return compile_declarations()


@cache
def measured() -> dict[tuple[str, str], tuple[int, int]]:
    """Offset and size in bytes of members that Python cannot reach."""
    with MEASURED.open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {
            (row["class"], row["member"]): (int(row["offset_bytes"]), int(row["size_bytes"]))
            for row in rows
        }


def reachable(class_name: str, member: str) -> bool:
    """Is this member an attribute in YADE's Python?"""
    cls = getattr(yade.wrapper, class_name, None)
    return (class_name, member) not in measured() and isinstance(
        getattr(cls, member, None), property
    )


def members(declarations: Declarations) -> list[tuple[str, str]]:
    """Every declared member, as (class, member)."""
    return [(c, m) for c, cls in sorted(declarations.classes.items()) for m in cls.members]


def sentinels(class_name: str, name: str, member: Member) -> tuple:
    """Two values to tell this member by."""
    if (class_name, name) in PYTHON_FORM:
        return tuple(PYTHON_FORM[class_name, name])
    if member.type == "shared_ptr":
        make = getattr(yade.wrapper, OBJECTS[name])
        return make(), make()
    return SENTINELS[member.type]


def as_python_shows(class_name: str, name: str, value):
    """Give the form in which Python returns a member that holds this value."""
    forms = PYTHON_FORM.get((class_name, name))
    return forms.get(value, value) if forms else value


def python_to_memory(class_name: str, name: str, member: Member) -> str:
    """Write through Python, read through the declared place; what differs, or ''."""
    instance = getattr(yade.wrapper, class_name)()
    for value in sentinels(class_name, name, member):
        try:
            instance.updateAttrs({name: value})  # sets read-only attributes too
        except AttributeError:
            setattr(instance, name, value)
        seen = abi_probe.read(abi_probe.address(instance) + member.offset, member.type)
        shown = getattr(instance, name)
        if not same(as_python_shows(class_name, name, seen), shown):
            return f"{class_name}.{name} is {shown} in Python, {seen} at byte {member.offset}"
        if (class_name, name) not in COMPUTED and not same(
            shown, as_python_shows(class_name, name, value)
        ):
            return f"{class_name}.{name} was set to {value} and is {shown}"
    return ""


def memory_to_python(class_name: str, name: str, member: Member) -> str:
    """Write at the declared place, read through Python; what differs, or ''."""
    instance = getattr(yade.wrapper, class_name)()
    for value in sentinels(class_name, name, member):
        abi_probe.write(abi_probe.address(instance) + member.offset, member.type, value)
        shown = getattr(instance, name)
        if not same(as_python_shows(class_name, name, value), shown):
            return (
                f"{class_name}.{name}: wrote {value} at byte {member.offset}, Python shows {shown}"
            )
    return ""


def misplaced(class_name: str, name: str, member: Member) -> str:
    """Compare with the measured place; what differs, or ''."""
    place = measured()[class_name, name]
    if (member.offset, member.size) == place:
        return ""
    return f"{class_name}.{name}: declared at byte {member.offset}, {member.size} bytes; measured {place}"


def same(first, second) -> bool:
    if isinstance(first, (list, tuple)):
        return len(first) == len(second) and all(map(same, first, second))
    return type(first) is type(second) and first == second


def disagreements(cls_name: str, cls: Class) -> list[str]:
    """What a declared class has in other places than the running YADE; nothing is written through the headers."""
    found = []
    for name, member in cls.members.items():
        if reachable(cls_name, name):
            found.append(python_to_memory(cls_name, name, member))
        elif (cls_name, name) in measured():
            found.append(misplaced(cls_name, name, member))
    return [text for text in found if text]
