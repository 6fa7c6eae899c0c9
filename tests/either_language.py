"""Pictures drawn by one text in both languages: GLSL as it is (OpenGL), with parameters (OpenGL), and as WGSL (wgpu).

A text is a file of `glsl/` and a function ``vec4 shown(vec2 pixel)``, whose uniforms are given by name: an array of
four words for each texel is a texture, everything else a value.
"""

import re
import struct
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from vexture.renderers.device import context, draw, upload
from vexture.renderers.shader import VERSIONS, chosen, vertex_source
from wgsl_generator import to_wgsl, with_parameters
from wgsl_generator.facts import Facts, facts_of
from wgsl_generator.kinds import TEXTURES, array_of, size_of, wgsl_type
from wgsl_generator.parser import parse

Picture = NDArray[np.float32]
Given = Mapping[str, Any]
Numbers = tuple[tuple[str, int], ...]
WEB = "300 es"
DRAWN = "\nout vec4 color_of_pixel;\nvoid main() {{ color_of_pixel = shown({}gl_FragCoord.xy); }}\n"
CORNER = """
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, i == 1u), select(-1.0, 3.0, i == 2u), 0.0, 1.0);
}
"""


def head(numbers: Numbers) -> str:
    return VERSIONS[WEB] + "".join(f"#define {name} {value}\n" for name, value in numbers)


def read_by(text: str) -> tuple[Facts, dict[str, str]]:
    """Uniforms of `shown` and their types."""
    facts = facts_of(parse(text))
    return facts, {name: facts.uniforms[name] for name in facts.forms["shown", 1].reads}


@cache
def glsl_program(source: str) -> Any:
    gl = context()
    return gl.vertex_array(gl.program(vertex_shader=vertex_source(WEB), fragment_shader=source), [])


def drawn_in_opengl(source: str, values: Given, size: tuple[int, int]) -> Picture:
    with context() as gl:
        triangle = glsl_program(source)
        textures = []
        for name, value in values.items():
            if name not in triangle.program:
                continue  # a choice of numbers left nothing that reads it
            if isinstance(value, np.ndarray) and value.ndim == 3:
                textures.append(upload(gl, value, len(textures), "u4"))
                triangle.program[name] = len(textures) - 1
            elif isinstance(value, np.ndarray):
                triangle.program[name].write(value.T.astype(np.float32).tobytes())
            else:
                triangle.program[name] = value
        picture = draw(gl, triangle, size, 4)
        for one in textures:
            one.release()
    return picture


def by_glsl(text: str, numbers: Numbers, values: Given, size: tuple[int, int]) -> Picture:
    """The picture by GLSL as it is."""
    return drawn_in_opengl(head(numbers) + text + DRAWN.format(""), values, size)


def by_parameters(text: str, numbers: Numbers, values: Given, size: tuple[int, int]) -> Picture:
    """The picture by GLSL whose uniforms have other names outside."""
    _, reads = read_by(text)
    own = ""
    for name, type_ in reads.items():
        element, count = array_of(type_) or (type_, "")
        precision = "" if element == "bool" else "highp "
        own += f"uniform {precision}{element} own_{name}{f'[{count}]' if count else ''};\n"
    source = head(numbers) + with_parameters(text) + own + DRAWN.format("".join(f"own_{name}, " for name in reads))
    return drawn_in_opengl(source, {f"own_{name}": value for name, value in values.items()}, size)


@cache
def device() -> Any:
    wgpu = pytest.importorskip("wgpu")
    adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance", force_fallback_adapter=False)
    if adapter is None:
        pytest.skip("no Vulkan driver (Debian: mesa-vulkan-drivers)")
    return adapter.request_device_sync()


def pack_uniforms(values: list[tuple[str, Any]]) -> bytes:
    """Values of these types as a uniform buffer (WGSL 14.4.1, Alignment and Size)."""
    data = bytearray()
    for type_, value in values:
        array = array_of(type_)
        size = 3 if type_ == "mat3" else size_of(array[0] if array else type_)
        align = 16 if array or size > 2 else 4 * size
        data += bytes(-len(data) % align)
        letter = "f" if re.sub(r"\d|\[.*", "", type_) == "vec" or type_ in ("float", "mat3") else "I"
        rows = np.atleast_2d(np.asarray(value)) if type_ != "mat3" else np.asarray(value).T
        for row in rows:
            data += bytes(-len(data) % align)
            data += struct.pack(f"{row.size}{'i' if type_ == 'int' else letter}", *row.tolist())
        data += bytes(-len(data) % 16 if array or type_ == "mat3" else 0)
    return bytes(data + bytes(-len(data) % 16))


