# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Mesh > Droplet: the operators and the menu."""

import math
import os
import shlex

import bpy
from bpy.props import (
    BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, StringProperty,
)
from bpy_extras.object_utils import AddObjectHelper, add_object_align_init
from mathutils import Matrix, Vector

from . import command, footprints, glb, materials, meshes, options as known, places
from .command import DropletError
from .preferences import preferences


_MODELS = {
    "auto": ("Automatic", "The linear model where the liquid is flat enough for it, otherwise the exact one"),
    "linear": ("Linear", "Fast; too high where the liquid is steep"),
    "exact": ("Exact", "Right for all slopes"),
}


_KINDS_OF_DEW = {"dew": "Dew", "rain": "Fresh Rain", "bottle": "Cold Bottle", "shower": "After a Shower", "mist": "Mist"}


class Maker:
    """An operator whose make(context) may find that something is wrong."""

    clear_shadows: BoolProperty(
        name="Clear Shadows", description="Light passes the liquid straight on. Otherwise shadows are dark and grainy in "
        "Cycles, unless the lamp casts shadow caustics and the ground receives them", default=True)

    def execute(self, context):
        try:
            self.make(context)
        except DropletError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class DropletSettings(Maker, AddObjectHelper):
    """The parameters of the liquid, as they appear in the redo panel."""

    width: FloatProperty(
        name="Width (mm)", description="Real width of the picture, or of the text or curve. It decides how the liquid "
        "behaves: small droplets are round, large ones are flat", default=known.number("width"), soft_min=0.01, soft_max=500,
        **known.limits("width", 1e-3))
    scale: FloatProperty(
        name="Scale", description="Units of the scene in a metre of liquid. At 100, a picture of 20 mm is 2 units wide",
        default=100, min=1e-3, soft_max=10000)
    fill: EnumProperty(name="Amount", items=(
        ("AUTO", "Automatic", "A contact angle of 40°, or the largest one that the footprint can hold"),
        ("ANGLE", "Contact Angle", "Mean contact angle along the rim"),
        ("VOLUME", "Volume", "Volume of each droplet"),
        ("HEIGHT", "Height", "Largest height of each droplet")))
    contact_angle: FloatProperty(
        name="Contact Angle", subtype="ANGLE", default=math.radians(known.number("contact-angle")),
        **known.limits("contact-angle"))
    volume: FloatProperty(name="Volume (µL)", default=30, soft_min=1e-6, soft_max=1000, **known.limits("volume", 1e-9))
    height: FloatProperty(name="Height (mm)", default=1, soft_min=1e-6, soft_max=10, **known.limits("height", 1e-3))
    share: BoolProperty(
        name="Share Liquid", description="All droplets share the amount at one pressure", default=False)
    liquid: EnumProperty(name="Liquid", items=[
        (name, name.capitalize(), "") for name in known.words("liquid")])
    look: EnumProperty(name="Look", items=[("auto", "Of the Liquid", "")] + [
        (name, name.capitalize(), "") for name in known.words("material")])
    model: EnumProperty(name="Model", items=[(name, *_MODELS.get(name, (name.capitalize(), ""))) for name in known.words("model")])
    triangles: IntProperty(
        name="Triangles", default=int(known.number("triangles")), soft_min=100, soft_max=200000,
        **known.limits("triangles", whole=True))
    use_gravity: BoolProperty(
        name="World Gravity", description="Gravity points down in the world, so that liquid sags on a slope. "
        "Otherwise it points into the ground", default=True)
    sink: FloatProperty(
        name="Sink (mm)", description="Depth of the base below the ground. Without it, renderers show air or noise "
        "between liquid and ground", default=0.01, min=0, soft_max=0.1)
    options: StringProperty(
        name="Options", description="More options of the command, such as --smooth 0.3mm --invert")

    def command_options(self, footprint, frame, width):
        """Options of the command. width: whether the picture has the width of these settings."""
        options = ["--liquid", self.liquid, "--model", self.model, "--triangles", str(self.triangles)]
        if width:
            options += ["--width", f"{self.width * footprint.page:.9g}mm"]
        if self.fill == "ANGLE":
            options += ["--contact-angle", f"{math.degrees(self.contact_angle):.7g}deg"]
        elif self.fill == "VOLUME":
            options += ["--volume", f"{self.volume:.7g}uL"]
        elif self.fill == "HEIGHT":
            options += ["--height", f"{self.height:.7g}mm"]
        if self.share:
            options += ["--fill", "total"]
        if self.look != "auto":
            options += ["--material", self.look]
        if self.use_gravity and frame is not None:
            tilt, direction = places.gravity(frame)
            if tilt > 1e-4:
                options += ["--tilt", f"{math.degrees(tilt):.5f}deg"]
            if 1e-4 < tilt < math.pi - 1e-4:
                options += ["--tilt-direction", f"{math.degrees(direction):.5f}deg"]
        try:
            return options + shlex.split(self.options)
        except ValueError as error:
            raise DropletError(f"options: {error}")

    def sunk(self, matrix):
        return matrix @ Matrix.Translation(Vector((0, 0, -self.sink * 1e-3)))

    def draw_liquid(self, layout):
        layout.use_property_split = True
        layout.prop(self, "fill")
        chosen = {"ANGLE": "contact_angle", "VOLUME": "volume", "HEIGHT": "height"}.get(self.fill)
        if chosen:
            layout.prop(self, chosen)
        for name in ("share", "liquid", "look", "clear_shadows", "model", "triangles", "use_gravity", "sink", "options"):
            layout.prop(self, name)

    def draw_place(self, layout):
        for name in ("align", "location", "rotation"):
            layout.prop(self, name)

    def tell(self, report):
        for warning in report.get("warnings", []):
            self.report({"WARNING"}, warning)


