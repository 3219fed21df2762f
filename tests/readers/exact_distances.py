"""Exact distances between arbitrary points of a mesh by pygeodesic (Kirsanov's MMP), which knows
vertices only: points are made vertices by splitting the face or edge that they lie on. The pieces
are flat parts of what was there, so the surface and all its distances stay the same.
"""
import numpy as np
import pygeodesic.geodesic as geodesic

# Points are written to the nanometre: a point this close to an edge or a vertex is meant to be on it.
SNAP = 2e-9


def read_obj(path, factor):
    """Vertices in metres and triangles of a file that holds nothing but these."""
    vertices, faces = [], []
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) * factor for w in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(w.split("/")[0]) - 1 for w in words[1:]]
            assert len(corners) == 3, "the meshes of the projects are triangles"
            faces.append(corners)
    return np.array(vertices), faces


class Surface:
    """A triangle mesh that takes points as vertices."""

    def __init__(self, vertices, faces):
        self.vertices = [np.array(v) for v in vertices]
        self.original = np.array(vertices)[np.array(faces)]
        self.pieces = {i: [tuple(f)] for i, f in enumerate(faces)}
        self.face_of = {}
        for i, f in enumerate(faces):
            self._register(i, tuple(f))
        self.known = {}
        self.solver = None
        edges = self.original - np.roll(self.original, 1, axis=1)
        self.mean_edge = np.linalg.norm(edges, axis=2).mean()

    def _register(self, face, triangle):
        for k in range(3):
            edge = frozenset((triangle[k], triangle[(k + 1) % 3]))
            self.face_of.setdefault(edge, set()).add((face, triangle))

    def _replace(self, face, old, new):
        self.pieces[face].remove(old)
        for k in range(3):
            self.face_of[frozenset((old[k], old[(k + 1) % 3]))].discard((face, old))
        for triangle in new:
            self.pieces[face].append(triangle)
            self._register(face, triangle)

    def insert(self, point):
        """Index of the vertex at a point of the surface."""
        key = tuple(point)
        if key not in self.known:
            self.known[key] = self._insert(np.array(point))
            self.solver = None
        return self.known[key]

    def _insert(self, point):
        face = int(np.argmin(distances_to_triangles(point, self.original)))
        corners = self.original[face]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        normal /= np.linalg.norm(normal)
        off = (point - corners[0]) @ normal
        assert abs(off) < SNAP, ("a point is off the surface", point, off)
        point = point - off * normal
        triangle = max(
            self.pieces[face], key=lambda t: min(heights(point, [self.vertices[i] for i in t], normal))
        )
        for i in triangle:
            if np.linalg.norm(self.vertices[i] - point) < SNAP:
                return i
        index = len(self.vertices)
        low = heights(point, [self.vertices[i] for i in triangle], normal)
        k = int(np.argmin(low))
        if low[k] >= SNAP:
            self.vertices.append(point)
            a, b, c = triangle
            self._replace(face, triangle, [(a, b, index), (b, c, index), (c, a, index)])
            return index
        # On the edge behind the k-th corner: onto it exactly, and both faces there are split.
        p, q = triangle[k], triangle[(k + 1) % 3]
        start, along = self.vertices[p], self.vertices[q] - self.vertices[p]
        self.vertices.append(start + along * ((point - start) @ along) / (along @ along))
        for beside, old in list(self.face_of[frozenset((p, q))]):
            i = next(i for i in range(3) if {old[i], old[(i + 1) % 3]} == {p, q})
            a, b, c = old[i], old[(i + 1) % 3], old[(i + 2) % 3]
            self._replace(beside, old, [(a, index, c), (index, b, c)])
        return index

    def distances(self, source, targets):
        """Exact distances from one vertex to others."""
        if self.solver is None:
            faces = [t for pieces in self.pieces.values() for t in pieces]
            self.solver = geodesic.PyGeodesicAlgorithmExact(np.array(self.vertices), np.array(faces))
        found, _ = self.solver.geodesicDistances(np.array([source]), np.array(targets))
        return found


def heights(point, corners, normal):
    """Signed distances of a point from the three edges of a triangle, inside positive."""
    result = []
    for k in range(3):
        a, b = corners[k], corners[(k + 1) % 3]
        inward = np.cross(normal, b - a)
        result.append((point - a) @ inward / np.linalg.norm(inward))
    return result


def distances_to_triangles(point, triangles):
    """Distances of one point from many triangles."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    off = np.einsum("ij,ij->i", point - a, normal)
    foot = point - off[:, None] * normal
    inside = np.ones(len(triangles), bool)
    nearest = np.full(len(triangles), np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        along = q - p
        inside &= np.einsum("ij,ij->i", np.cross(along, foot - p), normal) >= 0
        t = np.clip(np.einsum("ij,ij->i", point - p, along) / np.einsum("ij,ij->i", along, along), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(point - p - t[:, None] * along, axis=1))
    return np.where(inside, np.abs(off), nearest)
