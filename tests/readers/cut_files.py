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
from shapely import affinity, union_all
from shapely.geometry import LineString, Point, Polygon, box
from shapely.strtree import STRtree

MM = 1000.0
EPS = 1e-6
# Plans are written to a nanometre; a place is the sum of up to five such numbers.
PLACE = 2.5e-6
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


def curve(e, steps=96):
    """Points on the true curve of an entity; a closed one comes back to its start."""
    if e.dxftype() == "CIRCLE":
        angles = [2 * math.pi * i / (4 * steps) for i in range(4 * steps + 1)]
        return [(e.dxf.center.x + e.dxf.radius * math.cos(a), e.dxf.center.y + e.dxf.radius * math.sin(a)) for a in angles]
    if e.dxftype() == "LINE":
        return [tuple(e.dxf.start)[:2], tuple(e.dxf.end)[:2]]
    vertices = e.get_points("xyb")
    pairs = list(zip(vertices, vertices[1:] + vertices[:1] if e.closed else vertices[1:]))
    points = [vertices[0][:2]]
    for (x0, y0, bulge), (x1, y1, _) in pairs:
        if bulge:
            # The centre lies on the bisector of the chord.
            k = (1 - bulge * bulge) / (4 * bulge)
            cx, cy = (x0 + x1) / 2 - k * (y1 - y0), (y0 + y1) / 2 + k * (x1 - x0)
            radius, start, sweep = math.hypot(x0 - cx, y0 - cy), math.atan2(y0 - cy, x0 - cx), 4 * math.atan(bulge)
            for i in range(1, 2 * steps):
                a = start + sweep * i / (2 * steps)
                points.append((cx + radius * math.cos(a), cy + radius * math.sin(a)))
        points.append((x1, y1))
    return points


def contour(e):
    """A closed contour as a polygon."""
    assert e.dxftype() == "CIRCLE" or e.closed, "cuts are closed"
    polygon = Polygon(curve(e))
    assert polygon.is_valid and polygon.area > 0
    return polygon


def engraving(e):
    return LineString(curve(e, 8))


def expected_parts(plan):
    """Parts of the plan by id: nominal outline and openings (first and last centre, diameter) in the
    part's frame, millimetres."""
    parts = {}
    for lamella in plan["lamellae"]:
        width, length = lamella["width"] * MM, lamella["length"] * MM
        middle = LineString([(width / 2, width / 2), (length - width / 2, width / 2)])
        whole = middle.buffer(width / 2, quad_segs=256)
        openings = []
        for o in lamella["openings"]:
            at = lambda s: (lamella["end_margin"] + s) * MM
            ends = [at(o["at"])] * 2 if o["kind"] == "hole" else sorted((at(o["from"]), at(o["to"])))
            openings.append((*ends, o["diameter"] * MM))
        pieces = lamella["pieces"] or [{"id": lamella["id"], "from": 0, "to": lamella["length"], "joint": None}]
        before = None
        for piece in pieces:
            after = piece["joint"]
            cut, shape = [piece["from"] * MM, piece["to"] * MM], whole
            if pieces[0] is not piece:
                shape = shape.difference(beyond(before, cut[0], width, length, first=False))
            if after:
                shape = shape.difference(beyond(after, cut[1], width, length, first=True))
            x0, _, x1, _ = shape.bounds
            own = [o for o in openings if x0 <= (o[0] + o[1]) / 2 < x1]
            for joint in (before, after):
                for screw in (joint or {"screws": []})["screws"]:
                    if x0 <= screw * MM <= x1:
                        own.append((screw * MM, screw * MM, joint["hole"] * MM))
            moved = [(a - x0, b - x0, d) for a, b, d in own]
            parts[piece["id"]] = (affinity.translate(shape, -x0, 0), moved, lamella, not lamella["pieces"])
            before = after
        for one, two in zip(pieces, pieces[1:]):
            if one["joint"]["kind"] == "plate":
                joint, at = one["joint"], one["to"] * MM
                x0 = at - joint["length"] * MM / 2
                name = one["id"] + "-" + two["id"][len(lamella["id"]):]
                holes = [(s * MM - x0, s * MM - x0, joint["hole"] * MM) for s in joint["screws"]]
                parts[name] = (box(0, 0, joint["length"] * MM, width), holes, lamella, False)
    return parts


