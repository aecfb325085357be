"""A scene of an export as what draw.js draws: state in WebGL's words, and arrays of floats."""

import json
import struct

import numpy as np

import plumbline

MOST_CORNERS = 300_000
COMPARES = {"less_equal": "LEQUAL", "greater_equal": "GEQUAL", "not_equal": "NOTEQUAL"}
STENCIL_OPS = {"increment": "INCR", "increment_wrap": "INCR_WRAP", "decrement": "DECR", "decrement_wrap": "DECR_WRAP"}
EQUATIONS = {"add": "FUNC_ADD", "subtract": "FUNC_SUBTRACT", "reverse_subtract": "FUNC_REVERSE_SUBTRACT"}
COMPARE_NAMES = ("never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always")
FOG_MODES = ("linear", "exp", "exp2")
ENVIRONMENTS = ("replace", "modulate", "decal", "blend", "add")
FORMATS = ("alpha", "luminance", "luminance_alpha", "intensity", "rgb", "rgba")


def require(holds, reason):
    if not holds:
        raise plumbline.Unsupported(reason)


def word(text, words):
    """WebGL's word for an enumerator of the export."""
    return words.get(text) or text.upper().replace("SOURCE", "SRC").replace("DESTINATION", "DST")


class Arrays:
    """Arrays of floats, one after the other."""

    def __init__(self):
        self.parts, self.count = [], 0

    def add(self, values):
        """Index of the first."""
        values = np.ascontiguousarray(values, "<f4").ravel()
        self.parts.append(values)
        self.count += values.size
        return self.count - values.size


def texture_of(scene, number, arrays):
    texture = scene["textures"][number]
    require("clamp_to_border" not in (texture["wrap_s"], texture["wrap_t"]), "texture borders")
    levels = [[width, height, arrays.add(scene.array(f"textures.{number}.{level}"))]
              for level, (width, height) in enumerate(texture["levels"])]
    integers = {"MIN_FILTER": texture["min"].upper(), "MAG_FILTER": texture["mag"].upper(),
                "WRAP_S": texture["wrap_s"].upper(), "WRAP_T": texture["wrap_t"].upper(),
                "BASE_LEVEL": texture["base_level"], "MAX_LEVEL": min(texture["max_level"], len(levels) - 1)}
    return {"levels": levels, "integers": integers,
            "floats": {"MIN_LOD": texture["min_lod"], "MAX_LOD": texture["max_lod"]}}


def uniforms_of(scene, draw):
    """As draw.glsl has them: 20 words of 4 bytes."""
    fog, texture, alpha = draw["fog"], draw["texture"], draw["alpha_test"]
    of = scene["textures"][texture["texture"]] if texture else None
    floats = (texture["color"] if texture else [0] * 4) + (fog["color"] + [0] if fog else [0] * 4)
    floats += [fog["density"], fog["start"], fog["end"], 0] if fog else [0] * 4
    return struct.pack(
        "<12f5i3f", *floats, 1 + FOG_MODES.index(fog["mode"]) if fog else 0,
        1 + ENVIRONMENTS.index(texture["environment"]) if texture else 0, FORMATS.index(of["format"]) if of else 0,
        draw["lit"] and scene["light_model"]["separate_specular"],
        COMPARE_NAMES.index(alpha["func"]) if alpha else 7, alpha["reference"] if alpha else 0, draw["point_size"],
        of["lod_bias"] if of else 0)


def corners_of(scene, draw):
    """24 floats for each corner of each primitive: a flat one has its last corner's colours."""
    indices = scene.array(f"meshes.{draw['mesh']}.indices")
    of_each = {"points": 1, "lines": 2, "triangles": 3}[draw["topology"]]
    indices = indices[:, :of_each].astype(np.int64)
    require(indices.size <= MOST_CORNERS, "more than 300000 corners")
    lit = np.repeat(indices[:, -1:], of_each, 1) if draw["shading"] == "flat" else indices
    at, lit = indices.ravel() + draw["first_vertex"], lit.ravel() + draw["first_vertex"]
    out = np.zeros((at.size, 24), np.float32)
    out[:, 0:4] = scene.array("vertex.p_clip")[at]
    color = scene.array("light.color")
    back, second, back_second = (scene.array(f"varyings.{name}.vertices.value")
                                 for name in ("back_color", "secondary", "back_secondary"))
    out[:, 4:8], out[:, 8:12] = color[lit], (color if back is None else back)[lit]
    if second is not None:
        out[:, 12:16], out[:, 16:20] = second[lit], (second if back_second is None else back_second)[lit]
    texcoords = scene.array(f"meshes.{draw['mesh']}.texcoords")
    if texcoords is not None:
        out[:, 20:22] = texcoords[indices.ravel()]
    out[:, 22] = scene.array("vertex.p_eye")[at, 2]
    return out


