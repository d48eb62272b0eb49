# SPDX-License-Identifier: GPL-3.0-or-later
# Made by python/make_package.py.
"""Reports as dataclasses; members have the names of the JSON reports (docs/reports.md) and their units.

A name that is a word of Python has an underscore at its end: from_.
"""
from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import Any, TypeVar

from ._errors import in_python

_T = TypeVar("_T", bound="_Report")


class _Report:
    """Base of all reports."""

    @classmethod
    def from_json(cls: type[_T], text: str) -> _T:
        """Makes a report from the JSON text that the command writes; keys that are not known are left out."""
        return _made(cls, json.loads(text))


def _made(report: type[_T], values: dict[str, Any]) -> _T:
    members = {}
    for member in fields(report):  # type: ignore[arg-type]
        key = member.name.rstrip("_")
        value = values.get(key)
        if member.name == "warnings":
            value = [in_python(line) for line in values["warnings"]]
        members[member.name] = _member(str(member.type), value)
    return report(**members)


def _member(type_name: str, value: Any) -> Any:
    if isinstance(value, list):
        inner = type_name.removesuffix(" | None").removeprefix("tuple[").removesuffix(", ...]")
        return tuple(_member(inner, item) for item in value)
    if isinstance(value, dict) and not type_name.startswith("dict["):
        return _made(globals()[type_name.removesuffix(" | None")], value)
    return value


@dataclass(frozen=True)
class ReportPalette(_Report):
    """ReportPalette of a report."""

    colour: str  # sRGB, as #rrggbb
    pixels: int  # Number of its pixels


@dataclass(frozen=True)
class ReportType(_Report):
    """ReportType of a report."""

    family: str
    style: str
    face_index: int
    axes: dict[str, Any]
    text: str | None
    glyph: int | None
    glyph_name: str | None
    character: str | None
    missing: tuple[str, ...]
    em_m: float


@dataclass(frozen=True)
class ReportInput(_Report):
    """The picture, or the type."""

    path: str  # Path of the file
    width_px: int | None  # Width in pixels
    height_px: int | None  # Height in pixels
    drawn: bool | None  # Whether the picture is an SVG
    own_size: bool | None  # Whether the page states its own size
    pixel_size_m: float | None  # Size of one pixel
    channel: str | None  # Channel that was used
    inverted: bool | None  # Whether dark or transparent pixels are liquid
    segment: str | None  # How liquid was separated from dry
    segment_confidence: float | None  # How much the picture looks like a mask, from 0 to 1
    threshold: float | None  # Coverage at which liquid begins
    level_dry: float | None  # Channel level of dry ground, from 0 to 1
    level_liquid: float | None  # Channel level of liquid, from 0 to 1
    anti_aliased: bool | None  # Whether rims have fractional coverage
    specks_dropped: int  # Number of spots and holes that were dropped
    largest_speck_px2: float | None  # Area of the largest of them
    palette: tuple[ReportPalette, ...] | None
    background: str | None
    type: ReportType | None


@dataclass(frozen=True)
class ReportLevels(_Report):
    """ReportLevels of a report."""

    path: str | None  # File; null if it is in that of the first level
    triangles: int  # Number of triangles
    vertices: int  # Number of vertices
    error_rms_m: float


@dataclass(frozen=True)
class ReportOutput(_Report):
    """The file that was written."""

    path: str  # Path of the file
    format: str  # File format
    bytes: int  # Size of the file
    vertices: int  # Number of vertices
    triangles: int  # Number of triangles
    quads: int  # Number of quadrilaterals in the file, each of two of these triangles
    base_m: float | None  # Thickness of the plate below all droplets, which makes one solid of them; null without one
    maps: tuple[str, ...]  # Paths of the maps of --maps
    map_thickness_m: float | None
    levels: tuple[ReportLevels, ...]  # Levels of detail but the first
    closed: bool  # Whether the surface is closed
    manifold: bool  # Whether the surface is a manifold
    euler: int  # Euler number V - E + F
    components: int  # Number of connected parts
    boundary_loops: int  # Number of boundary loops
    uv: str
    compression: str  # Compression of the file
    position_error_m: float | None  # Largest distance by which the compression moves a vertex; null without compression
    normal_error_deg: float | None  # Largest angle by which the compression turns a normal; null without compression


@dataclass(frozen=True)
class ReportLiquid(_Report):
    """The liquid."""

    name: str  # Name
    surface_tension_n_per_m: float  # Surface tension
    density_kg_per_m3: float  # Density
    gravity_m_per_s2: float  # Gravity
    tilt_deg: float  # Tilt of the ground
    tilt_direction_deg: float  # Direction of downhill, counter-clockwise from the picture's right
    capillary_length_m: float | None  # Capillary length
    advancing_deg: float | None  # Advancing contact angle
    receding_deg: float | None  # Receding contact angle


