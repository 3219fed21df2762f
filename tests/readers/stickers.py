"""Reads sheets of foil with ezdxf and shapely, and checks with shapely alone that the stickers of
the plan cover what they are for.

usage: stickers.py FOLDER   (with plan.json, settings.json and stickers/*.dxf)
"""
import glob
import json
import math
import os
import sys

import ezdxf
from shapely.affinity import rotate, scale, translate
from shapely.geometry import LineString, Point, Polygon, box
from shapely.ops import unary_union

MM = 1000.0
CARD, NUMBER_STRIP = 2.0, 4.0
LAYERS = {"GUIDE", "PEN", "KISS_CUT", "THROUGH_CUT"}


def turn(member):
    (ax, ay), (bx, by) = member["planar"]
    return math.degrees(math.atan2(by - ay, bx - ax))


def strip(width, angle, at):
    """An endless lamella whose middle line passes (at, 0) in the frame of another."""
    return translate(rotate(box(-9, -width / 2, 9, width / 2), angle, origin=(0, 0)), at, 0)


def contact(sticker, crossing, lamellae, members, steps=40):
    """Union of all places where the other lamella lies on this one while the grid unfolds, in
    the frame of this lamella (metres along from the start of the member, across to the left)."""
    own, other = (crossing["u"], crossing["v"])
    on = crossing["on_u"]
    if sticker["lamella"] == crossing["v"]:
        own, other, on = other, own, crossing["on_v"]
    flat = (turn(members[other]) - turn(members[own])) % 180.0
    # The angle between directions of travel, as the plan has it, must be that of the drawing.
    travel = (turn(members[other]) - turn(members[own]) + 180.0) % 360.0 - 180.0
    assert abs(abs(travel) - crossing["angle_planar"]) < 1e-3, crossing["id"]
    unfolded = math.copysign(crossing["angle_surface"], travel) % 180.0
    width, across = lamellae[own]["width"], lamellae[other]["width"]
    me = box(-9, -width / 2, 9, width / 2)
    pieces = []
    for k in range(steps + 1):
        t = k / steps
        at = on["planar"] + t * (on["surface"] - on["planar"])
        angle = flat + t * (unfolded - flat)
        pieces.append(me.intersection(strip(across, angle, at)))
    return unary_union(pieces), width


def check_plan(plan):
    """Every notch has its two stickers; together those of a lamella cover every contact."""
    lamellae = {l["id"]: l for l in plan["lamellae"]}
    members = {m["id"]: m for m in plan["members"]}
    crossings = {c["id"]: c for c in plan["crossings"]}
    slides = {o["crossing"] for l in plan["lamellae"] for o in l["openings"] if o["kind"] == "notch"}
    stickers = plan["stickers"]
    assert [s["number"] for s in stickers] == list(range(1, len(stickers) + 1))
    pairs = {(s["crossing"], s["face"]) for s in stickers}
    assert len(pairs) == len(stickers)
    assert pairs == {(c, face) for c in slides for face in ("top", "bottom")}
    by_lamella = {}
    for s in stickers:
        by_lamella.setdefault(s["lamella"], []).append(s)
    for name, group in by_lamella.items():
        # On one face, from the start to the end, clear of each other.
        assert len({s["face"] for s in group}) == 1
        family = members[lamellae[name]["member"]]["family"]
        assert group[0]["face"] == ("bottom" if family == "u" else "top")
        outlines = [Polygon(s["outline"]) for s in group]
        for a, b in zip(outlines, outlines[1:]):
            assert a.centroid.x < b.centroid.x and a.distance(b) > 1e-4
        # A cut between two neighbours is half a millimetre along the lamella.
        foil = unary_union([o.buffer(0.26e-3, join_style="mitre") for o in outlines])
        for s, outline in zip(group, outlines):
            assert outline.exterior.is_ccw and outline.is_valid
            area, width = contact(s, crossings[s["crossing"]], lamellae, members)
            assert area.difference(foil.buffer(1e-7)).area < 1e-9, s["id"]
            low, high = outline.bounds[1], outline.bounds[3]
            assert abs(low + width / 2) < 1e-8 and abs(high - width / 2) < 1e-8
            opening = [o for o in lamellae[name]["openings"] if o["crossing"] == s["crossing"]][0]
            ends = sorted(opening.get(k, opening.get("at")) for k in ("from", "to"))
            hole = LineString([(x, 0) for x in ends]) if ends[0] < ends[1] else Point(ends[0], 0)
            slot = LineString([(x, 0) for x in s["slot"]])
            slot = slot.buffer(s["diameter"] / 2) if slot.length else Point(s["slot"][0], 0).buffer(s["diameter"] / 2)
            assert slot.contains(hole.buffer(opening["diameter"] / 2)), "the foil stands over the notch"
            assert outline.contains(slot)
    return len(stickers), len(slides)


