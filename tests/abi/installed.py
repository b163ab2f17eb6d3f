# SPDX-License-Identifier: GPL-2.0-or-later
"""Virtual tables as they stand in YADE's installed libraries.

A table is a dynamic symbol whose words the loader fills: its relocations name the functions.
"""
from __future__ import annotations

import re
import subprocess
from functools import cache
from pathlib import Path

import abi_build
from elftools.elf.elffile import ELFFile

R_X86_64_64 = 1
LIBRARIES = ("libyade.so", "libpkg_common.so", "libpkg_dem.so")


class Library:
    """Dynamic symbols and relocations of one library."""

    def __init__(self, path: Path) -> None:
        with path.open("rb") as file:
            elf = ELFFile(file)
            symbols = elf.get_section_by_name(".dynsym")
            self.names = [symbol.name for symbol in symbols.iter_symbols()]
            self.tables = {
                symbol.name: (symbol["st_value"], symbol["st_size"])
                for symbol in symbols.iter_symbols()
                if symbol.name.startswith("_ZTVN4yade") and symbol["st_shndx"] != "SHN_UNDEF"
            }
            data = elf.get_section_by_name(".data.rel.ro")
            self.data, self.data_start = data.data(), data["sh_addr"]
            self.relocations = {
                r["r_offset"]: self.names[r["r_info_sym"]]
                for r in elf.get_section_by_name(".rela.dyn").iter_relocations()
                if r["r_info_type"] == R_X86_64_64
            }

    def table(self, class_name: str) -> list[str] | None:
        """Give the words of a class's table: mangled names, or numbers (offsets to the top)."""
        place = self.tables.get(f"_ZTVN4yade{len(class_name)}{class_name}E")
        if place is None:
            return None
        start, size = place
        return [self._word(address) for address in range(start, start + size, 8)]

    def _word(self, address: int) -> str:
        if address in self.relocations:
            return self.relocations[address]
        at = address - self.data_start
        return str(int.from_bytes(self.data[at : at + 8], "little", signed=True))


@cache
def libraries() -> list[Library]:
    return [Library(Path(abi_build.LIBRARY_DIR) / name) for name in LIBRARIES]


def virtual_table(class_name: str) -> list[str] | None:
    """Entries of a class's table: numbers, 'typeinfo', 'thunk N' or Class::function; None if no library has one.

    Raises AssertionError if two libraries disagree.
    """
    tables = [table for library in libraries() if (table := library.table(class_name))]
    if not tables:
        return None
    assert all(table == tables[0] for table in tables), f"libraries disagree about {class_name}"
    return [_entry(word) for word in _demangle(tables[0])]


def called_signatures(class_name: str) -> set[tuple[str, ...]]:
    """Result and parameter types of each `go` in a functor family's table, as (result, parameter, ...)."""
    table = next(table for library in libraries() if (table := library.table(class_name)))
    found = set()
    for text in _demangle(table):
        if match := re.match(r"yade::FunctorWrapper<(\w+), .*>::go\((.*)\)$", text):
            found.add((match.group(1), *map(plain_type, split_types(match.group(2)))))
    return found


def split_types(text: str) -> list[str]:
    """Split a list of types at the commas that stand outside angle brackets."""
    parts, depth = [""], 0
    for character in text:
        depth += {"<": 1, ">": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def plain_type(text: str) -> str:
    """Write `const T&` as `T const&`, the one of the two spellings that c++filt uses."""
    return re.sub(r"^const (.*?)([&*])$", r"\1 const\2", text)


def table_differences(class_name: str, declared: list[str]) -> list[str]:
    """Compare a declared table with the installed one, slot by slot; the slots that differ, as text."""
    theirs = virtual_table(class_name)
    if theirs is None:
        return [f"no library has a table of {class_name}"]
    if len(theirs) != len(declared):
        return [f"{class_name} has {len(theirs)} slots, declared are {len(declared)}"]
    return [
        f"{class_name}, slot {slot}: {installed}, declared {ours}"
        for slot, (installed, ours) in enumerate(zip(theirs, declared, strict=True))
        if not _same_slot(installed, ours)
    ]


def _same_slot(installed: str, declared: str) -> bool:
    # Our functor table is a chain of classes with one slot each; slots that are never called have no signature.
    part_of_chain = {"FunctorRoot::checkOrder", "GoSlot::go", "GoReverseSlot::goReverse"}
    if declared == "UnusedSlots::unused":
        return installed in ("FunctorWrapper::go", "FunctorWrapper::goReverse")
    if declared in part_of_chain:
        return installed == "FunctorWrapper::" + declared.split("::")[1]
    return installed == declared


def _demangle(words: list[str]) -> list[str]:
    plain = subprocess.run(
        ["c++filt"], input="\n".join(words), capture_output=True, text=True, check=True
    )
    return [
        f"thunk {m.group(1)}" if (m := re.match(r"_ZThn(\d+)_", word)) else text
        for word, text in zip(words, plain.stdout.splitlines(), strict=True)
    ]


def _entry(text: str) -> str:
    if text.startswith("typeinfo for"):
        return "typeinfo"
    while (shorter := re.sub(r"<[^<>]*>", "", text)) != text:  # template arguments, innermost first
        text = shorter
    text = re.sub(r"\(.*", "", text.replace("[abi:cxx11]", ""))
    return text.removeprefix("yade::")
