"""Reads cut files with ezdxf and shapely and compares them with the plan.

usage: cut_files.py FOLDER   (with plan.json, settings.json and fabrication/*.dxf)
"""
import glob
import json
import math
import os
import sys

import ezdxf
from ezdxf.math import Vec3
from ezdxf.path import make_path
from shapely.geometry import LineString, Point, Polygon
from shapely.strtree import STRtree

MM = 1000.0
EPS = 1e-6
CUT_LAYERS = {"GUIDE", "ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER"}


def read(path):
    """A DXF that ezdxf reads strictly and audits without error or fix."""
    doc = ezdxf.readfile(path)
    audit = doc.audit()
    assert not audit.errors, (path, audit.errors[0].message)
    assert not audit.fixes, (path, audit.fixes[0].message)
    assert doc.dxfversion == "AC1015", doc.dxfversion
    assert doc.header["$INSUNITS"] == 4 and doc.header["$MEASUREMENT"] == 1
    assert doc.header["$PSVPSCALE"] == 1.0
    entities = list(doc.modelspace())
    kinds = {e.dxftype() for e in entities}
    assert kinds <= {"LWPOLYLINE", "CIRCLE", "LINE"}, kinds
    used = {e.dxf.layer for e in entities}
    assert used <= {layer.dxf.name for layer in doc.layers}, used
    for e in entities:
        assert e.dxf.color == 256 and e.dxf.lineweight == -1, "colour and weight by layer"
        assert e.dxf.owner == doc.modelspace().block_record_handle
    low, high = extents(entities)
    for name, point in (("$EXTMIN", low), ("$EXTMAX", high)):
        stored = doc.header[name]
        assert max(abs(stored[k] - point[k]) for k in range(2)) < EPS, (name, stored, point)
    limits = doc.header["$LIMMAX"]
    assert min(low) > -EPS and all(high[k] < limits[k] + EPS for k in range(2))
    raw = open(path, "rb").read()
    assert raw.count(b"\n") == raw.count(b"\r\n") and raw.isascii()
    return doc, entities


def extents(entities):
    """Lowest and highest coordinates of lines and true arcs."""
    points = []
    for e in entities:
        pieces = list(e.virtual_entities()) if e.dxftype() == "LWPOLYLINE" else [e]
        for piece in pieces:
            if piece.dxftype() == "LINE":
                points += [piece.dxf.start, piece.dxf.end]
                continue
            center, radius = piece.dxf.center, piece.dxf.radius
            angles = [0, 90, 180, 270]
            if piece.dxftype() == "ARC":
                start = piece.dxf.start_angle
                sweep = (piece.dxf.end_angle - start) % 360
                angles = [start, start + sweep] + [a for a in angles if (a - start) % 360 <= sweep]
            points += [center + Vec3.from_deg_angle(a, radius) for a in angles]
    return tuple(tuple(pick(p[k] for p in points) for k in range(2)) for pick in (min, max))


def slot(e):
    """First and last centre and the radius of a slot drawn as two lines and two half circles."""
    points = e.get_points("xyb")
    assert e.closed and len(points) == 4
    assert [p[2] for p in points] == [0, 1, 0, 1], points
    (ax, ay, _), (bx, by, _), (cx, cy, _), (dx, dy, _) = points
    radius = (cy - by) / 2
    assert abs((dy - ay) / 2 - radius) < EPS and abs(ax - dx) < EPS and abs(bx - cx) < EPS
    return ax, bx, (by + cy) / 2, radius


def contour(e, tolerance=0.002):
    """A closed contour as a polygon."""
    if e.dxftype() == "CIRCLE":
        return Point(e.dxf.center.x, e.dxf.center.y).buffer(e.dxf.radius, 64)
    assert e.closed, "cuts are closed"
    polygon = Polygon([(p.x, p.y) for p in make_path(e).flattening(tolerance)])
    assert polygon.is_valid and polygon.area > 0
    return polygon


def engraving(e):
    return LineString([(p.x, p.y) for p in make_path(e).flattening(0.01)])