def polygon(e):
    if e.dxftype() == "CIRCLE":
        return Point(e.dxf.center.x, e.dxf.center.y).buffer(e.dxf.radius, 64)
    assert e.dxftype() == "LWPOLYLINE" and e.closed
    points = []
    for piece in e.virtual_entities():
        if piece.dxftype() == "LINE":
            chain = [(piece.dxf.start.x, piece.dxf.start.y), (piece.dxf.end.x, piece.dxf.end.y)]
        else:
            chain = [(p.x, p.y) for p in piece.flattening(0.001)]
        if points and math.dist(chain[-1], points[-1]) < math.dist(chain[0], points[-1]):
            chain.reverse()
        points += chain
    shape = Polygon(points)
    assert shape.is_valid and shape.area > 0
    return shape


def expected(sticker):
    """Outline and slot on the card: as seen on the side that is not glued."""
    outline = Polygon(sticker["outline"])
    half = sticker["diameter"] / 2
    a, b = sticker["slot"]
    slot = LineString([(a, 0), (b, 0)]).buffer(half, 64) if b - a > 1e-5 else Point((a + b) / 2, 0).buffer(half, 64)
    shapes = [scale(s, MM, MM, origin=(0, 0)) for s in (outline, slot)]
    if sticker["face"] == "bottom":
        shapes = [scale(s, 1, -1, origin=(0, 0)) for s in shapes]
    x, y = shapes[0].bounds[:2]
    return [translate(s, CARD - x, CARD - y) for s in shapes]


def check_sheet(path, sheet, stickers):
    doc = ezdxf.readfile(path)
    audit = doc.audit()
    assert not audit.errors and not audit.fixes, path
    assert doc.header["$INSUNITS"] == 4
    entities = list(doc.modelspace())
    assert {e.dxf.layer for e in entities} <= LAYERS
    cards, kiss, order = [], [], {}
    for n, e in enumerate(entities):
        if e.dxf.layer == "THROUGH_CUT":
            cards.append((n, polygon(e)))
        elif e.dxf.layer == "KISS_CUT":
            kiss.append((n, polygon(e)))
    assert len(cards) == len(sheet["parts"]) and len(kiss) == 2 * len(cards)
    frame = box(0, 0, sheet["length"] * MM, sheet["width"] * MM)
    for i, ((n, card), place) in enumerate(zip(cards, sheet["parts"])):
        assert frame.buffer(-4.9).contains(card)
        assert abs(card.bounds[0] - place["x"] * MM) < 1e-4 and abs(card.bounds[1] - place["y"] * MM) < 1e-4
        for _, other in cards[i + 1:]:
            assert card.distance(other) > 1.0
        inside = sorted((m, k) for m, k in kiss if card.contains(k))
        assert len(inside) == 2 and inside[-1][0] < n, "kiss cuts come before the card is cut"
        (_, slot), (_, outline) = inside
        assert outline.contains(slot)
        want = [translate(s, place["x"] * MM, place["y"] * MM) for s in expected(stickers[place["part"]])]
        for found, shape in ((outline, want[0]), (slot, want[1])):
            assert found.symmetric_difference(shape).area < 0.02 + 1e-3 * shape.length, place["part"]
    for n, e in enumerate(entities):
        if e.dxf.layer == "PEN":
            points = [e.dxf.start, e.dxf.end] if e.dxftype() == "LINE" else e.vertices_in_wcs()
            stroke = LineString([(p[0], p[1]) for p in points])
            owner = [m for m, card in cards if card.contains(stroke)]
            assert len(owner) == 1 and n < owner[0]
            assert all(not k.intersects(stroke) for _, k in kiss), "a number runs into a sticker"
    return len(cards)


def main(folder):
    plan = json.load(open(os.path.join(folder, "plan.json")))
    stickers = {s["id"]: s for s in plan["stickers"]}
    count, slides = check_plan(plan)
    sheets = {s["id"]: s for s in plan["foils"]}
    files = sorted(glob.glob(os.path.join(folder, "stickers", "*.dxf")))
    assert len(files) == len(sheets)
    cut = 0
    for path in files:
        name = [s for s in sheets if s in os.path.basename(path)]
        cut += check_sheet(path, sheets[name[0]], stickers)
    assert cut == count
    parts = [p["part"] for s in plan["foils"] for p in s["parts"]]
    assert parts == [s["id"] for s in plan["stickers"]], "cards lie in the order of assembly"
    print(count, slides, len(files))


main(sys.argv[1])
