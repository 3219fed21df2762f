"""Cuts a coupon in thought: with a kerf, the bars of its frame leave a gap of eleven kerfs.

usage: coupon.py FILE.dxf
"""
import sys

import ezdxf
from shapely import unary_union
from shapely.geometry import LineString, Point, Polygon

KERF = 0.2


def main(path):
    doc = ezdxf.readfile(path)
    audit = doc.audit()
    assert not audit.errors and not audit.fixes
    entities = list(doc.modelspace())
    inner = [e for e in entities if e.dxf.layer == "CUT_INNER"]
    outline = [e for e in entities if e.dxf.layer == "CUT_OUTER"]
    assert len(outline) == 1 and outline[0].closed
    plate = Polygon([p[:2] for p in outline[0].get_points("xy")])
    holes = [Point(e.dxf.center.x, e.dxf.center.y).buffer(e.dxf.radius) for e in inner if e.dxftype() == "CIRCLE"]
    lines = [LineString([tuple(e.dxf.start)[:2], tuple(e.dxf.end)[:2]]) for e in inner if e.dxftype() == "LINE"]
    closed = [e for e in inner if e.dxftype() == "LWPOLYLINE"]
    frames = [e for e in closed if all(b == 0 for *_, b in e.get_points("xyb"))]
    notches = [e for e in closed if e not in frames]
    assert len(frames) == 1
    frame = Polygon([p[:2] for p in frames[0].get_points("xy")])
    for hole in holes:
        assert plate.contains(hole) and hole.distance(plate.exterior) > 3 and hole.distance(frame) > 3
    # What the beam takes, and what is left in the frame.
    burnt = unary_union([line.buffer(KERF / 2, cap_style="flat") for line in [frame.exterior, *lines]])
    bars = list(frame.difference(burnt).geoms)
    opening = frame.buffer(KERF / 2, join_style="mitre").bounds
    width = lambda b: b[2] - b[0]
    gap = width(opening) - sum(width(bar.bounds) for bar in bars)
    assert abs(gap - 11 * KERF) < 1e-9, gap
    print(len(bars), len(holes), len(notches))


main(sys.argv[1])