def _leave_edit_mode(context):
    """A new object is not part of the undo steps of a mesh in edit mode."""
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def _add(context, data, name):
    item = bpy.data.objects.new(name, data)
    context.collection.objects.link(item)
    return item


def _add_droplet(context, mesh, look, clear_shadows):
    item = _add(context, mesh, mesh.name)
    if look.transmission > 0 and not clear_shadows and hasattr(item, "cycles"):
        item.cycles.is_caustics_caster = True  # has an effect below lamps that cast and on ground that receives them
    return item


def _select(context, item):
    for other in context.selected_objects:
        other.select_set(False)
    item.select_set(True)
    context.view_layer.objects.active = item


def _outlines(context):
    """Texts and curves that are selected, the active one first."""
    active = context.view_layer.objects.active
    chosen = [item for item in context.selected_objects if item.type in footprints.OUTLINES]
    return sorted(chosen, key=lambda item: (item != active, item.name))


def _target(context):
    """The mesh that a droplet is laid on: the active object, or the only selected mesh."""
    active = context.view_layer.objects.active
    chosen = [item for item in context.selected_objects if item.type == "MESH"]
    if active is not None and active.type == "MESH":
        return active
    if len(chosen) != 1:
        raise DropletError("select the mesh to lay the droplet on")
    return chosen[0]


