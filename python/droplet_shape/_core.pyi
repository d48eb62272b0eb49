# SPDX-License-Identifier: GPL-3.0-or-later
import os
from collections.abc import Iterable, Iterator
from typing import Any, Literal, Optional, Protocol, Union

import numpy
from numpy.typing import NDArray

from ._reports import Report, SequenceReport

_Path = Union[str, os.PathLike[str]]
_Format = Literal["glb", "gltf", "obj", "ply", "stl", "usda", "usdz", "3mf"]
_FilmFormat = Literal["glb", "gltf", "usda", "usdz"]
_Material = Literal["water", "ink", "mercury", "honey", "plain"]
_Unit = Literal["m", "cm", "mm"]
_Compress = Literal["none", "quantize", "meshopt"]
_Nodes = Literal["one", "each"]

class _File(Protocol):
    def write(self, data: bytes, /) -> object: ...

version: str

class Surface:
    @property
    def vertices(self) -> NDArray[numpy.float64]: ...
    @property
    def triangles(self) -> NDArray[numpy.uint32]: ...
    @property
    def normals(self) -> NDArray[numpy.float64]: ...
    @property
    def uv(self) -> NDArray[numpy.float64]: ...
    @property
    def contact_angle(self) -> NDArray[numpy.float32]: ...
    @property
    def weld(self) -> NDArray[numpy.uint32]: ...
    @property
    def warnings(self) -> tuple[str, ...]: ...
    def save(
        self,
        path: Union[_Path, _File],
        *,
        format: Optional[_Format] = None,
        material: Optional[_Material] = None,
        unit: _Unit = "mm",
        compress: _Compress = "none",
        no_clobber: bool = False,
    ) -> None: ...
    def to_bytes(
        self,
        format: _Format = "glb",
        *,
        material: Optional[_Material] = None,
        unit: _Unit = "mm",
        compress: _Compress = "none",
    ) -> bytes: ...
    def _repr_png_(self) -> Optional[bytes]: ...

class Droplet(Surface):
    @property
    def report(self) -> Report: ...
    def save(
        self,
        path: Union[_Path, _File],
        *,
        format: Optional[_Format] = None,
        material: Optional[_Material] = None,
        unit: _Unit = "mm",
        compress: _Compress = "none",
        nodes: _Nodes = "one",
        materials: Optional[_Path] = None,
        no_clobber: bool = False,
    ) -> None: ...
    def to_bytes(
        self,
        format: _Format = "glb",
        *,
        material: Optional[_Material] = None,
        unit: _Unit = "mm",
        compress: _Compress = "none",
        nodes: _Nodes = "one",
        materials: Optional[_Path] = None,
    ) -> bytes: ...

class Animation:
    @property
    def report(self) -> SequenceReport: ...
    @property
    def warnings(self) -> tuple[str, ...]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Surface: ...
    def __iter__(self) -> Iterator[Surface]: ...
    def save(
        self,
        path: Union[_Path, _File],
        *,
        material: Optional[_Material] = None,
        no_clobber: bool = False,
        format: Optional[_FilmFormat] = None,
        compress: _Compress = "none",
    ) -> None: ...
    def to_bytes(
        self,
        format: _FilmFormat = "glb",
        *,
        material: Optional[_Material] = None,
        compress: _Compress = "none",
    ) -> bytes: ...

class Mask:
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def channel(self) -> Literal["alpha", "luma"]: ...
    @property
    def inverted(self) -> bool: ...
    @property
    def segment(self) -> Literal["threshold", "adaptive", "grabcut"]: ...
    @property
    def segment_confidence(self) -> float: ...
    @property
    def physical_width(self) -> Optional[float]: ...
    def _repr_png_(self) -> bytes: ...

def read_mask(path: _Path, arguments: list[str]) -> Mask: ...
def make_droplet(mask: Union[Mask, NDArray[Any]], arguments: list[str]) -> Droplet: ...
def glyphs(font: _Path, text: str, arguments: list[str]) -> Droplet: ...
def animate(frames: Iterable[Union[Mask, NDArray[Any]]], arguments: list[str]) -> Animation: ...
def compare(a: Union[Surface, _Path], b: Union[Surface, _Path], arguments: list[str]) -> str: ...
def wind_tunnel(arguments: list[str]) -> str: ...
def windshield(output: _Path, arguments: list[str]) -> str: ...
def flow(object: Optional[_Path], output: _Path, arguments: list[str]) -> str: ...
def dew(object: _Path, output: _Path, arguments: list[str]) -> str: ...