def check_sheet(path, sheet, lamellae, settings):
    doc, entities = read(path)
    assert {e.dxf.layer for e in entities} <= CUT_LAYERS
    for layer in doc.layers:
        if layer.dxf.name in CUT_LAYERS:
            assert layer.dxf.lineweight == 0
    kerf = settings["kerf"] * MM
    cuts = [e for e in entities if e.dxf.layer in ("CUT_INNER", "CUT_OUTER")]
    inner = [e for e in cuts if e.dxf.layer == "CUT_INNER"]
    outer = [e for e in cuts if e.dxf.layer == "CUT_OUTER"]

    # Every part of the plan is there with its true outline and openings.
    circles = [(e.dxf.center.x, e.dxf.center.y, e.dxf.radius) for e in inner if e.dxftype() == "CIRCLE"]
    slots = [slot(e) for e in inner if e.dxftype() == "LWPOLYLINE"]
    outlines = [slot(e) for e in outer]
    expected_circles, expected_slots, expected_outlines = [], [], []
    for place in sheet["parts"]:
        part = lamellae[place["part"]]
        x, y = place["x"] * MM, place["y"] * MM + part["width"] * MM / 2
        half = part["width"] * MM / 2
        expected_outlines.append((x + half, x + part["length"] * MM - half, y, half + kerf / 2))
        for o in part["openings"]:
            at = lambda s: x + (part["end_margin"] + s) * MM
            radius = (o["diameter"] * MM - kerf) / 2
            if o["kind"] == "hole":
                expected_circles.append((at(o["at"]), y, radius))
            else:
                low, high = sorted((at(o["from"]), at(o["to"])))
                if high - low < 0.01:
                    expected_circles.append(((low + high) / 2, y, radius))
                else:
                    expected_slots.append((low, high, y, radius))
    for name, found, expected in (
        ("circles", circles, expected_circles),
        ("slots", slots, expected_slots),
        ("outlines", outlines, expected_outlines),
    ):
        assert len(found) == len(expected), (name, len(found), len(expected))
        rounded = lambda values: tuple(round(v, 4) for v in values)
        for a, b in zip(sorted(found, key=rounded), sorted(expected, key=rounded)):
            assert max(abs(p - q) for p, q in zip(a, b)) < 1e-6, (name, a, b)

    # Openings lie strictly inside one outline; outlines keep their distance.
    parts = [contour(e) for e in outer]
    tree = STRtree(parts)
    owners = []
    for e in inner:
        hole = contour(e)
        owner = [i for i in tree.query(hole) if parts[i].contains(hole)]
        assert len(owner) == 1, "an opening belongs to one part"
        assert hole.distance(parts[owner[0]].exterior) > settings["least_web"]
        owners.append(owner[0])
    gap = settings["spacing"] * MM - kerf
    for i, a in enumerate(parts):
        for j in tree.query(a.buffer(gap + 1)):
            if j != i:
                assert a.distance(parts[j]) > gap - 1e-3, "parts too close"

    # Openings are cut before the outline around them, engraving comes before both.
    position = {id(e): n for n, e in enumerate(entities)}
    for e, owner in zip(inner, owners):
        assert position[id(e)] < position[id(outer[owner])]

    # Engraving stays on its part, off openings.
    holes = [contour(e) for e in inner]
    hole_tree = STRtree(holes)
    for e in entities:
        if e.dxf.layer == "ENGRAVE":
            line = engraving(e)
            owner = [i for i in tree.query(line) if parts[i].contains(line)]
            assert len(owner) == 1, "a stroke belongs to one part"
            assert position[id(e)] < position[id(outer[owner[0]])]
            for i in hole_tree.query(line.buffer(0.5)):
                assert line.distance(holes[i]) > 0.5, "a stroke runs into an opening"

    # No segment is cut twice.
    seen = set()
    for e in cuts:
        if e.dxftype() == "CIRCLE":
            keys = [("circle",) + tuple(round(v * 1000) for v in (e.dxf.center.x, e.dxf.center.y, e.dxf.radius))]
        else:
            p = [(round(x * 1000), round(y * 1000), b) for x, y, b in e.get_points("xyb")]
            keys = []
            for (x0, y0, b), (x1, y1, _) in zip(p, p[1:] + p[:1]):
                ends = sorted([(x0, y0), (x1, y1)])
                keys.append(("segment", *ends, 0 if b == 0 else 1, (x0, y0) < (x1, y1) if b else False))
        for key in keys:
            assert key not in seen, ("cut twice", key)
            seen.add(key)
    return len(outer), len(slots), len(circles)


def main(folder):
    plan = json.load(open(os.path.join(folder, "plan.json")))
    settings = json.load(open(os.path.join(folder, "settings.json")))
    lamellae = {l["id"]: l for l in plan["lamellae"]}
    total = [0, 0, 0]
    files = sorted(glob.glob(os.path.join(folder, "fabrication", "*.dxf")))
    sheets = {s["id"]: s for s in plan["sheets"]}
    cut = [f for f in files if "sheet-" in os.path.basename(f)]
    assert len(cut) == len(sheets)
    for path in cut:
        name = [s for s in sheets if s in os.path.basename(path)]
        counts = check_sheet(path, sheets[name[0]], lamellae, settings)
        total = [a + b for a, b in zip(total, counts)]
    for path in glob.glob(os.path.join(folder, "**", "*.dxf"), recursive=True):
        if path not in cut:
            read(path)
    print(*total)


main(sys.argv[1])