def draw_of(scene, draw, arrays, blank):
    require(not draw["lit"] or draw["shading"] != "phong", "light per fragment")
    require(draw["front_mode"] == draw["back_mode"] == "fill", "polygon modes")
    require(draw["logic_op"] is None, "logic op")
    require(draw["line_width"] == 1, "wide lines")
    near, far = draw["depth_range"]
    require(near <= far, "a depth range that is turned over")
    stencil, blend = draw["stencil"], draw["blend"]

    def face_of(face):
        ops = {key: word(face[key], STENCIL_OPS) for key in ("fail", "depth_fail", "pass")}
        return {**face, **ops, "func": word(face["func"], COMPARES)}

    def term_of(term):
        return {key: word(value, EQUATIONS if key == "equation" else {}) for key, value in term.items()}

    stencils = stencil and {side.upper(): face_of(stencil[side]) for side in ("front", "back")}
    if stencils:  # WebGL wants one reference and one mask for both sides
        for key in ("reference", "mask", "write_mask"):
            require(stencils["FRONT"][key] == stencils["BACK"][key], "stencil sides that differ in " + key)
    if blend:
        for term in (blend["rgb"], blend["alpha"]):
            factors = term["source"] + term["destination"]
            require("constant_color" not in factors or "constant_alpha" not in factors, "constant colour with constant alpha")
    corners = corners_of(scene, draw)
    return {"cull": None if draw["cull"] == "none" else draw["cull"].upper(),
            "depth_func": word(draw["depth_func"], COMPARES), "depth_mask": draw["depth_mask"],
            "depth_range": [near, far],
            "polygon_offset": [draw["polygon_offset"]["factor"], draw["polygon_offset"]["units"]],
            "color_mask": draw["color_mask"], "scissor": draw["scissor"], "stencil": stencils,
            "blend": blend and {"rgb": term_of(blend["rgb"]), "alpha": term_of(blend["alpha"]), "color": blend["color"]},
            "topology": draw["topology"].upper(), "first": arrays.add(corners), "count": len(corners),
            "uniforms": 4 * arrays.add(np.frombuffer(uniforms_of(scene, draw), "<f4")),
            "texture": draw["texture"]["texture"] if draw["texture"] else blank}


def prepare(scene):
    """The bytes that draw.js reads: the length of a JSON object, the object, and floats."""
    frame = scene["frame"]
    require(frame["color"] in ("rgba8", "rgba32f"), frame["color"])
    require(frame["depth"] in ("z16", "z24", "z32f"), frame["depth"])
    require(frame["depth"] != "z16" or frame["stencil"] == "none", "z16 with stencil")
    require(not frame["depth_clamp"], "no near and far plane")
    require(frame["sample"] == [0, 0], "samples off the pixels' centres")
    arrays = Arrays()
    textures = [texture_of(scene, number, arrays) for number in range(len(scene["textures"]))]
    blank = {"levels": [[1, 1, arrays.add([1, 1, 1, 1])]], "integers": {"MIN_FILTER": "NEAREST"}, "floats": {}}
    state = {key: frame[key] for key in ("width", "height", "color", "depth", "clear_color", "clear_depth", "clear_stencil")}
    state["draws"] = [draw_of(scene, draw, arrays, len(textures)) for draw in scene["draws"]]
    state["textures"] = textures + [blank]
    text = json.dumps(state).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<I", len(text)) + text + np.concatenate(arrays.parts).tobytes()
