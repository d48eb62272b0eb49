# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions of the package."""
from __future__ import annotations

import re


class Error(Exception):
    """Base of all errors of the package; the message is one line that names argument, value and what is allowed."""

    #: Kind of the error: the name of its class.
    code: str = "Error"


class InvalidArgument(Error, ValueError):
    """An argument is outside of its range."""

    code = "InvalidArgument"


class InvalidInput(Error, ValueError):
    """The mask, font or file cannot be read, or has no liquid."""

    code = "InvalidInput"


class OutputFailed(Error, OSError):
    """A file cannot be written completely."""

    code = "OutputFailed"


class NoSuchDroplet(Error, ValueError):
    """The requested droplet does not exist, or the solver failed."""

    code = "NoSuchDroplet"


_CLASSES = {kind.code: kind for kind in (InvalidArgument, InvalidInput, OutputFailed, NoSuchDroplet)}


def in_python(message: str) -> str:
    """A message with the names that options have in Python: contact_angle for --contact-angle."""
    return re.sub(r"(?<![\w-])--([a-z][a-z-]*)", lambda match: match.group(1).replace("-", "_"), message)


def made(code: str, message: str) -> Error:
    """The exception for an error of the library."""
    return _CLASSES[code](in_python(message))
