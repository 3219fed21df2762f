"""Recomputes a plan with other means: exact distances by another library, planar geometry and
crossings from the written numbers, masses from the project file.

usage: plan_check.py PROJECT.toml PLAN.json PLAN-SCHEMA.json MATERIALS.jsonl

A written length is off by up to half a nanometre and a written place by up to 0.87 of one, so
what is computed from written numbers agrees with a written number to a few nanometres and no
better. Tolerances are sums of these roundings; where more is allowed, the reason stands beside
it. Prints how much was checked and the largest deviation of each kind.
"""
import json
import math
import pathlib
import sys
import tomllib

import jsonschema
import numpy as np

import plan_lamellae
from exact_distances import Surface, distances_to_triangles, read_obj
from plan_geometry import PLACE, ROUND, Polyline, angle_at, crossing_of_lines, crossings, slope_range

METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
worst = {}


def close(what, found, written, tolerance):
    """Two numbers agree; the largest deviation of its kind is kept for the report."""
    off = float(np.max(np.abs(np.asarray(found) - np.asarray(written))))
    assert off <= tolerance, f"{what}: {found} is not {written}, off by {off:g} of {tolerance:g}"
    kind = what.split(" of ")[0]
    worst[kind] = max(worst.get(kind, 0.0), off)


def check_records(plan):
    """Ids are sorted and unique, what is named exists, and all numbers are finite."""
    ids = {}
    for name in ("points", "edges", "patches", "members", "crossings", "lamellae", "sheets"):
        ids[name] = [record["id"] for record in plan[name]]
        assert ids[name] == sorted(set(ids[name])), name
    for edge in plan["edges"]:
        assert {edge["from"], edge["to"]} <= set(ids["points"])
        assert edge["id"] == f"{edge['from']}-{edge['to']}" and edge["from"] < edge["to"]
    for patch in plan["patches"]:
        assert set(patch["corners"]) <= set(ids["points"])
        assert all(set(side["edges"]) <= set(ids["edges"]) for side in patch["sides"])
    assert ids["lamellae"] == ids["members"] == [l["member"] for l in plan["lamellae"]]

    def finite(value):
        if isinstance(value, float):
            assert math.isfinite(value)
        elif isinstance(value, (list, dict)):
            for item in value.values() if isinstance(value, dict) else value:
                finite(item)

    finite(plan)


def check_surface(plan, project, vertices, faces):
    """Measures of the mesh, and anchors on it."""
    record = plan["surface"]
    assert (record["vertices"], record["faces"]) == (len(vertices), len(faces))
    triangles = vertices[np.array(faces)]
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    close("area", 0.5 * np.linalg.norm(cross, axis=1).sum(), record["area"], 0.51e-6)
    close("box", [vertices.min(axis=0), vertices.max(axis=0)], record["bounding_box"], 1.01 * ROUND)
    unit = METRES[project["project"].get("units", "m")]
    for point in plan["points"]:
        said = project["points"][point["id"]]
        at = np.array(point["position"])
        if isinstance(said, list) and len(said) == 2:
            close(f"anchor of {point['id']}", at[:2], np.array(said) * unit, 1.01 * ROUND)
            # The topmost place over these coordinates; steep faces pass on errors across.
            close(f"height of {point['id']}", heights_at(at[:2], triangles).max(), at[2], 4 * PLACE)
        assert distances_to_triangles(at, triangles).min() < 1.5 * PLACE
        close(f"normal of {point['id']}", np.linalg.norm(point["normal"]), 1.0, 2e-9)


def heights_at(at, triangles):
    """Heights of the triangles over a place of the ground."""
    a, b, c = (triangles[:, i] for i in range(3))
    area = lambda p, q, r: (q[:, 0] - p[:, 0]) * (r[:, 1] - p[:, 1]) - (q[:, 1] - p[:, 1]) * (r[:, 0] - p[:, 0])
    here = np.broadcast_to(at, (len(triangles), 2))
    shares = np.array([area(b, c, here), area(c, a, here), area(a, b, here)]) / area(a, b, c)
    over = (shares > -1e-9).all(axis=0)
    return np.einsum("ij,ij->j", shares[:, over], triangles[over, :, 2].T)