class MESH_OT_droplet_add(bpy.types.Operator, DropletSettings):
    """Make a droplet of liquid in the shape of a picture, a text or a curve"""

    bl_idname = "mesh.droplet_add"
    bl_label = "Droplet"
    bl_options = {"REGISTER", "UNDO"}

    source: EnumProperty(name="Source", items=(
        ("FILE", "File", "A picture or an SVG file"),
        ("IMAGE", "Image", "An image in this Blender file"),
        ("OBJECT", "Text or Curve", "The selected text or curve")))
    filepath: StringProperty(name="File", subtype="FILE_PATH")
    filter_glob: StringProperty(
        default="*.png;*.jpg;*.jpeg;*.svg;*.svgz;*.tif;*.tiff;*.webp;*.bmp;*.gif;*.ico;*.tga;*.pbm;*.pgm;*.ppm;*.jp2;"
                "*.exr;*.hdr",
        options={"HIDDEN"})
    image: StringProperty(name="Image")
    place: EnumProperty(name="Place", items=(
        ("AUTO", "Source or Cursor", "Where the text or curve is; pictures at the 3D cursor"),
        ("FACE", "Face", "On the selected face"),
        ("ONTO", "Along UV", "On the active object, by its texture coordinates")))
    fit: BoolProperty(
        name="Fit to Place", description="Scale the droplet to the text, the curve or the face instead of Scale",
        default=True)
    spin: FloatProperty(name="Spin", description="Turn on the face", subtype="ANGLE", default=0)
    texture_width: BoolProperty(
        name="Width of Texture", description="The picture is as large as the object's texture", default=True)
    hide_source: BoolProperty(
        name="Hide Source", description="Hide the text or curve, which lies where the droplet does", default=True)

    @classmethod
    def poll(cls, context):
        return context.mode in {"OBJECT", "EDIT_MESH"}

    def invoke(self, context, event):
        if self.source == "IMAGE" and self.image not in bpy.data.images:
            names = [image.name for image in bpy.data.images if image.size[0] > 0]
            self.image = names[0] if names else ""
        if self.source == "FILE":
            context.window_manager.fileselect_add(self)
            return {"RUNNING_MODAL"}
        return self.execute(context)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "source")
        if self.source == "IMAGE":
            layout.prop_search(self, "image", bpy.data, "images")
        elif self.source == "OBJECT":
            layout.prop(self, "hide_source")
        else:
            layout.prop(self, "filepath")
        layout.prop(self, "place")
        if self.place == "ONTO":
            layout.prop(self, "texture_width")
        if self.place != "ONTO" or not self.texture_width:
            layout.prop(self, "width")
        fits = self.place == "FACE" or (self.place == "AUTO" and self.source == "OBJECT")
        if fits:
            layout.prop(self, "fit")
        if not (fits and self.fit):
            layout.prop(self, "scale")
        if self.place == "FACE":
            layout.prop(self, "spin")
        elif self.place == "AUTO" and self.source != "OBJECT":
            self.draw_place(layout)
        self.draw_liquid(layout)

    def make(self, context):
        outline = self._outline(context)
        footprint = self._footprint(outline)
        target = _target(context) if self.place != "AUTO" else None
        face = ground = None
        if self.place == "FACE":
            face = places.selected_face(target, self.spin)
            frame = face.frame
        elif self.place == "ONTO":
            ground = places.shown_object(target, context, self.scale, needs_uv=True)
            frame = ground.frame
        elif footprint.frame is not None:
            frame = places.unscaled(footprint.frame)
        else:
            frame = add_object_align_init(context, operator=self)

        settings = preferences(context)
        result = command.run(
            command.find_program(settings.program), settings.timeout,
            self.command_options(footprint, None if ground else frame, not (ground and self.texture_width)),
            (footprint.file,), ground.file if ground else None)
        (part,) = result.model.parts
        welded = glb.weld(part)

        if ground is not None:
            matrix = frame @ Matrix.Scale(self.scale, 4)
        elif face is not None:
            matrix = self._matrix_on_face(face, part.positions[welded.rim, :2])
        elif footprint.frame is not None and self.fit:
            matrix = self.sunk(footprint.frame @ Matrix.Scale(footprint.extent / (self.width * 1e-3), 4))
        else:
            matrix = self.sunk(frame @ Matrix.Scale(self.scale, 4))
        scale = abs(matrix.determinant()) ** (1 / 3)

        _leave_edit_mode(context)
        mesh = meshes.make_mesh(part, welded, "Droplet")
        mesh.materials.append(materials.make_material(result.model.look, scale, self.clear_shadows))
        if result.model.look.transmission > 0:
            materials.prepare_eevee(context.scene)
        droplet = _add_droplet(context, mesh, result.model.look, self.clear_shadows)
        droplet.matrix_world = matrix
        meshes.add_shape_keys(droplet, part, welded)  # those of --fill-range
        if target is not None:
            droplet.parent = target
            droplet.matrix_parent_inverse = target.matrix_world.inverted()
        if outline is not None and self.hide_source:
            outline.hide_set(True)
            outline.hide_render = True
        _select(context, droplet)

        self.tell(result.report)
        shape = result.report["shape"]
        self.report({"INFO"}, f"{shape['volume_ul']:.4g} µL, {shape['height_max_m'] * 1e3:.4g} mm high, "
                              f"{len(mesh.polygons)} triangles")

    def _matrix_on_face(self, face, rim):
        middle = (rim.min(axis=0) + rim.max(axis=0)) / 2
        scale = face.scale_for(rim - middle) if self.fit else self.scale
        return self.sunk(face.frame @ Matrix.Scale(scale, 4) @ Matrix.Translation(Vector((*-middle, 0))))

    def _outline(self, context):
        if self.source != "OBJECT":
            return None
        chosen = _outlines(context)
        if not chosen:
            raise DropletError("select a text or a curve")
        return chosen[0]

    def _footprint(self, outline):
        if outline is not None:
            return footprints.from_object(outline)
        if self.source == "IMAGE":
            return footprints.from_image(self.image)
        return footprints.from_file(self.filepath)


