"""plumbline's kit for Python 3 with numpy: reads what `plumb export` writes, writes a capture, and is the server that
plumb calls. One file. MIT licence. src/kit/README.md lists the arrays and the state.

    import plumbline

    def draw(scene, out):
        if scene["draws"][0]["fog"]:
            raise plumbline.Unsupported("fog")
        positions = scene.array("meshes.0.positions")
        ...
        out.plane("color", rgba)  # height x width x 4, in [0,1]
        out.plane("depth", z)     # height x width, window z

    plumbline.main("mine", draw)

plumb diagnose SCENE --program 'python3 mine.py {input} {output}'    one process per scene
plumb check SCENES --program 'python3 mine.py {serve}'               one process for all scenes
"""

import json
import os
import sys

import numpy as np

UNSUPPORTED_STATUS = 77

_DTYPES = {"f32": "<f4", "f64": "<f8", "u8": "u1", "u16": "<u2", "u32": "<u4", "u64": "<u8", "i32": "<i4"}
_PLANES = {"count": "u32", "id_sum": "u64", "id": "i32", "texel": "f32", "shaded": "f32", "color": "f32",
           "stencil": "u8", "depth": "f64"}


class Unsupported(Exception):
    """The scene cannot be drawn, for this reason."""


class Scene(dict):
    """The manifest of an export, and its arrays."""

    def __init__(self, folder):
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            super().__init__(json.load(file))
        if self.get("format") != "plumbline export":
            raise ValueError(f"{folder}: expected a plumbline export, found {self.get('format')!r}")
        if self.get("version") != 1:
            raise ValueError(f"{folder}: expected a plumbline export of version 1, found {self.get('version')!r}")
        self._folder = folder
        self._arrays = {array["name"]: array for array in self["arrays"]}

    def array(self, name):
        """The array, in the shape that src/kit/README.md says; None: there is none."""
        entry = self._arrays.get(name)
        if entry is None:
            return None
        return np.fromfile(os.path.join(self._folder, entry["file"]), _DTYPES[entry["dtype"]]).reshape(entry["shape"])


class Capture:
    """What a renderer hands out for a scene."""

    def __init__(self, folder, renderer, scene):
        self._folder = folder
        self._manifest = {"format": "plumbline capture", "version": 1, "renderer": renderer,
                          "width": scene["frame"]["width"], "height": scene["frame"]["height"],
                          "byte_order": "little", "arrays": []}

    def array(self, name, dtype, values):
        """Writes an array; dtype is f32 f64 u8 u16 u32 u64 or i32."""
        values = np.ascontiguousarray(values, _DTYPES[dtype])
        file = name + ".bin"
        values.tofile(os.path.join(self._folder, file))
        self._manifest["arrays"].append({"name": name, "dtype": dtype, "shape": list(values.shape), "file": file})

    def plane(self, name, values):
        """Writes a plane, rows in the scene's order: count, id_sum, id, texel, shaded, color, stencil, depth."""
        self.array("planes." + name, _PLANES[name], values)

    def finish(self):
        """Writes the manifest."""
        with open(os.path.join(self._folder, "manifest.json"), "w", encoding="utf-8") as file:
            json.dump(self._manifest, file)


def run(source, target, renderer, draw):
    """Draws the export in the folder `source`, and leaves the capture in the folder `target`."""
    scene = Scene(source)
    capture = Capture(target, renderer, scene)
    draw(scene, capture)
    capture.finish()


def main(renderer, draw):
    """Draws the scene of the command line (INPUT OUTPUT), or, given --serve, those that stdin names: "INPUT<tab>OUTPUT"
    a line, answered on stdout by "ok", "unsupported REASON" or "failed REASON"; all prints then go to stderr."""
    arguments = sys.argv[1:]
    if len(arguments) == 2:
        try:
            return run(*arguments, renderer, draw)
        except Unsupported as reason:
            print(reason, file=sys.stderr)
            sys.exit(UNSUPPORTED_STATUS)
    if arguments != ["--serve"]:
        sys.exit(f"usage: {sys.argv[0]} INPUT OUTPUT, or {sys.argv[0]} --serve")
    answers, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        source, tab, target = line.rstrip("\n").partition("\t")
        if not tab:
            sys.exit(f"stdin: expected INPUT<tab>OUTPUT, found {line!r}")
        try:
            run(source, target, renderer, draw)
            answer = "ok"
        except Unsupported as reason:
            answer = f"unsupported {reason}"
        except Exception as error:  # one scene's; the next may be drawn
            answer = f"failed {type(error).__name__}: {error}"
        print(" ".join(answer.split()), file=answers, flush=True)
    return None
