"""Compares every SVG that has a DXF beside it: the same curves on the same layers, in the same
order within a layer, to 0.001 mm. Every SVG is rendered and has its true size.

usage: same_drawing.py FOLDER
"""
import glob
import io
import math
import os
import sys
import xml.etree.ElementTree as ET

import ezdxf
import numpy as np
import resvg_py
import shapely
from PIL import Image
from shapely.geometry import LineString, Point
from svgelements import Arc, Close, Line, Move, Path

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
Image.MAX_IMAGE_PIXELS = None
DPI = 20


def svg_curves(path):
    """Curves of each layer as lists of points, y up."""
    root = ET.parse(path).getroot()
    width, height = (float(root.get(k).removesuffix("mm")) for k in ("width", "height"))
    assert root.get("viewBox") == f"0 0 {root.get('width')[:-2]} {root.get('height')[:-2]}"
    layers = {}
    for group in root.findall(SVG + "g"):
        name = group.get("id")
        assert group.get(INKSCAPE + "label") == name and group.get(INKSCAPE + "groupmode") == "layer"
        curves = layers.setdefault(name, [])
        for element in group:
            assert not {"transform", "class", "style"} & set(element.keys())
            if element.tag == SVG + "circle":
                cx, cy, r = (float(element.get(k)) for k in ("cx", "cy", "r"))
                # Chords stay within 0.0002 mm of it.
                quarter = math.ceil(40 * math.sqrt(r)) + 4
                curves.append(list(Point(cx, height - cy).buffer(r, quarter).exterior.coords))
            else:
                for sub in Path(element.get("d")).as_subpaths():
                    curves.append(points(Path(sub), height))
    return (width, height), layers


def points(path, height):
    out = []
    for segment in path:
        if isinstance(segment, Move):
            out.append(segment.end)
        elif isinstance(segment, (Line, Close)):
            if segment.end is not None:
                out.append(segment.end)
        elif isinstance(segment, Arc):
            # Chords of a half circle stay within 0.0002 mm of it.
            count = math.ceil(100 * math.sqrt(segment.rx)) + 4
            out.extend(segment.npoint(np.linspace(0, 1, count + 1)[1:]))
        else:
            raise AssertionError(type(segment))
    return [(p[0], height - p[1]) for p in out]


def dxf_curves(path):
    layers = {}
    for e in ezdxf.readfile(path).modelspace():
        layers.setdefault(e.dxf.layer, []).append(flat(e))
    return layers


def flat(e):
    """Points of an entity on its true curve (ezdxf's paths approximate arcs by splines)."""
    if e.dxftype() == "LINE":
        return [tuple(e.dxf.start)[:2], tuple(e.dxf.end)[:2]]
    if e.dxftype() == "CIRCLE":
        return [(p.x, p.y) for p in e.flattening(0.0002)]
    out = [tuple(e.get_points("xy")[0])]
    for piece in e.virtual_entities():
        if piece.dxftype() == "LINE":
            chain = [tuple(piece.dxf.start)[:2], tuple(piece.dxf.end)[:2]]
        else:
            chain = [(p.x, p.y) for p in piece.flattening(0.0002)]
        if math.dist(chain[-1], out[-1]) < math.dist(chain[0], out[-1]):
            chain.reverse()
        assert math.dist(chain[0], out[-1]) < 1e-6
        out.extend(chain[1:])
    return out


def far(a, b):
    """Largest distance of some forty points of one curve from the other."""
    return shapely.distance(LineString(b), shapely.points(a[:: max(1, len(a) // 40)])).max()


def compare(svg, dxf):
    size, left = svg_curves(svg)
    right = dxf_curves(dxf)
    assert left.keys() == right.keys(), (left.keys(), right.keys())
    count = 0
    for name, curves in left.items():
        assert len(curves) == len(right[name]), (name, len(curves), len(right[name]))
        for a, b in zip(curves, right[name]):
            distance = max(far(a, b), far(b, a))
            assert distance < 0.001, (svg, name, distance)
        count += len(curves)
    return count


def render(path):
    """Renders a picture at its own size and checks that it has that size and is not empty."""
    text = open(path, encoding="utf-8").read()
    root = ET.fromstring(text.encode())
    png = bytes(resvg_py.svg_to_bytes(svg_string=text, background="white", dpi=DPI))
    image = Image.open(io.BytesIO(png))
    for pixels, name in zip(image.size, ("width", "height")):
        true = float(root.get(name).removesuffix("mm")) / 25.4 * DPI
        assert abs(pixels - true) <= 1, (path, name, pixels, true)
    low, high = image.convert("L").getextrema()
    return low < 250


def main(folder):
    pairs = pictures = 0
    for svg in sorted(glob.glob(os.path.join(folder, "**", "*.svg"), recursive=True)):
        dxf = svg[:-3] + "dxf"
        if os.path.exists(dxf):
            assert compare(svg, dxf) > 5
            pairs += 1
        if os.path.getsize(svg) < 3_000_000:
            # Hairlines vanish in pixels; drawings for people must show.
            assert render(svg) or os.path.exists(dxf), svg
            pictures += 1
    print(pairs, pictures)


main(sys.argv[1])
