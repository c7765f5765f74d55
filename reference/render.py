"""Renders an exported scene with Mitsuba 3 into one EXR with the layers that `catoptric check` reads.

    catoptric export SCENE --mitsuba DIR
    python render.py DIR -o FILE.exr

Colour comes from Mitsuba's own `path` integrator. The other layers come from following the same
rays one by one, through each pixel's centre, with Mitsuba's camera, intersections, mirrors and
spawned rays; nothing in here intersects or reflects anything itself. The colours at the ends of
these paths must be the integrator's, or nothing is written.

World space, right-handed, +y up; row 0 is the top of the picture.
"""

import argparse
import json
import os
import platform
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

VARIANT = "scalar_rgb"

# Codes of the layer `reflected.status`.
RESOLVED, BELOW, BACK = 1, 3, 4

# The integrator's rays are those followed here but for float32's rounding of the pixel centre. So
# colours agree within COLOR_TOLERANCE, but for one pixel in MOST_FLIPPED where an edge passes.
COLOR_TOLERANCE = 1e-3
MOST_FLIPPED = 1000

CHANNELS = (
    "R G B primary.id primary.position.X primary.position.Y primary.position.Z "
    "primary.normal.X primary.normal.Y primary.normal.Z reflected.status reflected.id "
    "reflected.position.X reflected.position.Y reflected.position.Z reflected.distance "
    "reflected.direction.X reflected.direction.Y reflected.direction.Z bounces"
).split()


def main():
    args = arguments()
    mi.set_variant(VARIANT)
    about = json.loads((args.folder / "scene.json").read_text())
    width, height = args.resolution or about["resolution"]
    bounces = args.bounces or about["bounces"]
    scene = mi.load_file(
        str(args.xml or args.folder / "scene.xml"),
        optimize=False,
        width=width,
        height=height,
        samples=args.samples,
        max_depth=bounces + 1,
    )
    color = np.array(mi.render(scene))[:, :, :3]
    if args.samples == 1:
        pixels, counts = follow_all(scene, about["ids"], width, height, bounces, color)
        pixels[:, :, :3] = color
        names = CHANNELS
    else:
        pixels, counts, names = color, None, ["R", "G", "B"]
    write(args.output, pixels, names, about["ids"])
    sidecar = {
        "format": 1,
        "scene": about["scene"],
        "scene_hash": about["scene_hash"],
        "renderer": "Mitsuba",
        "version": mi.__version__,
        "variant": VARIANT,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "settings": {
            "resolution": [width, height],
            "samples": args.samples,
            "bounces": bounces,
            "integrator": "path",
            "sampler": "stratified, jitter off",
            "filter": "box",
        },
        "counts": counts,
    }
    write_text(args.output.with_suffix(".json"), json.dumps(sidecar, indent=2) + "\n")
    print(f"{args.output}: {width}x{height}, {counts or 'colour only'}", file=sys.stderr)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=Path, help="what `catoptric export --mitsuba` wrote")
    parser.add_argument("-o", "--output", type=Path, required=True, help="FILE.exr to write")
    parser.add_argument(
        "--xml", type=Path, help="render this scene file, whose shapes have the same ids, instead"
    )
    parser.add_argument("--resolution", type=resolution, metavar="WxH", help="default: the scene's")
    parser.add_argument("--bounces", type=positive, help="reflections; default: the export's")
    parser.add_argument(
        "--samples",
        type=square,
        default=1,
        help="rays a pixel, a square number; more than 1: a regular grid, colour only",
    )
    args = parser.parse_args()
    for name in ("scene.xml", "scene.json"):
        if not (args.folder / name).is_file():
            parser.error(f"{args.folder / name}: no such file; export the scene first")
    if args.output.suffix != ".exr":
        parser.error(f"{args.output}: must end in .exr")
    if not args.output.resolve().parent.is_dir():
        parser.error(f"{args.output}: its folder does not exist")
    return args


def positive(text):
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def square(text):
    number = positive(text)
    if round(number**0.5) ** 2 != number:
        raise ValueError(text)
    return number


def resolution(text):
    width, height = text.split("x")
    return positive(width), positive(height)


