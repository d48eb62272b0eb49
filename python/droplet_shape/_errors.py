# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions of the package."""
from __future__ import annotations

import errno
import os
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


class InputNotFound(InvalidInput, FileNotFoundError):
    """A file that is to be read does not exist."""

    errno = errno.ENOENT


class _OptionNotFound(InvalidArgument, FileNotFoundError):
    """A file that an option names does not exist."""

    errno = errno.ENOENT


class OutputFailed(Error, OSError):
    """A file cannot be written completely."""

    code = "OutputFailed"


class NoSuchDroplet(Error, ValueError):
    """The requested droplet does not exist, or the solver failed."""

    code = "NoSuchDroplet"


_CLASSES = {kind.code: kind for kind in (InvalidArgument, InvalidInput, OutputFailed, NoSuchDroplet)}

_NOT_FOUND = {"InvalidInput": InputNotFound, "InvalidArgument": _OptionNotFound}


def in_python(message: str) -> str:
    """A message with the names that options have in Python: contact_angle for --contact-angle."""
    return re.sub(r"(?<![\w-])--([a-z][a-z-]*)", lambda match: match.group(1).replace("-", "_"), message)


_TOO_LARGE_ANGLE = re.compile(r"'(-?[\d.e+-]+)rad' must be ")


def made(code: str, message: str) -> Error:
    """The exception for an error of the library."""
    message = in_python(message)
    if code in _NOT_FOUND and message.endswith(os.strerror(errno.ENOENT)):
        return _NOT_FOUND[code](message)
    angle = _TOO_LARGE_ANGLE.search(message)
    if angle:
        message += f"; a number is in radians: write '{float(angle.group(1)):g}deg'"
    return _CLASSES[code](message)
