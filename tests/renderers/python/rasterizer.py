"""A small rasterizer with numpy, as somebody might write it who has never heard of plumbline: triangles in clip space,
with a colour at each corner, into a frame."""

import numpy as np

SUBPIXELS = 256
COMPARES = {"never": lambda z, held: np.zeros_like(z, bool), "less": np.less, "equal": np.equal,
            "less_equal": np.less_equal, "greater": np.greater, "not_equal": np.not_equal,
            "greater_equal": np.greater_equal, "always": lambda z, held: np.ones_like(z, bool)}


def as_codes(values, codes):
    """Numbers in [0,1] as whole codes; codes 0: as they are."""
    return np.rint(np.clip(values, 0, 1) * codes) if codes else values


class Frame:
    """Colour and depth, in codes or, of 0 codes, in float."""

    def __init__(self, width, height, color_codes, depth_codes, clear_color, clear_depth):
        self.width, self.height, self.color_codes, self.depth_codes = width, height, color_codes, depth_codes
        self.color = np.empty((height, width, 4))
        self.color[:] = as_codes(np.array(clear_color), color_codes)
        self.depth = np.full((height, width), as_codes(np.float64(clear_depth), depth_codes))

    def numbers(self):
        """Colour in [0,1], and window z."""
        return self.color / max(self.color_codes, 1), self.depth / max(self.depth_codes, 1)


def clip(polygon, planes):
    """A polygon's corners (clip space position, colour) inside left, right, bottom, top, near, far."""
    for plane in range(planes):
        sign = 1 if plane % 2 == 0 else -1
        inside = [corner[3] + sign * corner[plane // 2] for corner in polygon]
        kept = []
        for i, a in enumerate(polygon):
            b, at_a, at_b = polygon[(i + 1) % len(polygon)], inside[i], inside[(i + 1) % len(polygon)]
            if at_a >= 0:
                kept.append(a)
            if (at_a >= 0) != (at_b >= 0):
                kept.append(a + at_a / (at_a - at_b) * (b - a))
        polygon = kept
        if not polygon:
            break
    return polygon


def area_of(a, b, c):
    """Twice the area of a triangle, positive where it is counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def fill(frame, state, corners):
    """Three corners inside the view volume."""
    near, far = state["depth_range"]
    scale = np.array([frame.width / 2, frame.height / 2, (far - near) / 2])
    move = np.array([frame.width / 2, frame.height / 2, (far + near) / 2])
    if (corners[:, 3] == 0).any():
        return
    win = corners[:, :3] / corners[:, 3:4] * scale + move - [0.5, 0.5, 0]
    grid = np.rint(win[:, :2] * SUBPIXELS) / SUBPIXELS
    area = area_of(*grid)
    if area == 0 or state["cull"] == ("front" if area > 0 else "back"):
        return
    box = state["box"]
    low = np.maximum(np.ceil(grid.min(0)), box[:2]).astype(int)
    high = np.minimum(np.floor(grid.max(0)) + 1, box[2:]).astype(int)
    if (low >= high).any():
        return
    centres = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    covered = np.ones(centres[0].shape, bool)
    for k in range(3):
        begin, end = grid[(k + 1) % 3], grid[(k + 2) % 3]
        d_x, d_y = (end - begin) * np.sign(area)
        e = area_of(begin, end, centres) * np.sign(area)
        covered &= (e > 0) | ((e == 0) & (d_y < 0 or (d_y == 0 and d_x > 0)))
    of = win[:, :2] if area_of(*win[:, :2]) * area > 0 else grid  # else turned over by the grid
    edges = [(of[(k + 1) % 3], of[(k + 2) % 3]) for k in range(3)]
    shares = [area_of(begin, end, centres) / area_of(*of) for begin, end in edges]
    slope = sum(win[k, 2] * np.array([a[1] - b[1], b[0] - a[0]]) for k, (a, b) in enumerate(edges)) / area_of(*of)
    z = sum(shares[k] * win[k, 2] for k in range(3)) + state["offset_factor"] * np.abs(slope).max() + state["offset_units"]
    q = [shares[k] / corners[k, 3] for k in range(3)]
    with np.errstate(divide="ignore", invalid="ignore"):
        color = sum(q[k][..., None] * corners[k, 4:] for k in range(3)) / sum(q)[..., None]
    z = as_codes(np.clip(z, min(near, far), max(near, far)), frame.depth_codes)
    at = np.s_[low[1]:high[1], low[0]:high[0]]
    covered &= COMPARES[state["depth_func"]](z, frame.depth[at])
    if state["depth_mask"]:
        frame.depth[at][covered] = z[covered]
    color = as_codes(np.clip(color, 0, 1), frame.color_codes)
    for c in range(4):
        if state["color_mask"][c]:
            frame.color[at][..., c][covered] = color[..., c][covered]


def draw_triangle(frame, state, corners):
    """Three corners: clip space position and colour, eight numbers each."""
    polygon = clip(list(corners), 4 if state["depth_clamp"] else 6)
    for i in range(2, len(polygon)):
        fill(frame, state, np.array([polygon[i - 1], polygon[i], polygon[0]]))