@dataclass(frozen=True)
class ReportGround(_Report):
    """The ground."""

    kind: str  # Kind of ground
    path: str | None  # Path of the file
    depth_m: float | None  # Height of white above black
    radius_m: float | None  # Radius
    axis_deg: float | None  # Direction of the axis


@dataclass(frozen=True)
class ReportOnto(_Report):
    """The object that the droplets were laid on."""

    path: str  # Path of the file
    droplets_laid: int
    droplets_left_out: int
    flipped_charts: int
    overlapping_charts: int
    least_scale: float
    most_scale: float


@dataclass(frozen=True)
class ReportFill(_Report):
    """Amount of liquid that was asked for."""

    by: str  # What sets the amount
    amount: float  # The value asked for
    sharing: str  # Whether each droplet gets it, or all together
    range: tuple[float, ...] | None  # Range of the slider
    limited_by: str | None  # What makes the amount smaller


@dataclass(frozen=True)
class ReportMesh(_Report):
    """Triangles of the liquid's surface."""

    vertices: int  # Number of vertices
    triangles: int  # Number of triangles
    min_angle_deg: float  # Smallest angle of a triangle
    footprint_area_m2: float  # Area of the footprint
    rim_length_m: float  # Length of all rims
    droplets: int  # The droplets
    holes: int  # Number of holes


@dataclass(frozen=True)
class ReportSolve(_Report):
    """How the equations were solved."""

    method: str  # Solver
    unknowns: int  # Number of unknowns
    iterations: int  # Iterations of the linear solver
    newton_steps: int  # Steps of Newton's method
    residual: float  # Relative residual
    converged: bool  # Whether the solver converged


@dataclass(frozen=True)
class ReportContactAngle(_Report):
    """Contact angle along the rim."""

    min: float  # Smallest
    mean: float  # Mean
    max: float  # Largest
    min_at_m: tuple[float, ...]  # Place of the smallest
    max_at_m: tuple[float, ...]  # Place of the largest


@dataclass(frozen=True)
class ReportShape(_Report):
    """Figures of all droplets together."""

    volume_m3: float  # Volume
    volume_ul: float  # Volume in microlitres
    pressure_pa: float | None  # Pressure at height 0
    height_max_m: float  # Largest thickness of the liquid
    height_bound_m: float | None  # Height of an endless puddle with this contact angle
    depth_max_m: float  # How far the surface sinks into the ground
    overhang_m: float  # How far the liquid leans out over its rim, seen from above
    dry_area_m2: float  # Area of the footprint left dry
    liquid_area_m2: float  # Area of the liquid's surface
    linear_area_m2: float  # What the linear model takes for that area
    steep_area_m2: float  # Area of the footprint under slopes over 50 degrees
    surface_energy_j: float  # Surface energy
    gravity_energy_j: float  # Energy of gravity
    energy_j: float  # Sum of both energies
    bond_number: float  # Bond number
    contact_angle_deg: ReportContactAngle  # Contact angle along the rim
    slope_max_deg: float  # Slope of the steepest triangle
    projected_width_m: float  # Width of the rim across the slope
    would_slide: bool | None  # Whether it would slide
    driving_force_n: float | None  # Weight along the slope
    retention_force_n: float | None  # Largest force that the rim holds


@dataclass(frozen=True)
class ReportDroplet(_Report):
    """ReportDroplet of a report."""

    footprint_area_m2: float  # Area of the footprint
    rim_length_m: float  # Length of all rims
    holes: int  # Number of holes
    volume_m3: float  # Volume
    volume_ul: float  # Volume in microlitres
    pressure_pa: float  # Pressure at height 0
    height_max_m: float  # Largest thickness of the liquid
    height_bound_m: float | None  # Height of an endless puddle with this contact angle
    depth_max_m: float  # How far the surface sinks into the ground
    overhang_m: float  # How far the liquid leans out over its rim, seen from above
    dry_area_m2: float  # Area of the footprint left dry
    liquid_area_m2: float  # Area of the liquid's surface
    linear_area_m2: float  # What the linear model takes for that area
    steep_area_m2: float  # Area of the footprint under slopes over 50 degrees
    surface_energy_j: float  # Surface energy
    gravity_energy_j: float  # Energy of gravity
    energy_j: float  # Sum of both energies
    bond_number: float  # Bond number
    contact_angle_deg: ReportContactAngle  # Contact angle along the rim
    slope_max_deg: float  # Slope of the steepest triangle
    projected_width_m: float  # Width of the rim across the slope
    would_slide: bool | None  # Whether it would slide
    driving_force_n: float | None  # Weight along the slope
    retention_force_n: float | None  # Largest force that the rim holds
    colour: str | None  # Colour of its region, as #rrggbb; null unless droplets are made by colour
    limited_by: str | None  # What makes the amount smaller