class MESH_OT_droplet_sequence_add(bpy.types.Operator, DropletSettings):
    """Make droplets that move: of numbered pictures or a video, or liquid that flows from one footprint to the next"""

    bl_idname = "mesh.droplet_sequence_add"
    bl_label = "Droplet Sequence"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(name="File", subtype="FILE_PATH")
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN"})
    files: CollectionProperty(type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"})
    kind: EnumProperty(name="Kind", items=(
        ("FRAMES", "Frames", "The pictures are frames. One numbered picture stands for all of its sequence"),
        ("FLOW", "Flow", "Liquid flows from one of the pictures to the next")))
    frames: IntProperty(name="Frames", description="Number of frames of the flow", default=48, min=2, soft_max=250)
    volume_mode: EnumProperty(name="Keep", items=(
        ("total", "Total Volume", "All droplets together keep their volume, at one pressure"),
        ("track", "Each Volume", "Every droplet keeps its volume, through merging and splitting"),
        ("fill", "Amount", "Every frame has the amount below")))

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "kind")
        if self.kind == "FLOW":
            layout.prop(self, "frames")
        layout.prop(self, "volume_mode")
        layout.prop(self, "width")
        layout.prop(self, "scale")
        self.draw_place(layout)
        self.draw_liquid(layout)

    def _chosen_files(self):
        names = sorted(item.name for item in self.files if item.name)
        folder = os.path.abspath(bpy.path.abspath(self.directory))
        paths = [os.path.join(folder, name) for name in names]
        if not paths and self.filepath:
            paths = [os.path.abspath(bpy.path.abspath(self.filepath))]
        if self.kind == "FLOW":
            if len(paths) < 2:
                raise DropletError("a flow needs two pictures or more")
        elif not paths:
            raise DropletError("no pictures are chosen")
        elif len(paths) == 1 and os.path.isfile(paths[0]):
            paths = [footprints.numbered(paths[0])]
        return tuple(command.Input(path) for path in paths)

    def make(self, context):
        inputs = self._chosen_files()
        render = context.scene.render
        fps = render.fps / render.fps_base
        frame = add_object_align_init(context, operator=self)
        arguments = ["morph", "--frames", str(self.frames)] if self.kind == "FLOW" else ["animate"]
        arguments += ["--fps", f"{fps:.9g}", "--volume-mode", self.volume_mode]
        arguments += self.command_options(footprints.Footprint(inputs[0]), frame, True)
        settings = preferences(context)
        result = command.run(command.find_program(settings.program), settings.timeout, arguments, inputs)

        material = materials.make_material(result.model.look, self.scale, self.clear_shadows)
        if result.model.look.transmission > 0:
            materials.prepare_eevee(context.scene)
        parent = _add(context, None, "Droplet")
        parent.matrix_world = self.sunk(frame @ Matrix.Scale(self.scale, 4))
        for part in result.model.parts:
            welded = glb.weld(part)
            mesh = meshes.make_mesh(part, welded, f"Droplet {part.name}")
            mesh.materials.append(material)
            item = _add_droplet(context, mesh, result.model.look, self.clear_shadows)
            item.parent = parent
            meshes.add_shape_keys(item, part, welded, fps, context.scene.frame_start)
        _select(context, parent)
        self.tell(result.report)


