"""Reads what supports are made from with trimesh, lib3mf, ezdxf and shapely, and compares it with
the plan.

usage: supports.py FOLDER   (with plan.json, supports.csv and supports/*)
"""
import csv
import glob
import json
import math
import os
import sys

import ezdxf
import lib3mf
import numpy as np
import trimesh
from shapely.geometry import Polygon

MM = 1000.0


def stem(support):
    return "".join(c if c.isascii() and (c.isalnum() or c in "_-") else "-" for c in support["id"])


def check_solid(mesh, support):
    """A printed foot: closed, of the plan's volume, with the plan's contact face and hole."""
    body = support["body"]
    assert mesh.is_watertight and mesh.is_winding_consistent and mesh.is_volume
    assert mesh.euler_number == 2, "one body without handles"
    # The plan has whole cubic millimetres, a STL seven digits.
    assert abs(mesh.volume - body["volume"] * MM**3) < 0.6 + 1e-5 * mesh.volume
    assert abs(mesh.bounds[0][2]) < 1e-3, "it stands on the plate"
    # The foot: a circle around the origin.
    low = mesh.vertices[mesh.vertices[:, 2] < 1e-3]
    radii = np.hypot(low[:, 0], low[:, 1])
    assert abs(radii.max() - body["foot"] * MM / 2) < 1e-3
    # The contact face: a ring in the plane of the plan around the middle of the plan.
    normal = np.array(support["normal"])
    centre = np.array([0, 0, support["height"] * MM])
    plane = np.abs((mesh.triangles - centre) @ normal).max(axis=1) < 1e-3
    # Vertices are rounded to a tenth of a micrometre, the shortest edges are a tenth of a millimetre.
    assert np.allclose(mesh.face_normals[plane], normal, atol=2e-3)
    ring = math.pi * ((body["pad"] / 2) ** 2 - (body["bore"] / 2) ** 2) * MM**2
    assert abs(mesh.area_faces[plane].sum() / ring - 1) < 3e-3
    # The hole is square to it: its bottom is as deep as the plan says.
    depths = (mesh.triangles - centre) @ normal
    bottom = np.abs(depths + body["depth"] * MM).max(axis=1) < 1e-3
    disc = math.pi * (body["bore"] / 2) ** 2 * MM**2
    assert abs(mesh.area_faces[bottom].sum() / disc - 1) < 3e-3
    # Nothing of the hole comes out of the body.
    thickness = mesh.vertices[:, 2].min()
    ends = mesh.triangles[bottom].reshape(-1, 3)
    assert ends[:, 2].min() - thickness > 1.5
    return 1


def check_3mf(path, supports):
    """The same bodies through the reference implementation of the format."""
    wrapper = lib3mf.Wrapper()
    model = wrapper.CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(path)
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    items = model.GetBuildItems()
    boxes = []
    by_name = {}
    while items.MoveNext():
        item = items.GetCurrent()
        mesh = item.GetObjectResource()
        assert mesh.IsMeshObject() and mesh.IsManifoldAndOriented() and mesh.IsValid()
        by_name[mesh.GetName()] = mesh
        box = item.GetOutbox()
        boxes.append((box.MinCoordinate[:], box.MaxCoordinate[:]))
    assert sorted(by_name) == sorted(s["id"] for s in supports)
    for i, (low, high) in enumerate(boxes):
        assert min(low[:2]) > 0
        for other_low, other_high in boxes[i + 1:]:
            apart = any(high[k] < other_low[k] or other_high[k] < low[k] for k in range(2))
            assert apart, "two supports in one place of the plate"
    for support in supports:
        mesh = by_name[support["id"]]
        vertices = np.array([v.Coordinates[:] for v in mesh.GetVertices()])
        faces = np.array([t.Indices[:] for t in mesh.GetTriangleIndices()])
        check_solid(trimesh.Trimesh(vertices, faces, process=False), support)
    return len(by_name)


def read(path):
    doc = ezdxf.readfile(path)
    audit = doc.audit()
    assert not audit.errors and not audit.fixes, path
    return list(doc.modelspace())


