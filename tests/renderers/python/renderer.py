"""The rasterizer as plumb runs it: by plumbline's kit, each primitive of a scene becomes a call of draw_triangle()."""

import numpy as np

import plumbline
from rasterizer import Frame, draw_triangle

CODES = {"rgba8": 255, "rgba12": 4095, "rgba16": 65535, "rgba32f": 0, "z8": 255, "z16": 65535, "z24": 16777215, "z32f": 0}
UNABLE = ("alpha_test", "stencil", "fog", "blend", "logic_op", "texture")


def require(holds, reason):
    if not holds:
        raise plumbline.Unsupported(reason)


def state_of(draw, frame, depth_clamp):
    for feature in UNABLE:
        require(draw[feature] is None, feature)
    require(draw["topology"] == "triangles", draw["topology"])
    require(draw["front_mode"] == draw["back_mode"] == "fill", "polygon modes")
    require(not draw["lit"] or draw["shading"] != "phong", "light per fragment")
    require(draw["polygon_offset"]["units"] == 0 or frame.depth_codes > 0, "polygon offset of float depth")
    x, y, width, height = draw["scissor"] or (0, 0, frame.width, frame.height)
    return {"box": np.array([x, y, min(x + width, frame.width), min(y + height, frame.height)]),
            "cull": draw["cull"], "depth_clamp": depth_clamp, "depth_func": draw["depth_func"],
            "depth_range": draw["depth_range"], "depth_mask": draw["depth_mask"], "color_mask": draw["color_mask"],
            "offset_factor": draw["polygon_offset"]["factor"],
            "offset_units": draw["polygon_offset"]["units"] * 2 / max(frame.depth_codes, 1)}


def draw(scene, out):
    of = scene["frame"]
    require(scene["light_model"]["sides"] == "one", "two-sided light")
    require(not scene["light_model"]["separate_specular"], "separate specular")
    require(of["sample"] == [0, 0], "samples off the pixels' centres")
    frame = Frame(of["width"], of["height"], CODES[of["color"]], CODES[of["depth"]], of["clear_color"], of["clear_depth"])
    states = [state_of(draw, frame, of["depth_clamp"]) for draw in scene["draws"]]
    vertices = np.hstack([scene.array("vertex.p_clip"), scene.array("light.color")]).astype(float)
    for draw, state in zip(scene["draws"], states):
        for triangle in scene.array(f"meshes.{draw['mesh']}.indices") + draw["first_vertex"]:
            corners = vertices[triangle]
            if draw["shading"] == "flat":
                corners[:, 4:] = corners[2, 4:]
            draw_triangle(frame, state, corners)
    color, depth = frame.numbers()
    out.plane("color", color)
    out.plane("depth", depth)


plumbline.main("a small rasterizer in Python", draw)