def beyond(joint, at, width, length, first):
    """What a joint takes from the piece before it (first) or after it."""
    half = joint["length"] * MM / 2
    if joint["kind"] == "plate":
        half = 0
    reach = at + half if first else at - half
    side = box(reach, -1, length + 1, width + 1) if first else box(-1, -1, reach, width + 1)
    if joint["kind"] == "finger":
        rows = 2 * joint["fingers"]
        for row in range(rows):
            # From below, the first row is a finger of the first piece.
            if (row % 2 == 0) != first:
                low, high = width * row / rows, width * (row + 1) / rows
                low, high = low - (1 if row == 0 else 0), high + (1 if row == rows - 1 else 0)
                side = side.union(box(at - half, low, at + half, high))
    return side


def check_sheet(files, sheet, parts, settings):
    """A sheet of one file, or of one a window: (path, offset of the window)."""
    entities = []
    for path, offset in files:
        doc, own = read(path)
        assert {e.dxf.layer for e in own} <= CUT_LAYERS
        for layer in doc.layers:
            if layer.dxf.name in CUT_LAYERS:
                assert layer.dxf.lineweight == 0
        for e in own:
            e.translate(offset, 0, 0)
        entities += own
    kerf = settings["kerf"] * MM
    assert abs(sheet["kerf"] * MM - kerf) < 1e-9
    cuts = [e for e in entities if e.dxf.layer in ("CUT_INNER", "CUT_OUTER")]
    inner = [e for e in cuts if e.dxf.layer == "CUT_INNER"]
    outer = [e for e in cuts if e.dxf.layer == "CUT_OUTER"]
    pushes = len(files) - 1
    if pushes:
        pins = [e for e in inner if is_pin(e, sheet, kerf)]
        assert len(pins) == 2 * pushes, "two pins a push"
        guides = [e for e in entities if e.dxf.layer == "GUIDE" and e.dxftype() == "CIRCLE"]
        places = lambda holes: sorted((round(e.dxf.center.x, 4), round(e.dxf.center.y, 4)) for e in holes)
        assert places(pins) == places(guides), "pins stand where the next window shows them"
        inner = [e for e in inner if e not in pins]

    # Every part of the plan is there with its openings and its outline.
    circles = [(e.dxf.center.x, e.dxf.center.y, e.dxf.radius) for e in inner if e.dxftype() == "CIRCLE"]
    slots = [slot(e) for e in inner if e.dxftype() == "LWPOLYLINE"]
    expected_circles, expected_slots, outlines, round_ended = [], [], [], []
    for place in sheet["parts"]:
        shape, openings, lamella, whole = parts[place["part"]]
        x, y = place["x"] * MM, place["y"] * MM + lamella["width"] * MM / 2
        outlines.append(affinity.translate(shape, x, place["y"] * MM).buffer(kerf / 2, join_style="mitre"))
        if whole:
            half = lamella["width"] * MM / 2
            round_ended.append((x + half, x + lamella["length"] * MM - half, y, half + kerf / 2))
        for first, last, diameter in openings:
            radius = (diameter - kerf) / 2
            if last - first < 0.01:
                expected_circles.append((x + (first + last) / 2, y, radius))
            else:
                expected_slots.append((x + first, x + last, y, radius))
    found_round = [slot(e) for e in outer if is_slot(e)] if not pushes else []
    compared = [("circles", circles, expected_circles), ("slots", slots, expected_slots)]
    if not pushes:
        compared.append(("outlines", found_round, round_ended))
    for name, found, expected in compared:
        assert len(found) == len(expected), (name, len(found), len(expected))
        rounded = lambda values: tuple(round(v, 4) for v in values)
        for a, b in zip(sorted(found, key=rounded), sorted(expected, key=rounded)):
            assert max(abs(p - q) for p, q in zip(a, b)) < PLACE, (name, a, b)
    check_outlines(outer, outlines, pushes)

    # Openings lie strictly inside one outline; outlines keep their distance.
    tree = STRtree(outlines)
    owners = []
    for e in inner:
        hole = contour(e)
        owner = [i for i in tree.query(hole) if outlines[i].contains(hole)]
        assert len(owner) == 1, "an opening belongs to one part"
        assert hole.distance(outlines[owner[0]].exterior) > settings["least_web"]
        owners.append(owner[0])
    gap = settings["spacing"] * MM - kerf
    for i, a in enumerate(outlines):
        for j in tree.query(a.buffer(gap + 1)):
            if j != i:
                assert a.distance(outlines[j]) > gap - 1e-3, "parts too close"

    # Engraving comes first, then scores, then openings, and the outline around them last.
    rank = {"ENGRAVE": 0, "SCORE": 1, "CUT_INNER": 2, "CUT_OUTER": 3}
    last = {}
    for e in entities:
        if e.dxf.layer == "GUIDE" or e.dxf.layer == "CUT_INNER" and e not in inner:
            continue
        where = middle_of(e)
        owner = min(tree.query(where.buffer(1)), key=lambda i: outlines[i].distance(where))
        window = next(i for i, (_, o) in enumerate(files) if e.doc.filename == files[i][0])
        key = (owner, window)
        assert last.get(key, 0) <= rank[e.dxf.layer], "cut out of order"
        last[key] = rank[e.dxf.layer]

    # Engraving stays on its part, off openings; scores stay on their part.
    holes = [contour(e) for e in inner]
    hole_tree = STRtree(holes)
    for e in entities:
        if e.dxf.layer in ("ENGRAVE", "SCORE"):
            line = engraving(e)
            around = [i for i in tree.query(line.buffer(0.01)) if outlines[i].buffer(1e-6).contains(line)]
            assert len(around) == 1, "a stroke belongs to one part"
            for i in hole_tree.query(line.buffer(0.5)):
                assert line.distance(holes[i]) > 0.5, "a stroke runs into an opening"

    # No segment is cut twice, but the millimetre at seams.
    seen = set()
    for e in cuts:
        if e.dxftype() == "CIRCLE":
            keys = [("circle",) + tuple(round(v * 1000) for v in (e.dxf.center.x, e.dxf.center.y, e.dxf.radius))]
        elif e.dxftype() == "LINE":
            keys = [("line", *sorted((round(p.x * 1000), round(p.y * 1000)) for p in (e.dxf.start, e.dxf.end)))]
        else:
            p = [(round(x * 1000), round(y * 1000), b) for x, y, b in e.get_points("xyb")]
            keys = []
            for (x0, y0, b), (x1, y1, _) in zip(p, p[1:] + (p[:1] if e.closed else [])):
                ends = sorted([(x0, y0), (x1, y1)])
                keys.append(("segment", *ends, 0 if b == 0 else 1, (x0, y0) < (x1, y1) if b else False))
        for key in keys:
            assert key not in seen, ("cut twice", key)
            seen.add(key)
    return len(outlines), len(slots), len(circles)