def check_template(path, support):
    """The side of a wedge or form: level foot, top at the tilt of the plan, middle height."""
    body = support["body"]
    entities = read(path)
    cuts = [e for e in entities if e.dxf.layer == "CUT_OUTER"]
    assert len(cuts) == 1 and cuts[0].closed
    side = Polygon(cuts[0].get_points("xy"))
    x0, y0, x1, y1 = side.bounds
    assert abs((x1 - x0) - body["pad"] * MM) < 1e-6
    heights = sorted(y - y0 for x, y in side.exterior.coords[:-1])
    assert heights[:2] == [0, 0]
    low, high = heights[2:]
    assert abs(math.degrees(math.atan2(high - low, x1 - x0)) - support["tilt"]) < 1e-6
    middle = (low + high) / 2
    if support["kind"] == "wedge-on-block":
        assert abs(middle - (support["height"] - body["block"]) * MM) < 1e-6
        assert abs(low - 5.0) < 1e-6
    else:
        assert abs(middle - support["height"] * MM) < 1e-6
        assert abs(body["volume"] - body["foot"] ** 2 * side.area / (x1 - x0) / MM) < 1e-8
    assert abs(body["volume"] - body["foot"] ** 2 * body["block"]) < 2e-9
    assert abs(body["mass"] - 2400 * body["volume"]) < 1e-5
    for e in entities:
        if e.dxf.layer in ("SCORE", "ENGRAVE"):
            points = [e.dxf.start, e.dxf.end] if e.dxftype() == "LINE" else e.vertices_in_wcs()
            assert all(side.contains(ezdxf_point(p)) for p in points), (path, e.dxf.layer)


def ezdxf_point(p):
    from shapely.geometry import Point

    return Point(p[0], p[1])


def check_setting_out(folder, supports):
    """Tapes and coordinates of the table are those of the plan's positions."""
    rows = list(csv.DictReader(open(os.path.join(folder, "supports.csv"), encoding="utf-8")))
    assert [r["id"] for r in rows] == [s["id"] for s in supports]
    ground = {round(s["position"][2] - s["height"], 7) for s in supports}
    assert len(ground) == 1, "one level ground"
    here = [np.array([float(r["ground_x_mm"]), float(r["ground_y_mm"])]) for r in rows]
    true = [np.array(s["position"][:2]) * MM for s in supports]
    for i in range(len(rows)):
        for j in range(i):
            a, b = np.linalg.norm(here[i] - here[j]), np.linalg.norm(true[i] - true[j])
            assert abs(a - b) < 0.2, "the plan of the ground is congruent to the structure"
    # Not mirrored.
    if len(rows) > 2:
        area = lambda p: (p[1] - p[0])[0] * (p[2] - p[0])[1] - (p[1] - p[0])[1] * (p[2] - p[0])[0]
        assert area(here) * area(true) > 0
    base = [i for i, p in enumerate(here) if np.linalg.norm(p) < 0.05]
    ends = [i for i, r in enumerate(rows) if float(r["tape_2_mm"]) == 0]
    assert len(base) == 1 and len(ends) == 1
    far = ends[0]
    longest = max(np.linalg.norm(a - b) for a in here for b in here)
    assert abs(here[far][1]) < 0.06 and abs(here[far][0] - longest) < 0.2
    for r, p in zip(rows, here):
        # Each number of the table is off by up to 0.05.
        assert abs(float(r["tape_1_mm"]) - np.linalg.norm(p)) < 0.05 * (1 + 2 * 2**0.5)
        assert abs(float(r["tape_2_mm"]) - np.linalg.norm(p - here[far])) < 0.05 * (1 + 2 * 2**0.5)
    for s in supports:
        n = np.array(s["normal"])
        assert abs(np.linalg.norm(n) - 1) < 1e-8
        assert abs(math.degrees(math.acos(min(1, n[2]))) - s["tilt"]) < 1e-4
        if s["tilt"] > 1e-3:
            assert abs(math.degrees(math.atan2(n[1], n[0])) - s["azimuth"]) < 1e-5
    entities = read(os.path.join(folder, "supports", "setting-out.dxf"))
    assert len(entities) > 50


def main(folder):
    plan = json.load(open(os.path.join(folder, "plan.json")))
    supports = plan["supports"]
    printed = [s for s in supports if s["kind"] == "printed" and s["body"]]
    cast = [s for s in supports if s["kind"] != "printed" and s["body"]]
    solids = templates = blocks = objects = 0
    for support in printed:
        mesh = trimesh.load(os.path.join(folder, "supports", stem(support) + ".stl"))
        solids += check_solid(mesh, support)
    if printed:
        objects = check_3mf(os.path.join(folder, "supports", "supports.3mf"), printed)
    for support in cast:
        base = os.path.join(folder, "supports", stem(support))
        check_template(base + ".template.dxf", support)
        templates += 1
        read(base + ".block.dxf")
        blocks += 1
    assert len(glob.glob(os.path.join(folder, "supports", "*.stl"))) == solids
    check_setting_out(folder, supports)
    print(len(supports), solids, objects, templates, blocks)


main(sys.argv[1])