def side_lines(plan, patch):
    """Polylines of the four sides, each in the direction in which its members or shares run."""
    points = {p["id"]: np.array(p["position"]) for p in plan["points"]}
    edges = {e["id"]: e for e in plan["edges"]}
    lines = []
    for i, side in enumerate(patch["sides"]):
        at = patch["corners"][i]
        places = [points[at]]
        for name in side["edges"]:
            edge = edges[name]
            line = [np.array(p) for p in edge["polyline"]]
            if edge["from"] != at:
                line.reverse()
            close("joint", line[0], places[-1], 2.01 * ROUND)
            places.extend(line[1:])
            at = edge["to"] if edge["from"] == at else edge["from"]
        assert at == patch["corners"][(i + 1) % 4], (patch["id"], i)
        lines.append(Polyline(places if i < 2 else places[::-1]))
    return lines


def check_patch(plan, patch, slope):
    """The flat quadrilateral, angles, diagonals and cladding functions."""
    name = patch["id"]
    corners = np.array(patch["planar_corners"])
    edges = {e["id"]: e for e in plan["edges"]}
    for i, side in enumerate(patch["sides"]):
        close(f"side of {name}", sum(edges[e]["length"] for e in side["edges"]), side["length"], 6 * ROUND)
        flat = np.linalg.norm(corners[(i + 1) % 4] - corners[i])
        close(f"flat side of {name}", flat, side["length"], 2 * PLACE + ROUND)
    turns = [
        np.linalg.det([corners[(i + 1) % 4] - corners[i], corners[(i + 2) % 4] - corners[(i + 1) % 4]])
        for i in range(4)
    ]
    assert min(turns) > 0 or max(turns) < 0, "the flat patch is convex"
    flat_angle = angle_at(corners[0], corners[1], corners[3])
    close(f"planar angle of {name}", flat_angle, patch["alpha_planar"], 1e-6)
    diagonals = patch["diagonals"]
    e_planar, f_planar = (np.linalg.norm(corners[i + 2] - corners[i]) for i in range(2))
    close(f"flat diagonal of {name}", e_planar, diagonals["e_planar"], 2 * PLACE + ROUND)
    close(f"flat diagonal of {name}", f_planar, diagonals["f_planar"], 2 * PLACE + ROUND)
    if not any(told["code"] == "W0502" for told in plan["diagnostics"]):
        assert (diagonals["e"] - e_planar) * (diagonals["f"] - f_planar) < 0
    bound = patch["curvature"]["injectivity_bound"]
    if bound is not None:
        # Curvatures are written with six digits.
        close(f"injectivity of {name}", bound * math.sqrt(patch["curvature"]["max"]) / math.pi, 1, 1e-5)
    for function in patch["cladding"].values():
        samples = np.array(function["samples"])
        assert (samples[0] == 0).all() and (samples[-1] == 1).all()
        assert (np.diff(samples, axis=0) > 0).all(), "cladding functions increase"
        low, high = function["slope_min"], function["slope_max"]
        chords = slope_range(samples)
        # Shares and slopes are written to 1e-9, neighbouring shares are about a hundredth apart.
        assert low <= chords[0] + 1e-6 and chords[1] <= high + 1e-6, (chords, low, high)
        if patch["feasible"]:
            assert slope[0] <= low and high <= slope[1], (name, low, high)