def is_pin(e, sheet, kerf):
    if e.dxftype() != "CIRCLE" or abs(2 * e.dxf.radius + kerf - 3) > 1e-6:
        return False
    rows = [p["y"] * MM for p in sheet["parts"]]
    return e.dxf.center.y < min(rows) or e.dxf.center.y > max(rows)


def is_slot(e):
    return e.dxftype() == "LWPOLYLINE" and e.closed and [p[2] for p in e.get_points("xyb")] == [0, 1, 0, 1]


def middle_of(e):
    if e.dxftype() == "CIRCLE":
        return Point(e.dxf.center.x, e.dxf.center.y)
    return engraving(e).interpolate(0.5, normalized=True)


def check_outlines(outer, outlines, pushes):
    """What is cut outside are the outlines, to two thousandths; with windows in chains that overlap by
    a millimetre at every seam."""
    lines = [LineString(curve(e)) for e in outer]
    tree = STRtree(outlines)
    chains = {}
    for e, line in zip(outer, lines):
        owner = [i for i in tree.query(line.buffer(0.01)) if outlines[i].exterior.buffer(0.002).contains(line)]
        assert len(owner) == 1, "an outline belongs to one part"
        closed = e.dxftype() == "LWPOLYLINE" and e.closed
        assert closed or pushes, "cuts are closed"
        if closed:
            assert contour(e).is_valid
        chains.setdefault(owner[0], []).append(line)
    assert len(chains) == len(outlines), "every part has an outline"
    for i, own in chains.items():
        edge = outlines[i].exterior
        assert edge.difference(union_all([c.buffer(0.004) for c in own])).length < 1e-9, "an outline has a gap"
        # Each seam divides two edges; the round ends are polygons here.
        doubled = sum(c.length for c in own) - edge.length
        seams = round(doubled / 2)
        assert abs(doubled - 2 * seams) < 0.02, doubled
        assert (seams == 0) == (len(own) == 1), (seams, len(own))
    return chains


