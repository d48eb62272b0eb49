# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns arguments in Python into those of the command, which has the rules for their values."""
from __future__ import annotations

import math
import numbers
import os
from collections.abc import Iterator, Mapping
from typing import Any

import numpy

from ._core import Mask
from ._errors import InvalidArgument


def mask_of(mask: Any) -> Any:
    """A mask or an array, of anything that is one of them or can be turned into an array."""
    if isinstance(mask, (str, bytes, os.PathLike)):
        raise InvalidArgument(
            f"mask: {os.fspath(mask)!r} is a path, must be an array; read_mask() reads a picture, and other packages "
            "read one with its colours, for by_colour"
        )
    return mask if isinstance(mask, Mask) else numpy.asarray(mask)


def masks_of(frames: Any) -> Iterator[Any]:
    """A mask or an array of each frame."""
    if isinstance(frames, (str, bytes, os.PathLike)):
        raise InvalidArgument(f"frames: {os.fspath(frames)!r} is a path, must be masks; read_mask() reads one picture")
    return map(mask_of, frames)


def arguments_of(kinds: Mapping[str, str], values: Mapping[str, Any]) -> list[str]:
    """Arguments such as --width=20mm.

    kinds: how the value of each option is written: a unit of numbers, or another word that _text() knows.
    values: values by name; None and False are left out, and so are names that kinds lacks.
    """
    arguments = []
    for name, kind in kinds.items():
        value = values[name]
        if value is None:
            continue
        option = "--" + name.rstrip("_").replace("_", "-")
        if kind == "flag":
            if not isinstance(value, (bool, numpy.bool_)):
                raise _error(name, value, "True or False")
            if value:
                arguments.append(option)
        elif kind == "axes":
            if not isinstance(value, Mapping):
                raise _error(name, value, 'a dict of tags and values, such as {"wght": 700}')
            arguments += [f"{option}={tag}={_number(name, number)}" for tag, number in value.items()]
        elif kind == "texts":
            texts = [value] if isinstance(value, str) else value
            arguments += [f"{option}={_given(name, text)}" for text in texts]
        else:
            arguments.append(f"{option}={_text(name, value, kind)}")
    return arguments


def _text(name: str, value: Any, kind: str) -> str:
    if isinstance(value, str):
        return _given(name, value)
    if kind == "path":
        return _given(name, os.fspath(value))
    if kind == "text":
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        raise _error(name, value, "a text")
    if kind == "range":
        return "..".join(_number(name, number) for number in _items(name, value, 2))
    if kind == "size":
        return "x".join(_number(name, number) for number in _items(name, value, 2))
    if kind == "vector":
        return ",".join(_number(name, number) for number in _items(name, value, 3))
    if kind.startswith("band "):
        low, high = (_quantity(name, number, kind[5:]) for number in _items(name, value, 2))
        return f"{low}..{high}"
    if kind.startswith("list "):
        items = [value] if isinstance(value, numbers.Real) else list(value)
        if not items:
            raise _error(name, value, "at least one value")
        return ",".join(_text(name, item, kind[5:]) for item in items)
    return _quantity(name, value, kind)


def _given(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise _error(name, value, "a text")
    if not value or "\0" in value:
        raise _error(name, value, "a text that is not empty")
    return value


def _items(name: str, value: Any, count: int) -> list[Any]:
    items = list(value) if hasattr(value, "__iter__") else []
    if len(items) != count:
        raise _error(name, value, f"{count} numbers")
    return items


def _number(name: str, value: Any) -> str:
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Real):
        raise _error(name, value, "a number")
    if not math.isfinite(value):
        raise _error(name, value, "a finite number")
    return repr(int(value)) if isinstance(value, numbers.Integral) else repr(float(value))


def _quantity(name: str, value: Any, unit: str) -> str:
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Real):
        raise _error(name, value, "a number or a text")
    if unit == "rainfall":  # the command has no unit of rainfall that is an SI unit
        return _number(name, float(value) * 3.6e6) + "mm/h"
    if unit == "share":
        return _number(name, float(value) * 100.0) + "%"
    if unit == "rad/s":
        return _number(name, value) + "rad/s"
    return _number(name, value) + ("" if unit == "number" else unit)


def _error(name: str, value: Any, allowed: str) -> InvalidArgument:
    return InvalidArgument(f"{name}: {value!r} must be {allowed}")
