# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the classes of the extension module part of the running YADE.

YADE itself does this once, at its start; what follows repeats it for classes that come later.
"""
from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator

import yade
import yade.system
import yade.utils
import yade.wrapper

from grainfall import _core, _published

_registered: list[str] = []


def register() -> tuple[str, ...]:
    """Register and publish every class of the module; names of all of them. Harmless if repeated."""
    _registered.extend(_core.register_classes())
    publish(_registered)
    refresh_dispatchers([*yade.wrapper.Omega().engines, *yade.utils.defaultEngines])
    _published.install()
    return tuple(_registered)


def publish(names: Iterable[str]) -> None:
    """Put the classes where scripts, consoles and ``from yade import *`` look for YADE's own."""
    main = sys.modules["__main__"]
    for name in names:
        cls = getattr(yade.wrapper, name)
        setattr(yade, name, cls)
        if not hasattr(main, name):
            setattr(main, name, cls)
        if name not in yade.__all__:
            yade.__all__.append(name)
        yade.system._allSerializables.add(name)


def refresh_dispatchers(engines: Iterable) -> None:
    """Let dispatchers made before the import learn the new classes.

    They size their tables when functors are given to them; a body of a class that came later would end the process.
    """
    for dispatcher in _dispatchers(engines):
        dispatcher.functors = dispatcher.functors


def _dispatchers(engines: Iterable) -> Iterator:
    for engine in engines:
        if isinstance(engine, yade.wrapper.ParallelEngine):
            for slave in engine.slaves:
                yield from _dispatchers(slave if isinstance(slave, list) else [slave])
        elif isinstance(engine, yade.wrapper.InteractionLoop):
            yield from (engine.geomDispatcher, engine.physDispatcher, engine.lawDispatcher)
        elif isinstance(engine, yade.wrapper.Collider):
            yield engine.boundDispatcher
        elif isinstance(engine, yade.wrapper.Dispatcher):
            yield engine