def follow_all(scene, ids, width, height, bounces, color):
    """All layers of all pixels, and how many pixels are of which kind."""
    owner = {shape: entry for entry in ids for shape in entry["shapes"]}
    pixels = np.zeros((height, width, len(CHANNELS)), np.float32)
    counts = {"mirror": 0, "below": 0, "back": 0, "self": 0}
    flipped = 0
    for y in range(height):
        for x in range(width):
            ray, _ = scene.sensors()[0].sample_ray(
                0, 0.5, ((x + 0.5) / width, (y + 0.5) / height), (0.5, 0.5)
            )
            layers, kinds, end = follow(scene, owner, ray, bounces)
            for name, value in layers.items():
                at = CHANNELS.index(name if name in CHANNELS else name + ".X")
                pixels[y, x, at : at + np.size(value)] = value
            for kind in kinds:
                counts[kind] += 1
            # Below its surface a path has no meaning; the integrator goes on all the same.
            if "below" not in kinds and np.abs(end - color[y, x]).max() > COLOR_TOLERANCE:
                flipped += 1
    if flipped * MOST_FLIPPED > width * height:
        sys.exit(f"{flipped} pixels were rendered in another colour than their paths end in")
    return pixels, counts


def follow(scene, owner, ray, bounces):
    """One path: the layers of its pixel that are not zero, what kinds of pixel it is (`mirror`;
    `below`, `back`; `self`: the first reflected ray meets its own mirror), and its colour."""
    hit = scene.ray_intersect(ray)
    if not hit.is_valid():
        return {}, set(), radiance(scene, hit)
    entry = owner[hit.shape.id()]
    layers = {"primary.id": entry["id"], "primary.position": hit.p}
    if entry["kind"] == "object":
        layers["primary.normal"] = hit.n if dot(hit.n, ray.d) < 0 else -hit.n
        return layers, set(), radiance(scene, hit)

    layers |= {"primary.normal": hit.sh_frame.n, "reflected.status": RESOLVED}
    kinds, black, reflected = {"mirror"}, np.zeros(3), {}
    for count in range(bounces):
        status, direction = reflect(hit, ray)
        if status == BELOW or (status == BACK and count == 0):
            # Counted apart: nothing is reflected, whatever was met on the way.
            kinds.add("below" if status == BELOW else "back")
            return layers | {"reflected.status": status, "bounces": count}, kinds, black
        if status == BACK:
            break
        start, ray = hit.p, hit.spawn_ray(direction)
        hit = scene.ray_intersect(ray)
        layers["bounces"] = count + 1
        if count == 0:
            layers["reflected.direction"] = direction
        if not hit.is_valid():
            return layers, kinds, radiance(scene, hit)
        before, entry = entry, owner[hit.shape.id()]
        if count == 0 and entry is before:
            kinds.add("self")
        reflected = {
            "reflected.id": entry["id"],
            "reflected.position": hit.p,
            "reflected.distance": np.linalg.norm(np.array(hit.p) - np.array(start)),
        }
        if entry["kind"] == "object":
            return layers | reflected, kinds, radiance(scene, hit)
    return layers | reflected, kinds, black


def reflect(hit, ray):
    """What a mirror does with a ray: a status and the reflected direction in world space.

    Mitsuba reflects about the shading normal and never asks about the surface itself. A ray that
    meets the surface's back is BACK; one sent to the other side of it by the shading normal, or
    that meets the shading normal's back, is BELOW.
    """
    geometric = hit.n if dot(hit.n, hit.sh_frame.n) > 0 else -hit.n
    if dot(geometric, ray.d) >= 0:
        return BACK, None
    sample, _ = hit.bsdf(ray).sample(mi.BSDFContext(), hit, 0.5, (0.5, 0.5))
    if hit.wi.z <= 0:
        return BELOW, None
    direction = hit.to_world(sample.wo)
    if dot(geometric, direction) <= 0:
        return BELOW, None
    return RESOLVED, direction


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def radiance(scene, hit):
    """Colour of an unlit surface or, where nothing is met, of the background."""
    emitter = hit.emitter(scene)
    return np.zeros(3) if emitter is None else np.array(emitter.eval(hit))


def write(path, pixels, names, ids):
    """One part, scanlines, 32-bit floats, lossless; there whole or not at all."""
    bitmap = mi.Bitmap(
        np.ascontiguousarray(pixels, np.float32),
        pixel_format=mi.Bitmap.PixelFormat.MultiChannel,
        channel_names=list(names),
    )
    lines = (f"{entry['id']} {entry['kind']} {entry['name']}\n" for entry in ids)
    bitmap.metadata()["catoptric.ids"] = "".join(lines)
    part = path.with_name(path.name + ".part.exr")
    bitmap.write(str(part))
    os.replace(part, path)


def write_text(path, text):
    part = path.with_name(path.name + ".part")
    part.write_text(text)
    os.replace(part, path)


if __name__ == "__main__":
    main()