def check_members(plan, patch, lines, surface):
    """Both lengths of every member, its ends on the sides, and the cladding function there."""
    corners = np.array(patch["planar_corners"])
    ab, bc, cd, da = lines
    # Start side, end side, and the flat corners of both in the same direction.
    ways = {"u": (ab, cd, corners[[0, 1]], corners[[3, 2]]), "v": (da, bc, corners[[0, 3]], corners[[1, 2]])}
    for family, (start_side, end_side, start_flat, end_flat) in ways.items():
        members = [m for m in plan["members"] if m["patch"] == patch["id"] and m["family"] == family]
        assert [m["index"] for m in members] == list(range(1, len(members) + 1))
        assert [m["boundary"] for m in members] == [i in (0, len(members) - 1) for i in range(len(members))]
        samples = np.array(patch["cladding"][family]["samples"])
        for before, after in zip(members, members[1:]):
            assert before["start"] < after["start"] and before["end"] < after["end"]
        for member in members:
            name = member["id"]
            assert name == f"{patch['id']}.{family}{member['index']:02}"
            line = Polyline(member["polyline"])
            places = [surface.insert(tuple(line.places[i])) for i in (0, -1)]
            exact = surface.distances(places[0], [places[1]])[0]
            length = member["length_surface"]
            close(f"distance of {name}", exact, length, 2 * PLACE + ROUND)
            close(f"path of {name}", line.length, length, 3 * PLACE + ROUND)
            planar = np.linalg.norm(np.subtract(*member["planar"]))
            close(f"flat length of {name}", planar, member["length_planar"], 2 * PLACE + ROUND)
            close(f"equal lengths of {name}", length, member["length_planar"], 1e-6 * length)
            for place, flat, share, side, [a, b] in (
                (line.places[0], member["planar"][0], member["start"], start_side, start_flat),
                (line.places[-1], member["planar"][1], member["end"], end_side, end_flat),
            ):
                # A share is rounded to 1e-9 of its side.
                share_off = 0.5e-9 * side.length
                close(f"end of {name}", place, side.at(share * side.length), 3 * PLACE + share_off)
                close(f"flat end of {name}", flat, a + share * (b - a), 3 * PLACE + share_off)
            # Straight between its samples, the function is off by some 1e-5.
            cladding = np.interp(member["start"], samples[:, 0], samples[:, 1])
            assert abs(cladding - member["end"]) < 1e-4, (name, cladding, member["end"])