class MESH_OT_droplet_dew_add(bpy.types.Operator, Maker):
    """Cover the active mesh with droplets that rest on it: dew, rain, a cold bottle"""

    bl_idname = "mesh.droplet_dew_add"
    bl_label = "Dew"
    bl_options = {"REGISTER", "UNDO"}

    preset: EnumProperty(name="Kind", items=[(name, label, "") for name, label in _KINDS_OF_DEW.items()])
    scale: FloatProperty(
        name="Scale", description="Units of the scene in a metre: at 100, an object of 2 units is 2 cm large. Droplets "
        "have the sizes of real ones", default=20, min=1e-3, soft_max=10000)
    coverage: FloatProperty(
        name="Coverage", description="Share of the surface below droplets; 0: of the kind", default=0, min=0,
        max=0.7)
    smallest: FloatProperty(
        name="Smallest (mm)", description="Radius of the smallest droplets, seen from above; 0: of the kind", default=0, min=0, max=20)
    largest: FloatProperty(
        name="Largest (mm)", description="Radius of the largest droplets, seen from above; 0: of the kind", default=0, min=0, max=20)
    contact_angle: FloatProperty(
        name="Contact Angle", description="30° is clean glass, 105° wax or plastic", subtype="ANGLE",
        default=math.radians(105), min=math.radians(1), max=math.radians(179))
    hysteresis: FloatProperty(
        name="Hysteresis", description="More of it holds larger droplets on walls", default=0.2, min=0, max=2)
    vertex_group: StringProperty(
        name="Vertex Group", description="Droplets are where this group has weight; empty: all over the mesh")
    seed: IntProperty(name="Seed", default=1, min=0)
    detail: EnumProperty(name="Detail", items=(
        ("low", "Low", "64 triangles for most droplets: quick, to find the other settings"),
        ("medium", "Medium", "Up to 352 triangles"), ("high", "High", "Up to 608 triangles")))
    use_gravity: BoolProperty(
        name="World Gravity", description="Droplets sag, and large ones run off slopes", default=True)
    options: StringProperty(
        name="Options", description="More options of droplet-shape dew, such as --from 1,1,0 --liquid honey")

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def draw(self, context):
        self.layout.use_property_split = True
        for name in ("preset", "scale", "coverage", "smallest", "largest", "contact_angle", "hysteresis"):
            self.layout.prop(self, name)
        if context.active_object is not None:
            self.layout.prop_search(self, "vertex_group", context.active_object, "vertex_groups")
        for name in ("seed", "detail", "use_gravity", "clear_shadows", "options"):
            self.layout.prop(self, name)

    def make(self, context):
        target = _target(context)
        ground = places.shown_object(target, context, self.scale, needs_uv=False, group=self.vertex_group)
        arguments = ["dew", "--preset", self.preset, "--seed", str(self.seed), "--hysteresis", f"{self.hysteresis:.7g}",
                     "--contact-angle", f"{math.degrees(self.contact_angle):.7g}deg", "--droplets-only", "--instancing", "none",
                     "--detail", self.detail]
        if self.vertex_group:
            arguments += ["--vertex-weights"]
        if self.coverage > 0:
            arguments += ["--coverage", f"{max(self.coverage, 1e-3):.7g}"]
        for option, radius in (("--smallest", self.smallest), ("--largest", self.largest)):
            if radius > 0:
                arguments += [option, f"{radius:.7g}mm"]
        down = ground.frame.to_3x3().inverted() @ Vector((0, 0, -1))
        down = down.x, down.z, -down.y  # +Y up in the file
        if self.use_gravity:
            arguments += [f"--gravity-direction={down[0]:.7g},{down[1]:.7g},{down[2]:.7g}"]
        else:
            arguments += ["--gravity", "0m/s2"]
        if self.preset == "rain" and "--from" not in self.options:
            arguments += [f"--from={-down[0]:.7g},{-down[1]:.7g},{-down[2]:.7g}"]
        try:
            arguments += shlex.split(self.options)
        except ValueError as error:
            raise DropletError(f"options: {error}")
        settings = preferences(context)
        result = command.run(
            command.find_program(settings.program), settings.timeout, arguments, (ground.file,), has_report=False)
        if not result.model.parts:
            raise DropletError("no droplet fits on the object")
        (part,) = result.model.parts
        mesh = meshes.make_mesh(part, glb.weld(part), "Dew")
        mesh.materials.append(materials.make_material(result.model.look, self.scale, self.clear_shadows))
        if result.model.look.transmission > 0:
            materials.prepare_eevee(context.scene)
        dew = _add_droplet(context, mesh, result.model.look, self.clear_shadows)
        dew.matrix_world = ground.frame @ Matrix.Scale(self.scale, 4)
        dew.parent = target
        dew.matrix_parent_inverse = target.matrix_world.inverted()
        _select(context, dew)
        context.view_layer.objects.active = target  # the redo panel covers it again
        self.report({"INFO"}, f"{len(mesh.polygons)} triangles of droplets")


