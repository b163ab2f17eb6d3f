# SPDX-License-Identifier: GPL-2.0-or-later
"""What a set of headers declares, as the compiler lays it out: sizes, members, virtual tables.

The headers are compiled by themselves and the debug information and class dump are read, so a class or member that is
added to them turns up here without being listed anywhere.
"""
from __future__ import annotations

import re
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import abi_build
from elftools.elf.elffile import ELFFile

FLAGS = [
    *("-std=gnu++17", "-fPIC", "-fopenmp", "-frounding-math", "-DBOOST_ALLOW_DEPRECATED_HEADERS"),
    *("-DEIGEN_DONT_ALIGN", "-DEIGEN_DONT_VECTORIZE", "-DEIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT"),
    *("-isystem", "/usr/include/eigen3", "-isystem", abi_build.PYTHON_INCLUDE),
]
HEADERS = Path(abi_build.SOURCE_DIR) / "yade-headers"
CLASS = re.compile(r"^(template <[^\n]*>\s)?(?:class|struct) (\w+)\s*(?::[^;{]*)?\{", re.MULTILINE)
OWN_NAMESPACE = re.compile(
    r"^namespace (?:yade::)?abi \{.*?^\} // namespace (?:yade::)?abi$", re.M | re.S
)


@dataclass(frozen=True)
class Member:
    """One data member: offset and size in bytes, and the name of its type."""

    offset: int
    size: int
    type: str


@dataclass
class Class:
    """One class: size in bytes, own members, and the header that declares it."""

    size: int
    members: dict[str, Member] = field(default_factory=dict)


@dataclass
class Declarations:
    """Everything that a set of headers declares."""

    classes: dict[str, Class]
    templates: set[str]
    virtual_tables: dict[str, list[str]]


def declared_names(headers: Path) -> tuple[set[str], set[str]]:
    """Names of classes and of class templates in the headers, those in namespace abi (ours alone) left out."""
    classes: set[str] = set()
    templates: set[str] = set()
    for header in headers.rglob("*.hpp"):
        for template, name in CLASS.findall(
            OWN_NAMESPACE.sub("", header.read_text(encoding="utf-8"))
        ):
            (templates if template else classes).add(name)
    return classes, templates - classes


def compile_declarations(headers: Path = HEADERS) -> Declarations:
    """Compile all headers of a folder as one source file and read what became of them."""
    classes, templates = declared_names(headers)
    includes = [f"#include <{h.relative_to(headers)}>" for h in sorted(headers.rglob("*.hpp"))]
    # A pointer to a class makes the compiler describe it.
    uses = [f"{name}* use_{name};" for name in sorted(classes)]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "declarations.cpp"
        source.write_text(
            "\n".join([*includes, "using namespace yade;", *uses, ""]), encoding="utf-8"
        )
        subprocess.run(
            [abi_build.COMPILER, *FLAGS, "-w", "-g", "-O0", "-femit-class-debug-always"]
            + ["-fdump-lang-class=classes.txt", f"-I{headers}", "-c", source.name],
            cwd=folder,
            check=True,
        )
        with (Path(folder) / "declarations.o").open("rb") as object_file:
            described = _read_debug_information(ELFFile(object_file).get_dwarf_info())
        tables = _read_class_dump((Path(folder) / "classes.txt").read_text(encoding="utf-8"))
    wanted = {
        name: cls
        for name, cls in described.items()
        if name in classes or name.split("<")[0] in templates
    }
    return Declarations(
        wanted, templates, {name: tables[name] for name in classes if name in tables}
    )


def _name(die) -> str:
    return die.attributes["DW_AT_name"].value.decode() if "DW_AT_name" in die.attributes else ""


def _read_debug_information(information) -> dict[str, Class]:
    found: dict[str, Class] = {}
    for unit in information.iter_CUs():
        for die in unit.iter_DIEs():
            if die.tag not in ("DW_TAG_class_type", "DW_TAG_structure_type"):
                continue
            if "DW_AT_byte_size" not in die.attributes or not _name(die):
                continue
            cls = Class(die.attributes["DW_AT_byte_size"].value)
            for child in die.iter_children():
                if (
                    child.tag == "DW_TAG_member"
                    and "DW_AT_data_member_location" in child.attributes
                ):
                    place = child.attributes["DW_AT_data_member_location"].value
                    if not _name(child).startswith("_vptr"):
                        cls.members[_name(child)] = Member(place, *_size_and_type(child))
            found.setdefault(_name(die), cls)
    return found


def _size_and_type(die) -> tuple[int, str]:
    """Size in bytes and plain name of a member's type; names of type aliases are followed to the end."""
    die = die.get_DIE_from_attribute("DW_AT_type")
    while die.tag in ("DW_TAG_typedef", "DW_TAG_const_type"):
        die = die.get_DIE_from_attribute("DW_AT_type")
    if die.tag in ("DW_TAG_pointer_type", "DW_TAG_reference_type"):
        return 8, "pointer" if die.tag == "DW_TAG_pointer_type" else "reference"
    if die.tag == "DW_TAG_array_type":
        element, _ = _size_and_type(die)
        length = 1
        for bound in die.iter_children():
            length *= bound.attributes["DW_AT_upper_bound"].value + 1
        return element * length, "array"
    return die.attributes["DW_AT_byte_size"].value, _plain_type(_name(die))


def _plain_type(name: str) -> str:
    """Give the name under which the memory probe knows a type."""
    name = re.sub(r", std::(allocator|char_traits)<.*?>+ ?", "", name)
    plain = {
        "double": "Real",
        "unsigned int": "unsigned",
        "long int": "long",
        "long unsigned int": "unsigned long",
        "long long unsigned int": "unsigned long",
        "Matrix<double, 3, 1, 0, 3, 1>": "Vector3r",
        "Matrix<int, 3, 1, 0, 3, 1>": "Vector3i",
        "Matrix<double, 3, 3, 0, 3, 3>": "Matrix3r",
        "Quaternion<double, 0>": "Quaternionr",
        "Se3<double>": "Se3r",
    }
    if name.startswith("basic_string<"):
        return "string"
    if name.startswith("shared_ptr<"):
        return "shared_ptr"
    if name.startswith("vector<"):
        inside = name[len("vector<") :]
        for text, element in (
            ("int", "int"),
            ("std::__cxx11::basic_string", "string"),
            ("Eigen::Matrix<double, 3, 1", "Vector3r"),
        ):
            if inside.startswith(text):
                return f"vector<{element}>"
        return "vector"
    return plain.get(name, name)


def _read_class_dump(text: str) -> dict[str, list[str]]:
    """Entries of each virtual table of namespace yade: numbers, 'typeinfo', 'thunk' or Class::function."""
    tables: dict[str, list[str]] = {}
    for block in re.split(r"^Vtable for ", text, flags=re.MULTILINE)[1:]:
        lines = block.split("\n\n")[0].splitlines()
        if match := re.fullmatch(r"yade::(\w+)", lines[0].strip()):
            tables[match.group(1)] = [_entry(line) for line in lines[2:] if re.match(r"\d+ ", line)]
    return tables


def _entry(line: str) -> str:
    text = re.sub(r"^\d+\s+(\(int \(\*\)\(\.\.\.\)\))?", "", line).strip()
    if text.startswith("(& _ZTI"):
        return "typeinfo"
    if match := re.search(r"_ZThn(\d+)_", text):
        return f"thunk {match.group(1)}"
    text = re.sub(r"<.*>", "", text)
    return text.removeprefix("yade::").replace("abi::", "")