def check_cladding(patch, lines, surface):
    """Between members, too, the sampled functions join points of equal distance."""
    corners = np.array(patch["planar_corners"])
    ab, bc, cd, da = lines
    ways = {"u": (ab, cd, corners[[0, 1]], corners[[3, 2]]), "v": (da, bc, corners[[0, 3]], corners[[1, 2]])}
    for family, (start_side, end_side, [a, b], [c, d]) in ways.items():
        samples = patch["cladding"][family]["samples"]
        for start, end in samples[len(samples) // 5 :: len(samples) // 3]:
            planar = np.linalg.norm(a + start * (b - a) - c - end * (d - c))
            source = surface.insert(tuple(start_side.at(start * start_side.length)))
            target = surface.insert(tuple(end_side.at(end * end_side.length)))
            exact = surface.distances(source, [target])[0]
            # Functions are traced on interpolated distances; only members are exact. Distances on
            # a polyhedron are smooth but for the angles at its edges, which pass on a hundredth
            # of the square of an edge in a member. A spline through 17 distances itself errs by
            # 2e-5 of the side on a dome of a quarter of its width, which the pavilion resembles.
            edge = surface.mean_edge / planar
            close(f"sample of {patch['id']}", exact / planar, 1, 0.01 * edge**2 + 2e-5)


def check_crossings(plan, patch):
    """Every pair of members meets once, on the surface and in the plane, at the written places."""
    members = {m["id"]: m for m in plan["members"] if m["patch"] == patch["id"]}
    lines = {name: Polyline(m["polyline"]) for name, m in members.items()}
    u, v = ([m for m in members.values() if m["family"] == f] for f in "uv")
    own = [c for c in plan["crossings"] if c["u"] in members]
    expected = [(a["id"], b["id"]) for a in u for b in v]
    assert sorted((c["u"], c["v"]) for c in own) == sorted(expected)
    for crossing in own:
        name = crossing["id"]
        first, second = members[crossing["u"]], members[crossing["v"]]
        assert name == f"{first['id']}-v{second['index']:02}"
        s, t = crossing_of_lines(first["planar"], second["planar"])
        lengths = first["length_planar"], second["length_planar"]
        tolerance = 6 * PLACE / math.sin(math.radians(crossing["angle_planar"]))
        for share, length, on in zip((s, t), lengths, ("on_u", "on_v")):
            assert -tolerance <= share * length <= length + tolerance
            close(f"flat position of {name}", share * length, crossing[on]["planar"], tolerance)
        flat = np.array(first["planar"])
        close(f"flat crossing of {name}", flat[0] + s * (flat[1] - flat[0]), crossing["planar"], tolerance)
        angle = angle_at([0, 0], np.subtract(*flat[::-1]), np.subtract(*second["planar"][::-1]))
        close(f"flat angle of {name}", angle, crossing["angle_planar"], 1e-6)

        hits = crossings(lines[first["id"]], lines[second["id"]])
        assert len(hits) == 1, (name, hits)
        on_u, on_v, angle, sharpness = hits[0]
        tolerance = 6 * PLACE / math.sin(math.radians(crossing["angle_surface"]))
        close(f"position of {name}", on_u, crossing["on_u"]["surface"], tolerance)
        close(f"position of {name}", on_v, crossing["on_v"]["surface"], tolerance)
        close(f"crossing of {name}", lines[first["id"]].at(on_u), crossing["position"], tolerance)
        if sharpness is not None:
            assert abs(angle - crossing["angle_surface"]) < 1e-6 + sharpness, (name, angle, crossing)


def check_continuity(plan):
    """Where patches share an edge, the members of both meet on it."""
    ends = {}
    for patch in plan["patches"]:
        lines = side_lines(plan, patch)
        for family, sides in (("u", (0, 2)), ("v", (3, 1))):
            members = [m for m in plan["members"] if m["patch"] == patch["id"] and m["family"] == family]
            for at, side in zip((0, -1), sides):
                places = [np.array(m["polyline"][at]) for m in members]
                for edge in patch["sides"][side]["edges"]:
                    ends.setdefault(edge, []).append((places, lines[side].length))
    edges = {e["id"]: Polyline(e["polyline"]) for e in plan["edges"]}
    shared = 0
    for edge, both in ends.items():
        if len(both) == 2:
            for (mine, length), (others, _) in (both, both[::-1]):
                for place in mine:
                    if edges[edge].distance(place) < 2 * PLACE:
                        nearest = min(np.linalg.norm(place - other) for other in others)
                        close(f"continuity of {edge}", nearest, 0, 1e-6 * length)
                        shared += 1
    return shared


def main(project_path, plan_path, schema_path, materials_path):
    project = tomllib.loads(pathlib.Path(project_path).read_text(encoding="utf-8"))
    plan = json.loads(pathlib.Path(plan_path).read_text(encoding="utf-8"))
    schema = json.loads(pathlib.Path(schema_path).read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    jsonschema.Draft7Validator(schema).validate(plan)
    check_records(plan)

    said = project["surface"]
    unit = METRES[said.get("units", project["project"].get("units", "m"))] * said.get("scale", 1.0)
    vertices, faces = read_obj(pathlib.Path(project_path).parent / said["mesh"], unit)
    check_surface(plan, project, vertices, faces)
    surface = Surface(vertices, faces)
    slope = project.get("split", {}).get("slope", [0.5, 2.0])
    for edge in plan["edges"]:
        line = Polyline(edge["polyline"])
        places = [surface.insert(tuple(line.places[i])) for i in (0, -1)]
        exact = surface.distances(places[0], [places[1]])[0]
        close(f"edge of {edge['id']}", exact, edge["length"], 2 * PLACE + ROUND)
    points = {p["id"]: tuple(p["position"]) for p in plan["points"]}
    for patch in plan["patches"]:
        check_patch(plan, patch, slope)
        lines = side_lines(plan, patch)
        check_members(plan, patch, lines, surface)
        check_cladding(patch, lines, surface)
        check_crossings(plan, patch)
        corners = [surface.insert(points[c]) for c in patch["corners"]]
        for i, name in enumerate("ef"):
            exact = surface.distances(corners[i], [corners[i + 2]])[0]
            close(f"diagonal of {patch['id']}", exact, patch["diagonals"][name], 2 * PLACE + ROUND)
        own = [m["length_surface"] for m in plan["members"] if m["patch"] == patch["id"]]
        longest = max(own + [patch["diagonals"]["e"], patch["diagonals"]["f"]])
        assert patch["curvature"]["longest_geodesic"] == longest
    shared = check_continuity(plan)
    plan_lamellae.check(plan, project, materials_path, close)
    counts = [len(plan[name]) for name in ("patches", "members", "crossings", "lamellae")]
    print(*counts, shared)
    for kind, off in sorted(worst.items()):
        print(f"{kind}: {off:.1e}")


if __name__ == "__main__":
    main(*sys.argv[1:])