@dataclass(frozen=True)
class ReportTime(_Report):
    """Time."""

    read: float
    trace: float
    triangulate: float
    assemble: float
    solve: float  # How the equations were solved
    loft: float
    write: float
    total: float  # Total


@dataclass(frozen=True)
class Report(_Report):
    """Report on droplets, with the names of the command's JSON report."""

    schema: str
    version: str  # Version of the program
    model: str  # Model of the surface's area
    input: ReportInput  # The picture, or the type
    output: ReportOutput  # The file that was written
    liquid: ReportLiquid  # The liquid
    ground: ReportGround  # The ground
    no_penetration: bool  # Whether the liquid was kept above the ground
    onto: ReportOnto | None  # The object that the droplets were laid on
    fill: ReportFill  # Amount of liquid that was asked for
    mesh: ReportMesh  # Triangles of the liquid's surface
    solve: ReportSolve  # How the equations were solved
    shape: ReportShape  # Figures of all droplets together
    droplets: tuple[ReportDroplet, ...]  # The droplets
    warnings: tuple[str, ...]  # Warnings, one line each
    time_s: ReportTime  # Time
    peak_memory_bytes: int  # Largest memory of the process


@dataclass(frozen=True)
class ComparisonContactAngle(_Report):
    """Contact angle along the rim."""

    min: float  # Smallest
    mean: float  # Mean
    max: float  # Largest


@dataclass(frozen=True)
class ComparisonSurface(_Report):
    """ComparisonSurface of a report."""

    path: str  # Path of the file
    vertices: int  # Number of vertices
    triangles: int  # Number of triangles
    lowest_m: tuple[float, ...]
    highest_m: tuple[float, ...]
    area_m2: float
    volume_m3: float  # Volume
    manifold: bool  # Whether the surface is a manifold
    closed: bool  # Whether the surface is closed
    euler: int  # Euler number V - E + F
    components: int  # Number of connected parts
    boundary_loops: int  # Number of boundary loops
    contact_angle_deg: ComparisonContactAngle | None  # Contact angle along the rim


@dataclass(frozen=True)
class ComparisonDistance(_Report):
    """Hausdorff distance, between proven bounds."""

    lower_m: float  # Lower bound
    upper_m: float  # Upper bound
    at_m: tuple[float, ...]  # Point on one surface
    nearest_m: tuple[float, ...]  # Nearest point on the other
    mean_m: float  # Mean
    rms_m: float  # Root mean square


@dataclass(frozen=True)
class ComparisonNormals(_Report):
    """ComparisonNormals of a report."""

    largest_deg: float
    rms_deg: float
    at_m: tuple[float, ...]  # Point on one surface


@dataclass(frozen=True)
class ComparisonDifference(_Report):
    """ComparisonDifference of a report."""

    volume_m3: float  # Volume
    volume_share: float
    area_m2: float
    area_share: float
    contact_angle_mean_deg: float | None


@dataclass(frozen=True)
class ComparisonTolerance(_Report):
    """ComparisonTolerance of a report."""

    distance_m: float | None
    volume_share: float | None
    normals_deg: float | None


@dataclass(frozen=True)
class Comparison(_Report):
    """Difference of two surfaces."""

    schema: str
    version: str  # Version of the program
    a: ComparisonSurface
    b: ComparisonSurface
    distance: ComparisonDistance  # Hausdorff distance, between proven bounds
    distance_from_a: ComparisonDistance
    distance_from_b: ComparisonDistance
    normals: ComparisonNormals
    normals_of_a: ComparisonNormals
    normals_of_b: ComparisonNormals
    difference: ComparisonDifference
    same_topology: bool  # Whether both have the same topology
    tolerance: ComparisonTolerance
    exceeded: tuple[str, ...]  # Tolerances that are exceeded
    warnings: tuple[str, ...]  # Warnings, one line each


@dataclass(frozen=True)
class SequenceInput(_Report):
    """The picture, or the type."""

    paths: tuple[str, ...]
    width_px: int  # Width in pixels
    height_px: int  # Height in pixels
    pixel_size_m: float  # Size of one pixel


@dataclass(frozen=True)
class SequenceOutput(_Report):
    """The file that was written."""

    path: str  # Path of the file
    format: str  # File format
    bytes: int  # Size of the file
    frames_per_second: float  # Frames per second