class OBJECT_OT_droplet_clear_shadows(bpy.types.Operator):
    """Let light pass clear materials of the selected objects straight on, such as those of imported glTF files, and
    refract in Eevee"""

    bl_idname = "object.droplet_clear_shadows"
    bl_label = "Clear Shadows"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def execute(self, context):
        worn = {slot.material for item in context.selected_objects for slot in item.material_slots if slot.material}
        changed = [material for material in worn if materials.let_light_through(material)]
        for material in changed:
            materials.refract_in_eevee(material)
        if changed:
            materials.prepare_eevee(context.scene)
        self.report({"INFO"}, f"materials whose shadows are clear now: {len(changed)}")
        return {"FINISHED"}


class VIEW3D_MT_droplet_add(bpy.types.Menu):
    bl_idname = "VIEW3D_MT_droplet_add"
    bl_label = "Droplet"

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        entries = (
            ("From Picture or SVG...", "FILE", "AUTO"),
            ("From Image", "IMAGE", "AUTO"),
            ("From Text or Curve", "OBJECT", "AUTO"),
            (None, None, None),
            ("Picture on Face...", "FILE", "FACE"),
            ("Text or Curve on Face", "OBJECT", "FACE"),
            ("Picture along UV...", "FILE", "ONTO"),
        )
        for text, source, place in entries:
            if text is None:
                layout.separator()
                continue
            entry = layout.operator(MESH_OT_droplet_add.bl_idname, text=text)
            entry.source, entry.place = source, place
        layout.operator(MESH_OT_droplet_dew_add.bl_idname, text="Dew or Rain on Object")
        layout.separator()
        layout.operator(MESH_OT_droplet_sequence_add.bl_idname, text="Sequence...")


def _menu(self, context):
    self.layout.menu(VIEW3D_MT_droplet_add.bl_idname, icon="META_BALL")


def _object_menu(self, context):
    self.layout.operator(OBJECT_OT_droplet_clear_shadows.bl_idname, text="Clear Shadows of Liquids")


_CLASSES = (MESH_OT_droplet_add, MESH_OT_droplet_dew_add, MESH_OT_droplet_sequence_add, OBJECT_OT_droplet_clear_shadows,
            VIEW3D_MT_droplet_add)


def register():
    for kind in _CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.VIEW3D_MT_mesh_add.append(_menu)
    bpy.types.VIEW3D_MT_object.append(_object_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(_object_menu)
    bpy.types.VIEW3D_MT_mesh_add.remove(_menu)
    for kind in reversed(_CLASSES):
        bpy.utils.unregister_class(kind)
