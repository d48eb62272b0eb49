# SPDX-License-Identifier: GPL-3.0-or-later
"""A droplet in a notebook that can be turned: `DropletWidget`. It needs the package anywidget."""
from pathlib import Path
from typing import Any, Dict, Union

try:
    import anywidget
    import traitlets
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"droplet_shape.widget needs the package anywidget, for {error.name} is missing: pip install anywidget", name=error.name
    ) from error

from ._core import Animation, Droplet, Surface

__all__ = ["DropletWidget"]

_SCRIPT = Path(__file__).with_name("widget.js")


def _shown(droplet: Union[Droplet, Surface, Animation, bytes]) -> Dict[str, Any]:
    """The traits that tell what is shown. Only reports know of the ground and the mask."""
    if isinstance(droplet, bytes):
        return {"glb": droplet}
    traits: Dict[str, Any] = {"glb": droplet.to_bytes("glb")}
    if isinstance(droplet, Droplet):
        report = droplet.report
        traits["flat"] = report.onto is None and report.ground.kind == "flat"
        sides = (report.input.width_px, report.input.height_px)
        pixel = report.input.pixel_size_m
        traits["sides"] = [side * pixel for side in sides] if pixel and all(sides) else None
    return traits


class DropletWidget(anywidget.AnyWidget):
    """A droplet in 3D, in a notebook.

        widget = DropletWidget(drop, view={"elevation": 30})
        widget                   # the last line of a cell shows it
        widget.show(other_drop)  # from the same side

    The user turns it by the mouse, by fingers or by the keys of arrows, plus, minus and Home. It is shown as the page of the
    command's option html shows it. All traits can be set, observed, and linked with other widgets.

    Traits:
      glb: the bytes of the GLB file that is shown
      view: where the camera is, a dict. azimuth [degrees]: from the front to the right. elevation [degrees]: above the ground.
          distance [m], from target. target [m]: a point x, y, z, in the middle of the picture. Keys that are not there leave
          it as it is; {} shows the whole droplet from the front. When the user turns the droplet, it gets all keys
      fill: the amount that is shown, in multiples of the droplet's own, for droplets that were made with fill_range
      time [s]: the moment that is shown of an animation
      ground: what is under the droplet: "paper", "studio", "sky", "leaf", "clay", "rose" or "white"
      height: of the picture [CSS pixels]
      flat: whether the ground is flat, at height 0
      sides: width and height of the mask [m], where the ground has a picture of it; None: not known
    """

    _esm = _SCRIPT

    glb = traitlets.Bytes().tag(sync=True)
    view = traitlets.Dict().tag(sync=True)
    fill = traitlets.Float(1.0, min=0.0).tag(sync=True)
    time = traitlets.Float(0.0, min=0.0).tag(sync=True)
    ground = traitlets.Enum(["paper", "studio", "sky", "leaf", "clay", "rose", "white"], "paper").tag(sync=True)
    height = traitlets.Int(360, min=1).tag(sync=True)
    flat = traitlets.Bool(True).tag(sync=True)
    sides = traitlets.List(traitlets.Float(), allow_none=True, default_value=None).tag(sync=True)

    def __init__(self, droplet: Union[Droplet, Surface, Animation, bytes], **traits: Any) -> None:
        """
        droplet: what is shown: a droplet, a surface, an animation, or the bytes of a GLB file
        traits: values of other traits, such as view or ground
        """
        if not _SCRIPT.exists():
            raise RuntimeError("this droplet_shape was built without its widget; build it with the environment variable DROPLET_PAGE=ON")
        super().__init__(**{**_shown(droplet), **traits})

    def show(self, droplet: Union[Droplet, Surface, Animation, bytes]) -> None:
        """Shows something else from where the camera is; the arguments are the constructor's."""
        with self.hold_sync():
            for name, value in _shown(droplet).items():
                setattr(self, name, value)
