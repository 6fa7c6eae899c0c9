"""A glTF model with drawings on its materials."""

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final
from urllib.parse import quote

from vexture.base.content import FileKind, about, kind_of, read_bytes, start_of
from vexture.base.errors import ParameterError, SourceError, SourceWarning, format_count
from vexture.base.layout import PACKED_SUFFIX
from vexture.gltf.appearance import HALF, WHITE, Appearance, Background, Mode, Wrap
from vexture.gltf.container import REMEDY, Container, objects_in, parse, to_glb, to_gltf
from vexture.gltf.resources import KTX2_TYPE, content_at, data_uri, files_beside, missing_file, pack, with_view

if TYPE_CHECKING:
    from vexture.drawing.drawing import Drawing
    from vexture.texture.texture import Texture

EXTENSION: Final = "VEXTURE_vector_texture"
GLB: Final = ".glb"
GLTF: Final = ".gltf"

MOST_NAMED: Final = 12
"""Most materials in a message."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Model:
    """A model of glTF 2.0, as `read_model` returns it.

    Everything unknown to vexture is kept: all bytes, members, extensions and extras.

    Attributes
    ----------
    materials : tuple of str
        Names of its materials in order; the name is empty for a material without one.
    """

    container: Container
    name: str = "model"
    folder: Path | None = None
    textures: Mapping[int, bytes] = field(default_factory=dict)
    """Files of added textures, by their index in the extension's list."""

    def __repr__(self) -> str:
        return f"<Model {self.name}: {format_count(len(self.materials), 'material')}>"

    @property
    def materials(self) -> tuple[str, ...]:
        """Names of the materials."""
        names = (material.get("name") for material in objects_in(self.container.document, "materials"))
        return tuple(name if isinstance(name, str) else "" for name in names)

    def place_of(self, material: str | int) -> int:
        """Return the index of a material, given by name or index.

        Raises
        ------
        ParameterError
                If there is no such material, or several have that name.
        """
        names = self.materials
        places = [place for place, name in enumerate(names) if name == material]
        if not places and isinstance(material, int | str) and not isinstance(material, bool):
            number = int(material) if str(material).isascii() and str(material).isdigit() else -1
            places = [number] if 0 <= number < len(names) else []
        if len(places) == 1:
            return places[0]
        if places:
            listed_places = ", ".join(map(str, places[:MOST_NAMED]))
            raise ParameterError(
                f"{self.name}: {len(places)} materials are named {material!r}; give the place of one: {listed_places}"
            )
        there = ", ".join(repr(name) if name else str(place) for place, name in enumerate(names[:MOST_NAMED]))
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        what = f"its materials are {there}{more}" if names else "it has none"
        raise ParameterError(f"{self.name}: no material {material!r:.80}; {what}")

    def with_drawing(
        self,
        material: str | int,
        drawing: "Texture | Drawing | str | os.PathLike[str]",
        *,
        mode: Mode = "paint",
        root: str | int | None = None,
        wrap: Wrap = "none",
        invert: bool = False,
        background: Background = "own",
        color: str | Sequence[float] = WHITE,
        threshold: float = HALF,
        tex_coord: int = 0,
        offset: tuple[float, float] = (0.0, 0.0),
        rotation: float = 0.0,
        scale: tuple[float, float] = (1.0, 1.0),
        conversion: Mapping[str, Any] | None = None,
    ) -> "Model":
        """Return the model with a drawing on a material, in place of any drawing that the material has.

        Parameters
        ----------
        material : str or int
            Name of the material, or its index from 0 if names are missing or ambiguous.
        drawing : Texture, Drawing or path
            A texture or its file, or a drawing or file that `vexture.convert` converts: in its colours in mode
            ``"paint"``, and as its silhouette in other modes.
        mode : str
            ``"paint"`` shows the drawing's own colours, ``"mix"`` shows `color` inside the drawing, and ``"cut"``
            removes everything outside it. ``"alpha"`` does the same with a soft edge, which needs blending.
        root : str or int, optional
            Shape of a texture with several shapes, or, in mode ``"paint"``, its drawing.
        wrap : str
            Content beyond the unit square: ``"none"``, ``"clamp"`` (the value at its border) or ``"repeat"``.
        invert : bool
            Exchange inside and outside; not in mode ``"paint"``.
        background : str
            In mode ``"paint"``, the colour around the drawing: the material's ``"own"`` colour, or ``"none"``.
        color : str or sequence of float
            In mode ``"mix"``, a CSS colour, or sRGB in 0..1; white by default.
        threshold : float
            In mode ``"cut"``, the least coverage of pixels that are drawn; 0.5 by default.
        tex_coord : int
            Set of texture coordinates, 0 or 1.
        offset, rotation, scale : pair of float, float, pair of float
            Transform of the texture coordinates, as in KHR_texture_transform: a scale of (4, 4) makes the drawing a
            quarter as large. A positive `rotation`, in degrees, turns the drawing counter-clockwise.
        conversion : mapping, optional
            Parameters of `vexture.convert`, such as ``{"precision": 1e-7}``.

        Returns
        -------
        Model

        Raises
        ------
        ParameterError
            If there is no such material or root, or a parameter is out of range or has no meaning in the mode.
        SourceError
            If the drawing, or a part of the model to be changed, cannot be read.

        Warns
        -----
        SourceWarning
            As from `vexture.convert`, and if a mesh with the material lacks these texture coordinates.

        Examples
        --------
        >>> import vexture
        >>> plain = b'{"asset": {"version": "2.0"}, "materials": [{"name": "Sign"}, {"name": "Wall"}]}'
        >>> kite = vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)])
        >>> model = vexture.read_model(plain).with_drawing("Sign", kite, mode="cut", wrap="repeat", scale=(4, 4))
        >>> model.container.document["materials"][0]["extensions"]["VEXTURE_vector_texture"]
        {'texture': 0, 'mode': 'cut', 'wrap': 'repeat', 'transform': {'scale': [4.0, 4.0]}}
        """
        place = self.place_of(material)
        shown = Appearance(
            mode, root, wrap, invert, background, color, threshold, tex_coord, offset, rotation, scale
        )  # fmt: skip
        texture = texture_of(drawing, shown, conversion or {})
        shown.check(texture)
        with about(self.name):
            self._warn_of_coordinates(place, shown.tex_coord)
            return self._with_texture(place, texture.name, texture.to_ktx2(), shown)

    def _with_texture(self, place: int, name: str, content: bytes, appearance: Appearance) -> "Model":
        """Return the model with the file of a texture on a material; a texture that other materials have is shared."""
        document = dict(self.container.document)
        materials = list(objects_in(document, "materials"))
        extensions = _object(document, "extensions", "extensions")
        known = _object(extensions, EXTENSION, f"extensions.{EXTENSION}")
        textures = list(objects_in(known, "textures"))
        index = next((one for one, other in self.textures.items() if other == content), None)
        if index is None:
            index = _free(materials, place, len(textures))
            textures[index : index + 1] = [{"name": name, "mimeType": KTX2_TYPE}]
        own = _object(materials[place], "extensions", f"materials[{place}].extensions")
        materials[place] = materials[place] | {
            "extensions": own | {EXTENSION: {"texture": index, **appearance.facts()}}
        }
        document["materials"] = materials
        document["extensions"] = extensions | {EXTENSION: known | {"textures": textures}}
        document["extensionsUsed"] = _with_name(document.get("extensionsUsed", []))
        container = replace(self.container, document=document)
        return replace(self, container=container, textures={**self.textures, index: content})

    def _warn_of_coordinates(self, place: int, tex_coord: int) -> None:
        """Warn of meshes on which the drawing is invisible."""
        for number, mesh in enumerate(objects_in(self.container.document, "meshes")):
            for primitive in objects_in(mesh, "primitives"):
                attributes = primitive.get("attributes")
                has = isinstance(attributes, dict) and f"TEXCOORD_{tex_coord}" in attributes
                if primitive.get("material") == place and not has:
                    called = repr(mesh.get("name", number))
                    warnings.warn(
                        f"{self.name}: the mesh {called:.80} has no texture coordinates {tex_coord}, so it does not "
                        "show the drawing; unwrap it",
                        SourceWarning,
                        stacklevel=3,
                    )
                    return

    def files(self, path: str | os.PathLike[str]) -> dict[Path, bytes]:
        """Return the contents of the file, and of the files next to a .gltf; parameters and errors as in `save`."""
        target = target_of(path)
        with about(self.name):
            file = missing_file(self.container, self.folder, target)
            if target.suffix.lower() == GLB:
                return {target: to_glb(self._embedded(bool(file) or not self.container.is_glb))}
            if file:
                raise ParameterError(
                    f"{target}: the model refers to {file} beside it; write it into the same folder, or a {GLB}"
                )
            return self._beside(target)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the model.

        Parameters
        ----------
        path : path
            A ``.glb`` contains everything, including files next to a .gltf, and files next to a .glb if it is saved in
            another folder. For a ``.gltf``, its textures and the bytes of a .glb are saved next to it, in files whose
            names start with its own. Its references to other files stay, so with such files it must stay in its folder.

        Returns
        -------
        Path

        Raises
        ------
        ParameterError
            If the suffix is wrong, or a .gltf would be in another folder than files that it refers to.
        SourceError
            If a file that the model refers to is missing.
        LimitError
            If a .glb would be too long.
        DeviceError
            If the file cannot be written.
        """
        from vexture.texture.files import write_together

        files = self.files(path)
        write_together(files)
        return next(iter(files))

    def _embedded(self, whole: bool) -> Container:
        """Return the model as a .glb; if `whole`, with the files next to it."""
        there = enumerate(_textures(self.container))
        beside = {
            index: content_at(entry["uri"], self.folder) for index, entry in there if whole and files_beside(entry)
        }
        textures = beside | dict(self.textures)
        container = replace(self, textures=textures)._with_addresses({})
        if whole:
            container = pack(container, self.folder)
        for index, content in textures.items():
            container, view = with_view(container, content)
            source = {"uri": data_uri(content, KTX2_TYPE)} if view is None else {"bufferView": view}
            container = _with_source(container, index, source)
        return container

    def _beside(self, target: Path) -> dict[Path, bytes]:
        """Return the contents of a .gltf and of the files next to it."""
        from vexture.texture.files import file_name

        beside: dict[Path, bytes] = {}
        addresses = {}
        for index, content in self.textures.items():
            name = file_name(str(_textures(self.container)[index].get("name") or index))
            file = target.with_name(f"{target.stem}.{name}{PACKED_SUFFIX}")
            if file in beside:
                file = target.with_name(f"{target.stem}.{name}.{index}{PACKED_SUFFIX}")
            beside[file] = content
            addresses[index] = quote(file.name)
        container = self._with_addresses(addresses)
        if container.others:
            raise ParameterError(f"{target}: the model has parts that only a .glb can hold; write a .glb")
        buffers = objects_in(container.document, "buffers")
        if container.binary is not None and buffers and "uri" not in buffers[0]:
            file = target.with_suffix(".bin")
            beside[file] = container.binary
            buffers = [buffers[0] | {"uri": quote(file.name)}, *buffers[1:]]
            container = replace(container, document=container.document | {"buffers": buffers})
        return {target: to_gltf(container.document, container.indent), **beside}

    def _with_addresses(self, addresses: Mapping[int, str]) -> Container:
        """Return the model with the addresses of its new textures; a texture without one is not stored yet."""
        container = self.container
        for index in self.textures:
            source = {"uri": addresses[index]} if index in addresses else {}
            container = _with_source(container, index, source)
        return container


def target_of(path: str | os.PathLike[str]) -> Path:
    """Return the file to write a model to; raise a `ParameterError` if its suffix is wrong."""
    target = Path(path)
    if target.suffix.lower() not in (GLB, GLTF):
        raise ParameterError(f"`output` {path}: models are files of glTF; name one that ends in {GLB} or {GLTF}")
    return target


def texture_of(
    drawing: "Texture | Drawing | str | os.PathLike[str]", appearance: Appearance, conversion: Mapping[str, Any]
) -> "Texture":
    """Return a texture, load one, or convert a drawing to one."""
    from vexture.conversion.pipeline import convert
    from vexture.texture.load import load
    from vexture.texture.texture import Texture

    texture = drawing if isinstance(drawing, Texture) else None
    if isinstance(drawing, str | os.PathLike) and kind_of(start_of(drawing), drawing) is FileKind.TEXTURE:
        texture = load(drawing)
    if texture is None:
        parameters: dict[str, Any] = {"split": appearance.split, **conversion}
        return convert(drawing, **parameters)  # type: ignore[arg-type,return-value]
    for name in conversion:
        raise ParameterError(f"`{name}` is for drawings, and {texture.name} is a texture already; leave it out")
    return texture


def read_model(source: str | os.PathLike[str] | bytes, *, name: str | None = None) -> Model:
    """Read a model of glTF 2.0.

    Parameters
    ----------
    source : path or bytes
        A ``.glb`` or a ``.gltf``, or its content, in which case files next to it are unknown. Only its JSON is checked,
        because the model is not displayed.
    name : str, optional
        Name of the model in messages; by default the path.

    Returns
    -------
    Model

    Raises
    ------
    SourceError
        If it cannot be read, is damaged, or is not glTF 2.0.

    Examples
    --------
    >>> read_model(b'{"asset": {"version": "2.0"}, "materials": [{"name": "Sign"}]}').materials
    ('Sign',)
    """
    label = name or ("model" if isinstance(source, bytes) else os.fspath(source))
    with about(label):
        container = parse(read_bytes(source))
        model = Model(container, label, None if isinstance(source, bytes) else Path(source).parent)
        for part in ("materials", "meshes", "buffers", "bufferViews", "images"):
            objects_in(container.document, part)
    return model


def _object(owner: dict[str, Any], name: str, location: str) -> dict[str, Any]:
    """Return an object in another one; empty if there is none."""
    found = owner.get(name, {})
    if not isinstance(found, dict):
        raise SourceError(f"{location} is no object; {REMEDY}")
    return found


def _with_name(used: Any) -> list[Any]:
    if not isinstance(used, list):
        raise SourceError(f"extensionsUsed is no list; {REMEDY}")
    return used if EXTENSION in used else [*used, EXTENSION]


def _free(materials: list[dict[str, Any]], place: int, count: int) -> int:
    """Return the index for a new texture: that of the material's own if no other material uses it, or the next."""
    shown = []
    for material in materials:
        extensions = material.get("extensions")
        own = extensions.get(EXTENSION) if isinstance(extensions, dict) else None
        shown.append(own.get("texture") if isinstance(own, dict) else None)
    before = shown[place]
    is_own = isinstance(before, int) and 0 <= before < count and shown.count(before) == 1
    return before if is_own else count  # type: ignore[return-value]


def _textures(container: Container) -> list[dict[str, Any]]:
    extensions = _object(container.document, "extensions", "extensions")
    return objects_in(_object(extensions, EXTENSION, f"extensions.{EXTENSION}"), "textures")


def _with_source(container: Container, index: int, source: dict[str, Any]) -> Container:
    """Return the model with a source for a texture."""
    extensions = container.document["extensions"]
    textures = list(_textures(container))
    rest = {name: value for name, value in textures[index].items() if name not in ("uri", "bufferView")}
    textures[index] = rest | source
    extensions = extensions | {EXTENSION: extensions[EXTENSION] | {"textures": textures}}
    return replace(container, document=container.document | {"extensions": extensions})