@dataclass(frozen=True)
class SequenceLiquid(_Report):
    """The liquid."""

    name: str  # Name
    surface_tension_n_per_m: float  # Surface tension
    density_kg_per_m3: float  # Density
    gravity_m_per_s2: float  # Gravity
    tilt_deg: float  # Tilt of the ground
    tilt_direction_deg: float  # Direction of downhill, counter-clockwise from the picture's right
    capillary_length_m: float  # Capillary length
    advancing_deg: float | None  # Advancing contact angle
    receding_deg: float | None  # Receding contact angle


@dataclass(frozen=True)
class SequenceGround(_Report):
    """The ground."""

    kind: str  # Kind of ground
    path: str | None  # Path of the file
    depth_m: float | None  # Height of white above black
    radius_m: float | None  # Radius
    axis_deg: float | None  # Direction of the axis


@dataclass(frozen=True)
class SequenceFill(_Report):
    """Amount of liquid that was asked for."""

    by: str  # What sets the amount
    amount: float  # The value asked for
    sharing: str  # Whether each droplet gets it, or all together
    range: tuple[float, ...] | None  # Range of the slider


@dataclass(frozen=True)
class SequenceTransitions(_Report):
    """SequenceTransitions of a report."""

    count: int
    vertices_kept: int
    vertices_kept_share: float  # Share of the vertices that stay in place


@dataclass(frozen=True)
class SequenceContactAngle(_Report):
    """Contact angle along the rim."""

    min: float  # Smallest
    mean: float  # Mean
    max: float  # Largest
    min_at_m: tuple[float, ...]  # Place of the smallest
    max_at_m: tuple[float, ...]  # Place of the largest


@dataclass(frozen=True)
class SequenceFalling(_Report):
    """SequenceFalling of a report."""

    from_: int  # Identity of the droplet that it left
    volume_m3: float  # Volume
    middle_m: tuple[float, ...]  # Middle of the drop
    since_s: float  # Time since it left


@dataclass(frozen=True)
class SequenceDroplet(_Report):
    """SequenceDroplet of a report."""

    id: int  # Identity of the droplet
    from_: tuple[int, ...]  # Identities of the droplets before
    footprint_area_m2: float  # Area of the footprint
    rim_length_m: float  # Length of all rims
    holes: int  # Number of holes
    volume_m3: float  # Volume
    volume_ul: float  # Volume in microlitres
    pressure_pa: float  # Pressure at height 0
    height_max_m: float  # Largest thickness of the liquid
    height_bound_m: float  # Height of an endless puddle with this contact angle
    depth_max_m: float  # How far the surface sinks into the ground
    overhang_m: float  # How far the liquid leans out over its rim, seen from above
    dry_area_m2: float  # Area of the footprint left dry
    liquid_area_m2: float  # Area of the liquid's surface
    linear_area_m2: float  # What the linear model takes for that area
    steep_area_m2: float  # Area of the footprint under slopes over 50 degrees
    surface_energy_j: float  # Surface energy
    gravity_energy_j: float  # Energy of gravity
    energy_j: float  # Sum of both energies
    bond_number: float  # Bond number
    contact_angle_deg: SequenceContactAngle  # Contact angle along the rim
    slope_max_deg: float  # Slope of the steepest triangle
    projected_width_m: float  # Width of the rim across the slope
    would_slide: bool | None  # Whether it would slide
    driving_force_n: float | None  # Weight along the slope
    retention_force_n: float | None  # Largest force that the rim holds


@dataclass(frozen=True)
class SequenceFrame(_Report):
    """SequenceFrame of a report."""

    input: str  # The picture, or the type
    output: str | None  # The file that was written
    continues: bool  # Whether vertices continue from the frame before
    held: bool  # Whether the droplets are those of the frame before, since the footprint has none
    vertices_kept_share: float | None  # Share of the vertices that stay in place
    volume_gained_m3: float  # Volume that came
    volume_lost_m3: float  # Volume that went
    vertices: int  # Number of vertices
    triangles: int  # Number of triangles
    closed: bool  # Whether the surface is closed
    footprint_area_m2: float  # Area of the footprint
    rim_length_m: float  # Length of all rims
    holes: int  # Number of holes
    volume_m3: float  # Volume
    volume_ul: float  # Volume in microlitres
    pressure_pa: float  # Pressure at height 0
    height_max_m: float  # Largest thickness of the liquid
    height_bound_m: float  # Height of an endless puddle with this contact angle
    depth_max_m: float  # How far the surface sinks into the ground
    overhang_m: float  # How far the liquid leans out over its rim, seen from above
    dry_area_m2: float  # Area of the footprint left dry
    liquid_area_m2: float  # Area of the liquid's surface
    linear_area_m2: float  # What the linear model takes for that area
    steep_area_m2: float  # Area of the footprint under slopes over 50 degrees
    surface_energy_j: float  # Surface energy
    gravity_energy_j: float  # Energy of gravity
    energy_j: float  # Sum of both energies
    bond_number: float  # Bond number
    contact_angle_deg: SequenceContactAngle  # Contact angle along the rim
    slope_max_deg: float  # Slope of the steepest triangle
    projected_width_m: float  # Width of the rim across the slope
    would_slide: bool | None  # Whether it would slide
    driving_force_n: float | None  # Weight along the slope
    retention_force_n: float | None  # Largest force that the rim holds
    falling: tuple[SequenceFalling, ...]  # Drops on their way from a ceiling
    droplets: tuple[SequenceDroplet, ...]  # The droplets