def check_part(path, part, kerf):
    """A file of one part: its closed cuts, nothing else."""
    shape, openings, lamella, _ = part
    _, entities = read(path)
    assert {e.dxf.layer for e in entities} <= {"CUT_INNER", "CUT_OUTER"}
    outer = [contour(e) for e in entities if e.dxf.layer == "CUT_OUTER"]
    expected = affinity.translate(shape.buffer(kerf / 2, join_style="mitre"), kerf / 2, kerf / 2)
    assert len(outer) == 1 and outer[0].hausdorff_distance(expected) < 0.002
    inner = [contour(e) for e in entities if e.dxf.layer == "CUT_INNER"]
    assert len(inner) == len(openings)
    area = sum((d - kerf) ** 2 * math.pi / 4 + (b - a if b - a >= 0.01 else 0) * (d - kerf) for a, b, d in openings)
    assert abs(sum(h.area for h in inner) - area) < 0.02 * max(1, len(inner)), "areas of openings"
    assert all(outer[0].contains(h) for h in inner)


def main(folder):
    plan = json.load(open(os.path.join(folder, "plan.json")))
    settings = json.load(open(os.path.join(folder, "settings.json")))
    parts = expected_parts(plan)
    total = [0, 0, 0]
    files = sorted(glob.glob(os.path.join(folder, "fabrication", "*.dxf")))
    for sheet in plan["sheets"]:
        own = [f for f in files if f"_{sheet['id']}-of-" in os.path.basename(f)]
        windows = sheet["windows"] or [{"from": 0}]
        assert len(own) == len(windows), (own, windows)
        check_windows(sheet)
        counts = check_sheet([(f, w["from"] * MM) for f, w in zip(own, windows)], sheet, parts, settings)
        total = [a + b for a, b in zip(total, counts)]
        files = [f for f in files if f not in own]
    assert not files, files
    placed = [p["part"] for s in plan["sheets"] for p in s["parts"]]
    assert sorted(placed) == sorted(parts), "every part lies on one sheet"
    alone = glob.glob(os.path.join(folder, "parts", "*.dxf"))
    assert sorted(os.path.basename(f)[:-4] for f in alone) == sorted(parts)
    for path in alone:
        check_part(path, parts[os.path.basename(path)[:-4]], settings["kerf"] * MM)
    for path in glob.glob(os.path.join(folder, "**", "*.dxf"), recursive=True):
        read(path)
    for path in glob.glob(os.path.join(folder, "fabrication", "*.pdf")):
        assert open(path, "rb").read().startswith(b"%PDF-")
    print(*total)


def check_windows(sheet):
    """Windows cover the sheet and overlap; pushes are equal."""
    windows = sheet["windows"]
    for one, two in zip(windows, windows[1:]):
        assert one["from"] < two["from"] and one["to"] - two["from"] > 0.05
        assert abs((two["from"] - one["from"]) - windows[1]["from"]) < 1e-8
    if windows:
        assert windows[0]["from"] == 0 and abs(windows[-1]["to"] - sheet["length"]) < 1e-8


main(sys.argv[1])
