# SPDX-License-Identifier: GPL-2.0-or-later
"""Refuses a YADE for which the extension module was not verified.

The module knows where YADE keeps each member of its classes. In another version or precision these places differ and
nothing would say so: the libraries have the same names and numbers would be read from the wrong memory. So this is
checked before the module is loaded, here, and before it is compiled, by ``cmake/CheckYade.cmake`` which runs this
file as a script.
"""
from __future__ import annotations

import os
import re
import struct
import sys
import warnings
from dataclasses import dataclass, replace
from pathlib import Path

ALLOW_VARIABLE = "GRAINFALL_ALLOW_UNVERIFIED_YADE"


@dataclass(frozen=True)
class YadeBuild:
    """What identifies a YADE installation.

    Parameters
    ----------
    version
        version number as YADE prints it.
    bits
        size of its real numbers: 64 is double precision.
    build_ids
        build identifier of each library that the extension links, by file name.
    """

    version: str
    bits: int
    build_ids: dict[str, str]

    def __str__(self) -> str:
        return f"YADE {self.version} ({self.bits}-bit real numbers)"


VERIFIED = YadeBuild(
    version="2023.02a",
    bits=64,
    build_ids={
        "libyade.so": "ab5587ac78af12fe3854492b492477acfe3232cf",
        "libpkg_common.so": "19a40f7f0ca11dea152744a6c7e37f281b0ae033",
        "libpkg_dem.so": "7762461858975c1ded391bce08efb28114fa3f2d",
    },
)


def build_id(library: Path) -> str:
    """Build identifier that the linker left in a 64-bit ELF file, as hex digits; '' if there is none."""
    if not library.exists():
        return ""
    with library.open("rb") as file:
        header = file.read(64)
        if header[:5] != b"\x7fELF\x02":
            return ""
        table, entry_size, entries = (
            struct.unpack_from("<Q", header, 32)[0],
            *struct.unpack_from("<HH", header, 54),
        )
        for i in range(entries):
            file.seek(table + i * entry_size)
            kind, _, offset, _, _, size = struct.unpack("<IIQQQQ", file.read(40))
            if kind != 4:  # PT_NOTE
                continue
            file.seek(offset)
            found = _gnu_build_id(file.read(size))
            if found:
                return found
    return ""


def _gnu_build_id(notes: bytes) -> str:
    position = 0
    while position + 12 <= len(notes):
        name_size, value_size, kind = struct.unpack_from("<III", notes, position)
        name = position + 12
        value = name + (name_size + 3) // 4 * 4
        if kind == 3 and notes[name : name + name_size] == b"GNU\0":
            return notes[value : value + value_size].hex()
        position = value + (value_size + 3) // 4 * 4
    return ""


def installed_build(library_dir: Path) -> YadeBuild:
    """Read what YADE's libraries in a folder are, without loading them."""
    config = (library_dir / "py" / "yade" / "config.py").read_text(encoding="utf-8")
    version = re.search(r"^version\s*=\s*'([^']*)'", config, re.MULTILINE)
    bits = re.search(r"^highPrecisionBits\s*=\s*(\d+)", config, re.MULTILINE)
    return YadeBuild(
        version=version.group(1) if version else "of unknown version",
        bits=int(bits.group(1)) if bits else 0,
        build_ids={name: build_id(library_dir / name) for name in VERIFIED.build_ids},
    )


def running_build() -> YadeBuild:
    """Identify the YADE of this interpreter, importing it if it is not yet."""
    try:
        import yade.config
    except ImportError as error:
        raise ImportError(
            f"grainfall found no YADE in this interpreter ({sys.executable}), and runs inside the verified "
            f"{VERIFIED}: start the script with 'yade'."
        ) from error
    libraries = Path(yade.config.libDir)
    return YadeBuild(
        version=yade.config.version,
        bits=int(yade.config.highPrecisionBits),
        build_ids={name: build_id(libraries / name) for name in VERIFIED.build_ids},
    )


def objection(found: YadeBuild, verified: YadeBuild) -> str:
    """Why this version or precision is refused, as one sentence; '' if it is not."""
    if (found.version, found.bits) == (verified.version, verified.bits):
        return ""
    return f"grainfall found {found}, but only {verified} is verified."


def build_objection(found: YadeBuild, verified: YadeBuild) -> str:
    """Why this build of the right version is doubted, as one sentence; '' if it is not."""
    others = [
        name for name, known in verified.build_ids.items() if found.build_ids.get(name) != known
    ]
    if not others:
        return ""
    return (
        f"grainfall found {found} with another build of {', '.join(others)} than the verified one "
        f"(build id {', '.join(verified.build_ids[name] for name in others)}); "
        f"set {ALLOW_VARIABLE}=1 to use it nevertheless."
    )


def verified_build() -> YadeBuild:
    """Give the build that the extension module was compiled for."""
    from grainfall import _build_info

    if _build_info.HEADERS == "source":
        return YadeBuild(_build_info.VERSION, _build_info.BITS, _build_info.BUILD_IDS)
    return VERIFIED


def _unverified_allowed() -> bool:
    return os.environ.get(ALLOW_VARIABLE, "") not in ("", "0")


def require_verified_yade() -> None:
    """Raise ImportError with one sentence unless the running YADE is the verified one."""
    found, verified = running_build(), verified_build()
    refused = objection(found, verified)
    if refused:
        raise ImportError(refused)
    doubted = build_objection(found, verified)
    if doubted and _unverified_allowed():
        warnings.warn(doubted, RuntimeWarning, stacklevel=2)
    elif doubted:
        raise ImportError(doubted)


def _check_installation(library_dir: Path, any_version: bool) -> int:
    """For CMake: print the sentence and fail, or print what was found as a CMake list."""
    if not (library_dir / "py" / "yade" / "config.py").exists():
        print(f"grainfall found no YADE in {library_dir}; it needs {VERIFIED}.", end="")
        return 1
    found = installed_build(library_dir)
    refused, doubted = objection(found, VERIFIED), build_objection(found, VERIFIED)
    if any_version:
        refused, doubted = objection(found, replace(found, bits=VERIFIED.bits)), ""
    if doubted and _unverified_allowed():
        print(doubted, file=sys.stderr)
        doubted = ""
    described = ";".join([found.version, str(found.bits), *found.build_ids.values()])
    print(refused or doubted or described, end="")
    return 1 if refused or doubted else 0


if __name__ == "__main__":
    sys.exit(_check_installation(Path(sys.argv[1]), any_version="--any-version" in sys.argv[2:]))