@dataclass(frozen=True)
class SequenceTime(_Report):
    """Time."""

    total: float  # Total


@dataclass(frozen=True)
class SequenceReport(_Report):
    """Report on droplets whose footprints move."""

    schema: str
    version: str  # Version of the program
    model: str  # Model of the surface's area
    input: SequenceInput  # The picture, or the type
    output: SequenceOutput  # The file that was written
    liquid: SequenceLiquid  # The liquid
    ground: SequenceGround  # The ground
    no_penetration: bool  # Whether the liquid was kept above the ground
    fill: SequenceFill  # Amount of liquid that was asked for
    volume_mode: str  # Which volume stays the same
    transitions: SequenceTransitions
    frames: tuple[SequenceFrame, ...]  # The frames
    warnings: tuple[str, ...]  # Warnings, one line each
    time_s: SequenceTime  # Time
    peak_memory_bytes: int  # Largest memory of the process


@dataclass(frozen=True)
class WindTunnelLiquid(_Report):
    """The liquid."""

    name: str  # Name
    surface_tension_n_per_m: float  # Surface tension
    density_kg_per_m3: float  # Density


@dataclass(frozen=True)
class WindTunnelAir(_Report):
    """WindTunnelAir of a report."""

    density_kg_per_m3: float  # Density
    drag_coefficient: float
    boundary_layer_m: float
    profile_exponent: float


@dataclass(frozen=True)
class WindTunnelWetting(_Report):
    """WindTunnelWetting of a report."""

    contact_angle_deg: float  # Contact angle along the rim
    falling_angle_deg: float | None
    falling_volume_m3: float | None
    kinetic_fraction: float
    viscosity_factor_pa_s: float


@dataclass(frozen=True)
class WindTunnelDistance(_Report):
    """WindTunnelDistance of a report."""

    lower_share: float | None
    upper_share: float | None


@dataclass(frozen=True)
class WindTunnelCase(_Report):
    """WindTunnelCase of a report."""

    hysteresis: float  # Cosine of the receding minus cosine of the advancing contact angle
    slope_deg: float
    volume_m3: float  # Volume
    contact_radius_m: float
    height_m: float
    frontal_area_m2: float
    mass_kg: float
    weight_along_slope_n: float
    retention_n: float
    sliding_friction_n: float
    drag_per_wind_squared_n_s2_per_m2: float
    viscous_n_s_per_m: float
    lower_threshold_m_per_s: float
    upper_threshold_m_per_s: float
    threshold_ratio: float
    distance_from_measured: WindTunnelDistance
    critical_volume_m3: float | None
    critical_radius_m: float | None
    shedding_wind_m_per_s: float
    drag_n: tuple[float, ...]
    acceleration_m_per_s2: tuple[float, ...]
    terminal_velocity_m_per_s: tuple[float, ...]
    regime: tuple[str, ...]


@dataclass(frozen=True)
class WindTunnelRun(_Report):
    """WindTunnelRun of a report."""

    preset: str  # Named set of default values
    liquid: WindTunnelLiquid  # The liquid
    gravity_m_per_s2: float  # Gravity
    air: WindTunnelAir
    wetting: WindTunnelWetting
    measured_still_m_per_s: tuple[float, ...] | None
    wind_m_per_s: tuple[float, ...]
    cases: tuple[WindTunnelCase, ...]


@dataclass(frozen=True)
class WindTunnelReport(_Report):
    """Droplets in the wind tunnel."""

    schema: str
    version: str  # Version of the program
    runs: tuple[WindTunnelRun, ...]


@dataclass(frozen=True)
class WindshieldOutput(_Report):
    """The file that was written."""

    path: str  # Path of the file
    frames: int  # The frames
    frames_per_second: float  # Frames per second
    warm_up_s: float
    step_s: float
    map_thickness_m: float | None  # Thickness that is white in maps, null without PNG maps


