#!/usr/bin/env python3
"""Another renderer in a hundred lines: the built-in scene `sphere-square`, with the layers that
`catoptric diff` judges.

    pip install numpy OpenEXR
    catoptric reference sphere-square --resolution 320x240 -o truth.exr
    python3 examples/write_layers.py 320 240 mine.exr
    catoptric diff truth.exr mine.exr

The layers, their units and spaces: the page `layers` of the documentation of the crate `catoptric-frame`.
"""

import sys

import numpy as np
import OpenEXR

EYE = np.array([0.6, 1.1, 4.2])
TARGET = np.array([0.0, -0.12, 0.0])
FOV_Y = np.radians(36.0)
ZENITH, HORIZON, NADIR = np.array([[0.08, 0.22, 0.55], [0.55, 0.68, 0.80], [0.05, 0.05, 0.06]])
A, B, CELLS = np.array([0.85, 0.16, 0.08]), np.array([0.92, 0.88, 0.76]), 12
SQUARE, BALL = 1, 2  # ids: objects first, then mirrors


def normalized(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def dot(a, b):
    return np.sum(a * b, axis=-1)


def square(origin, direction):
    """Distance to the square, and its colour there: [-1, 1] squared in xz, scaled, turned, moved."""
    turn = np.radians(18.0)
    right = np.array([np.cos(turn), 0.0, -np.sin(turn)])
    back = np.array([np.sin(turn), 0.0, np.cos(turn)])
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (-1.1 - origin[..., 1]) / direction[..., 1]
        local = origin + t[..., None] * direction - np.array([0.1, -1.1, 1.6])
        x, z = dot(local, right) / 0.8, dot(local, back) / 0.8
    hit = (t > 1e-9) & (np.abs(x) <= 1.0) & (np.abs(z) <= 1.0)
    t = np.where(hit, t, np.inf)
    # Texture coordinates run from 0 to 1 along x, and against z.
    u, v = (np.where(hit, x, 0.0) + 1.0) / 2.0, (1.0 - np.where(hit, z, 0.0)) / 2.0
    even = (np.floor(u * CELLS) + np.floor(v * CELLS)) % 2 == 0
    return t, np.where(even[..., None], A, B)


def ball(origin, direction):
    """Distance to the unit sphere at the origin."""
    b, c = dot(origin, direction), dot(origin, origin) - 1.0
    d = b * b - c
    t = -b - np.sqrt(np.maximum(d, 0.0))
    return np.where((d > 0.0) & (t > 1e-9), t, np.inf)


def sky(direction):
    up = direction[..., 1:2]
    return HORIZON + np.abs(up) * (np.where(up >= 0.0, ZENITH, NADIR) - HORIZON)


def main(width, height, path):
    forward = normalized(TARGET - EYE)
    right = normalized(np.cross(forward, [0.0, 1.0, 0.0]))
    up = np.cross(right, forward)
    tangent = np.tan(FOV_Y / 2.0)
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * tangent * width / height
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * tangent
    direction = normalized(x[None, :, None] * right + y[:, None, None] * up + forward)
    origin = np.broadcast_to(EYE, direction.shape)

    to_ball, (to_square, paint) = ball(origin, direction), square(origin, direction)
    mirror = to_ball < to_square
    seen = np.isfinite(to_square) & ~mirror
    primary_id = np.where(mirror, BALL, np.where(seen, SQUARE, 0))
    t = np.where(mirror, to_ball, np.where(seen, to_square, 0.0))
    point = np.where(primary_id[..., None] > 0, origin + t[..., None] * direction, 0.0)
    facing = np.where(direction[..., 1:2] < 0.0, 1.0, -1.0) * np.array([0.0, 1.0, 0.0])
    normal = np.where(mirror[..., None], point, np.where(seen[..., None], facing, 0.0))

    bounced = normalized(direction - 2.0 * dot(direction, normal)[..., None] * normal)
    distance, reflected_paint = square(point, bounced)
    met = mirror & np.isfinite(distance)
    distance = np.where(met, distance, 0.0)
    reflected = np.where(met[..., None], point + distance[..., None] * bounced, 0.0)

    color = np.where(seen[..., None], paint, sky(direction))
    in_mirror = np.where(met[..., None], reflected_paint, sky(bounced))
    color = np.where(mirror[..., None], in_mirror, color)

    channels = {"R": color[..., 0], "G": color[..., 1], "B": color[..., 2]}
    channels["primary.id"] = primary_id
    channels["reflected.id"] = np.where(met, SQUARE, 0)
    channels["reflected.distance"] = distance
    channels["reflected.status"] = np.where(mirror, 1, 0)
    for layer, vectors in [("primary.position", point), ("primary.normal", normal), ("reflected.position", reflected)]:
        for axis, name in enumerate("XYZ"):
            channels[f"{layer}.{name}"] = vectors[..., axis]
    channels = {name: np.ascontiguousarray(values, dtype=np.float32) for name, values in channels.items()}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, channels).write(path)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
