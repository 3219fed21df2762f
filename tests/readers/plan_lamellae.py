"""Lamellae of a plan: openings where members cross, lengths, masses by the project's material."""
import json
import math
import pathlib
import re

from plan_geometry import ROUND

UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
# A slide up to this is left to the clearance, metres.
NO_SLIDE = 2e-5


def length(value, unit):
    """A length of a project file in metres: a number in the unit, or a string with its own."""
    if isinstance(value, str):
        number, name = re.fullmatch(r"\s*([0-9.]+)\s*([a-z]+)\s*", value).groups()
        return float(number) * UNITS[name]
    return value * unit


def densities(project, materials_path):
    """kg/m^3 by name: what `egg materials` lists, and the project's own."""
    lines = pathlib.Path(materials_path).read_text(encoding="utf-8").splitlines()
    found = {m["name"]: m["density"] for m in map(json.loads, lines)}
    for name, said in project.get("materials", {}).items():
        value = said["density"]
        found[name] = float(value.split()[0]) if isinstance(value, str) else value
    return found


def check(plan, project, materials_path, close):
    """Everything that is cut."""
    unit = UNITS[project["project"].get("units", "m")]
    density = densities(project, materials_path)
    hardware = project.get("hardware", {})
    bolt = float(hardware.get("bolt", "M4").removeprefix("M")) * 1e-3
    shell = hardware.get("shell")
    slider = float(re.search(r"([0-9.]+)x", shell)[1]) * 1e-3 if shell else bolt
    clearance = length(project["fabrication"].get("clearance", 0.0002 / unit), unit)
    members = {m["id"]: m for m in plan["members"]}
    crossings = {c["id"]: c for c in plan["crossings"]}
    for lamella in plan["lamellae"]:
        name = lamella["id"]
        member = members[lamella["member"]]
        common = {k: v for k, v in project["lamella"].items() if not isinstance(v, dict)}
        said = common | project["lamella"].get(member["patch"], {})
        width, thickness = length(said["width"], unit), length(said["thickness"], unit)
        margin = project["fabrication"].get("end_margin")
        margin = width if margin is None else length(margin, unit)
        assert lamella["material"] == said["material"]
        close(f"section of {name}", lamella["width"], width, ROUND)
        close(f"section of {name}", lamella["thickness"], thickness, ROUND)
        close(f"section of {name}", lamella["end_margin"], margin, ROUND)
        whole = member["length_surface"] + 2 * margin
        close(f"length of {name}", lamella["length"], whole, 2.1 * ROUND)

        on = "on_" + member["family"]
        own = {c["id"]: c[on] for c in crossings.values() if c[member["family"]] == member["id"]}
        openings = lamella["openings"]
        assert sorted(o["crossing"] for o in openings) == sorted(own), name
        starts = [min(o.get("at", math.inf), o.get("from", math.inf), o.get("to", math.inf)) for o in openings]
        assert starts == sorted(starts), name
        cut = 0.0
        for opening in openings:
            at = own[opening["crossing"]]
            label = f"opening of {name} {opening['crossing']}"
            inner = not member["boundary"] and 1e-9 < at["surface"] < member["length_surface"] - 1e-9
            diameter = (slider if inner else bolt) + clearance
            close(label, opening["diameter"], diameter, 1.1 * ROUND)
            cut += math.pi / 4 * diameter**2
            slide = abs(at["surface"] - at["planar"])
            if member["boundary"]:
                # All connections of a side stay where they are.
                close(f"side of {name}", slide, 0, 1e-6 * member["length_surface"])
            if inner and slide > NO_SLIDE:
                assert opening["kind"] == "notch", label
                close(label, opening["from"], at["planar"], 0)
                close(label, opening["to"], at["surface"], 0)
                cut += diameter * slide
            else:
                assert opening["kind"] == "hole", label
                close(label, opening["at"], at["surface"], 0)
        # Ends are round; screws of plates go through all pieces.
        cut += (1 - math.pi / 4) * width**2
        for joint in (piece["joint"] for piece in lamella["pieces"]):
            cut += len(joint["screws"]) * math.pi / 4 * joint["hole"] ** 2 if joint else 0
        mass = (whole * width - cut) * thickness * density[said["material"]]
        close(f"mass of {name}", lamella["mass"], mass, 0.51e-6)