def bound(reads: dict[str, str]) -> str:
    """Bindings of the uniforms and the fragment's entry point."""
    fields, bindings, handed = "", "", []
    for name, type_ in reads.items():
        if type_ in TEXTURES:
            place = bindings.count("@binding") + 1
            bindings += f"@group(0) @binding({place}) var own_{name}: {wgsl_type(type_)};\n"
            handed.append(f"own_{name}")
        elif type_ == "bool":
            fields += f"    {name}: u32,\n"
            handed.append(f"values.{name} != 0u")
        else:
            fields += f"    {name}: {wgsl_type(type_)},\n"
            handed.append(f"values.{name}")
    values = f"struct Values {{\n{fields}}}\n@group(0) @binding(0) var<uniform> values: Values;\n" if fields else ""
    entry = f"return shown({', '.join([*handed, 'at.xy'])});"
    return (
        f"{values}{bindings}{CORNER}"
        f"@fragment fn pixel(@builtin(position) at: vec4f) -> @location(0) vec4f {{ {entry} }}\n"
    )


@cache
def wgsl_pipeline(text: str, numbers: Numbers) -> Any:
    _, reads = read_by(text)
    constants = dict(re.findall(r"^#define (VEXTURE_WRAP_\w+) (\d+)$", text, re.MULTILINE))
    source = chosen(to_wgsl(text), {**{name: int(value) for name, value in constants.items()}, **dict(numbers)})
    module = device().create_shader_module(code=source + bound(reads))
    return device().create_render_pipeline(
        layout="auto",
        vertex={"module": module, "entry_point": "corner"},
        primitive={"topology": "triangle-list"},
        fragment={"module": module, "entry_point": "pixel", "targets": [{"format": "rgba32float"}]},
    )


def by_wgsl(text: str, numbers: Numbers, given: Given, size: tuple[int, int]) -> Picture:
    """The picture by WGSL, in wgpu."""
    pipeline, gpu = wgsl_pipeline(text, numbers), device()
    import wgpu

    _, reads = read_by(text)
    values = pack_uniforms([(type_, given[name]) for name, type_ in reads.items() if type_ not in TEXTURES])
    entries: list[dict[str, Any]] = []
    if values:
        buffer = gpu.create_buffer_with_data(data=values, usage=wgpu.BufferUsage.UNIFORM)
        entries.append({"binding": 0, "resource": {"buffer": buffer, "offset": 0, "size": len(values)}})
    for place, name in enumerate((name for name, type_ in reads.items() if type_ in TEXTURES), 1):
        entries.append({"binding": place, "resource": texture_of(gpu, given[name]).create_view()})
    target = gpu.create_texture(
        size=(*size, 1),
        format="rgba32float",
        usage=wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC,
    )
    group = gpu.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=entries)
    encoder = gpu.create_command_encoder()
    drawing = encoder.begin_render_pass(
        color_attachments=[{"view": target.create_view(), "load_op": "clear", "store_op": "store"}]
    )
    drawing.set_pipeline(pipeline)
    drawing.set_bind_group(0, group)
    drawing.draw(3)
    drawing.end()
    gpu.queue.submit([encoder.finish()])
    read = gpu.queue.read_texture({"texture": target}, {"bytes_per_row": size[0] * 16}, (*size, 1))
    return np.frombuffer(read, np.float32).reshape(size[1], size[0], 4)


def texture_of(gpu: Any, texels: NDArray[np.uint32]) -> Any:
    import wgpu

    rows, width = texels.shape[:2]
    usage = wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST
    made = gpu.create_texture(size=(width, rows, 1), format="rgba32uint", usage=usage)
    layout = {"bytes_per_row": width * 16, "rows_per_image": rows}
    gpu.queue.write_texture({"texture": made}, np.ascontiguousarray(texels), layout, (width, rows, 1))
    return made