@dataclass(frozen=True)
class WindshieldGlass(_Report):
    """The glass."""

    surface: str | None
    width_m: float
    height_m: float
    radius_m: float  # Radius
    slope_deg: float


@dataclass(frozen=True)
class WindshieldVehicle(_Report):
    """The car."""

    drive_cycle: str | None
    speed_at_start_m_per_s: float
    wind: str


@dataclass(frozen=True)
class WindshieldRain(_Report):
    """The rain."""

    rainfall_m_per_s: float
    rainfall_mm_per_h: float
    still_diameter_m: float
    splashes: bool  # Whether rings are shown where large raindrops hit
    seed: int  # Random seed


@dataclass(frozen=True)
class WindshieldForces(_Report):
    """Parameters of the forces."""

    liquid: str  # The liquid
    surface_tension_n_per_m: float  # Surface tension
    density_kg_per_m3: float  # Density
    gravity_m_per_s2: float  # Gravity
    contact_angle_deg: float  # Contact angle along the rim
    hysteresis: float  # Cosine of the receding minus cosine of the advancing contact angle
    falling_angle_deg: float | None
    kinetic_fraction: float
    viscosity_factor_pa_s: float
    air_density_kg_per_m3: float
    drag_coefficient: float
    boundary_layer_m: float
    profile_exponent: float


@dataclass(frozen=True)
class WindshieldFluctuation(_Report):
    """WindshieldFluctuation of a report."""

    acceleration_m_per_s2: float
    interval_s: float


@dataclass(frozen=True)
class WindshieldStreaks(_Report):
    """WindshieldStreaks of a report."""

    film_m: float
    spacing_m: float


@dataclass(frozen=True)
class WindshieldWipers(_Report):
    """Wipers."""

    count: int
    period_s: float | None


@dataclass(frozen=True)
class WindshieldView(_Report):
    """The view."""

    background: str | None
    environment: str | None
    width_px: int  # Width in pixels
    height_px: int  # Height in pixels
    field_of_view_deg: float
    eye_distance_m: float
    eye_m: tuple[float, ...] | None
    look_at_m: tuple[float, ...] | None
    ior: float
    background_blur_deg: float
    shutter_open_s: float
    exposure: float
    highlight_boost: float | None


@dataclass(frozen=True)
class WindshieldBalance(_Report):
    """WindshieldBalance of a report."""

    time_s: float  # Time
    speed_m_per_s: float
    rained_m3: float
    on_glass_still_m3: float
    on_glass_film_m3: float
    on_glass_running_m3: float
    left_m3: float
    wiped_m3: float
    merged_m3: float
    swept_m3: float
    shed_m3: float
    residual: float  # Relative residual
    still_droplets: int
    running_droplets: int
    moving_droplets: int


@dataclass(frozen=True)
class WindshieldCounts(_Report):
    """Event counters since the start."""

    raindrops: int
    merged: int
    swept: int
    grown: int
    torn: int
    left: int
    wiped: int


@dataclass(frozen=True)
class WindshieldTime(_Report):
    """Time."""

    total: float  # Total


@dataclass(frozen=True)
class WindshieldReport(_Report):
    """Report on rain on a windshield."""

    schema: str
    version: str  # Version of the program
    preset: str  # Named set of default values
    output: WindshieldOutput  # The file that was written
    glass: WindshieldGlass  # The glass
    vehicle: WindshieldVehicle  # The car
    rain: WindshieldRain  # The rain
    forces: WindshieldForces  # Parameters of the forces
    fluctuation: WindshieldFluctuation
    streaks: WindshieldStreaks
    runoff_s: float  # Time after which the film of heavy rain breaks up without more rain; 0: there is none
    wipers: WindshieldWipers  # Wipers
    view: WindshieldView  # The view
    balance: tuple[WindshieldBalance, ...]  # Balance of the water
    largest_residual: float
    counts: WindshieldCounts  # Event counters since the start
    warnings: tuple[str, ...]  # Warnings, one line each
    time_s: WindshieldTime  # Time
    peak_memory_bytes: int  # Largest memory of the process


@dataclass(frozen=True)
class FlowInput(_Report):
    """The object."""

    path: str  # Path of the object, or `preset` and its name
    triangles: int  # Triangles of its mesh
    without_area: int  # Triangles that were left out: too thin to have a normal
    duplicates: int  # Triangles that were left out: another has the same corners
    turned: int  # Triangles that were turned over to face as their neighbours do
    boundary_edges: int  # Edges with one triangle: droplets fall off there
    parts: int  # Parts that are connected over edges
    size_m: tuple[float, ...]  # Edges of the box around the object
    start: str | None  # Path of the table of droplets at the start


@dataclass(frozen=True)
class FlowOutput(_Report):
    """The file that was written."""

    path: str  # Path of the file
    frames: int  # The frames
    frames_per_second: float  # Frames per second
    time_s: float  # Simulated time
    map_thickness_m: float | None  # Thickness that is white in maps, null without PNG maps
    map_age_s: float | None  # Age that is white in maps, null without PNG maps


@dataclass(frozen=True)
class FlowModel(_Report):
    """Models."""

    motion: str  # What holds droplets
    shape: str  # Model of the shape of droplets
    deformation: float  # Largest small-scale deformation of droplets
    merges: bool  # Droplets that touch become one
    wets: bool  # Streaks smooth the surface
    step_s: float  # Time step of merging, arriving and drying
    small_volume_m3: float  # Droplets from drying and beads of less vanish
    seed: int  # Random seed


@dataclass(frozen=True)
class FlowForces(_Report):
    """Forces."""

    liquid: str  # Name of the liquid
    surface_tension_n_per_m: float  # Surface tension
    density_kg_per_m3: float  # Density
    gravity_m_per_s2: tuple[float, ...]  # Gravity in the world
    contact_angle_deg: float  # Contact angle
    hysteresis: float  # Contact angle hysteresis
    falling_angle_deg: float | None  # Slope at which droplets of every volume begin to run
    kinetic_fraction: float
    viscosity_factor_pa_s: float
    air_density_kg_per_m3: float
    drag_coefficient: float
    boundary_layer_m: float
    profile_exponent: float
    wind_m_per_s: tuple[float, ...]  # Wind in the world
    friction_kg_per_s: float | None  # Viscous friction; null: by the viscosity factor
    adhesion_pa: float | None  # Adhesion; null: by surface tension
    roughness_m: float  # Height of the surface's bumps
    pinning: float  # Standard deviation of the logarithm of the hysteresis over the surface
    pinning_length_m: float  # Length over which the hysteresis varies


@dataclass(frozen=True)
class FlowStreaks(_Report):
    """Streaks."""

    film_m: float  # Thickness of the film behind droplets
    spacing_m: float  # Mean distance of beads
    drying_s: float | None  # Time after which streaks and beads are dry; null: never


@dataclass(frozen=True)
class FlowObject(_Report):
    """Motion of the object."""

    spin_rad_per_s: tuple[float, ...]  # Angular velocity
    pivot_m: tuple[float, ...]  # Point about which it turns
    keys: int  # Number of keys of its motion


@dataclass(frozen=True)
class FlowVolume(_Report):
    """FlowVolume of a report."""

    median_m3: float  # Median volume
    spread: float  # Standard deviation of the volumes' logarithm


@dataclass(frozen=True)
class FlowEmitter(_Report):
    """FlowEmitter of a report."""

    place_m: tuple[float, ...]  # Place in the frame of the object
    rate_m3_per_s: float  # Rate
    volume: FlowVolume


@dataclass(frozen=True)
class FlowRain(_Report):
    """Rain."""

    rainfall_m_per_s: float
    rainfall_mm_per_h: float
    from_: tuple[float, ...]  # Direction that the raindrops come from
    small_diameter_m: float  # Smaller raindrops are left out
    small_share: float | None  # Share of the rainfall that they have; null without rain


@dataclass(frozen=True)
class FlowCondensation(_Report):
    """Dew."""

    rate_m_per_s: float  # Growth of the mean thickness of the water
    spacing_m: float  # Mean distance of new droplets on a dry surface


@dataclass(frozen=True)
class FlowSources(_Report):
    """Sources of droplets."""

    emitters: tuple[FlowEmitter, ...]  # Emitters
    rain: FlowRain | None  # Rain
    condensation: FlowCondensation | None  # Dew


@dataclass(frozen=True)
class FlowBalance(_Report):
    """FlowBalance of a report."""

    time_s: float  # Time
    released_m3: float  # Liquid of all sources
    running_m3: float
    still_m3: float
    airborne_m3: float
    streaks_m3: float
    left_m3: float  # Liquid that fell away
    dried_m3: float  # Liquid that evaporated
    residual: float  # Released liquid minus all other, over the released
    running_droplets: int
    still_droplets: int
    airborne_droplets: int


@dataclass(frozen=True)
class FlowCounts(_Report):
    """Event counters since the start."""

    released: int  # Droplets that sources made
    crossings: int  # Edges that droplets crossed
    launches: int  # Droplets that left the surface into the air
    landings: int  # Droplets that met the surface again
    merged: int  # Droplets that others absorbed
    beads: int  # Beads that streaks broke up into
    left: int  # Droplets that fell away
    dried: int  # Droplets that dried up
    stuck: int  # Droplets that were stopped, as they met events without end at one time
    overflows: int  # Times that liquid ran over the brim of a hollow
    raindrops: int  # Of the released droplets, raindrops
    raindrops_behind: int  # Raindrops that met the back of an open sheet; they are lost
    raindrops_behind_m3: float  # Volume of these, which is not in the balance
    raindrops_small: int  # Expected number of raindrops smaller than small_diameter_m, which are left out


@dataclass(frozen=True)
class FlowTime(_Report):
    """Run time."""

    total: float  # Run time


@dataclass(frozen=True)
class FlowReport(_Report):
    """Report on droplets that run over a mesh."""

    schema: str
    version: str  # Version of the program
    preset: str | None  # Named set of default values
    input: FlowInput  # The object
    output: FlowOutput  # The file that was written
    model: FlowModel  # Models
    forces: FlowForces  # Forces
    streaks: FlowStreaks  # Streaks
    object: FlowObject  # Motion of the object
    sources: FlowSources  # Sources of droplets
    balance: tuple[FlowBalance, ...]  # Liquid since the start, every second
    largest_residual: float  # Largest residual of the balance
    counts: FlowCounts  # Event counters since the start
    warnings: tuple[str, ...]  # Warnings
    time_s: FlowTime  # Run time
    peak_memory_bytes: int  # Largest memory


@dataclass(frozen=True)
class DewInput(_Report):
    """The object."""

    path: str  # Path of the object, or `preset` and its name
    triangles: int  # Triangles of its mesh
    without_area: int  # Triangles that were left out: too thin to have a normal
    duplicates: int  # Triangles that were left out: another has the same corners
    turned: int  # Triangles that were turned over to face as their neighbours do
    boundary_edges: int  # Edges with one triangle: droplets fall off there
    parts: int  # Parts that are connected over edges
    size_m: tuple[float, ...]  # Edges of the box around the object


@dataclass(frozen=True)
class DewOutput(_Report):
    """The file."""

    path: str  # Path
    instancing: str | None


@dataclass(frozen=True)
class DewSizes(_Report):
    """What was asked for."""

    distribution: str  # Numbers of droplets by radius
    coverage: float  # Share of the surface below droplets
    smallest_m: float  # Radius of the smallest droplets seen from above
    largest_m: float  # Radius of the largest droplets, before some join
    median_m: float | None  # Median of the radii; null for condensation
    spread: float | None  # Standard deviation of their logarithm; null for condensation
    from_: tuple[float, ...] | None  # Direction that rain comes from
    seed: int  # Random seed


@dataclass(frozen=True)
class DewForces(_Report):
    """Forces."""

    liquid: str  # Name of the liquid
    surface_tension_n_per_m: float  # Surface tension
    density_kg_per_m3: float  # Density
    gravity_m_per_s2: tuple[float, ...]  # Gravity in the world
    contact_angle_deg: float  # Contact angle
    hysteresis: float  # Contact angle hysteresis
    falling_angle_deg: float | None  # Slope at which droplets of every volume begin to run
    kinetic_fraction: float
    viscosity_factor_pa_s: float
    air_density_kg_per_m3: float
    drag_coefficient: float
    boundary_layer_m: float
    profile_exponent: float


@dataclass(frozen=True)
class DewDroplet(_Report):
    """What there is."""

    count: int  # Number of droplets
    volume_m3: float  # Volume of all droplets
    area_m2: float  # Area where droplets may be
    covered_m2: float  # Area below droplets
    smallest_m: float  # Radius of the smallest droplet seen from above, without gravity
    largest_m: float  # Radius of the largest droplet seen from above, without gravity
    joined: int  # Droplets that found no room and joined others
    run_off: int  # Droplets that no slope holds
    between_edges: int  # Droplets that find no place clear of the object's edges
    left_out: int  # Droplets below which the object bends too much


@dataclass(frozen=True)
class DewTime(_Report):
    """Run time."""

    total: float  # Run time


@dataclass(frozen=True)
class DewReport(_Report):
    """Report on droplets that rest on an object."""

    schema: str
    version: str  # Version of the program
    preset: str  # Kind of wetness
    input: DewInput  # The object
    output: DewOutput  # The file
    sizes: DewSizes  # What was asked for
    forces: DewForces  # Forces
    droplets: DewDroplet  # What there is
    warnings: tuple[str, ...]  # Warnings
    time_s: DewTime  # Run time
    peak_memory_bytes: int  # Largest memory
