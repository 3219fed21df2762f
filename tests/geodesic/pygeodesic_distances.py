"""Exact distances from vertices of a mesh by pygeodesic (Kirsanov's MMP).

usage: pygeodesic_distances.py MESH SOURCES... > distances
MESH: counts, then positions, then faces, white-space separated. One line of distances to
all vertices per source.
"""

import sys

import numpy as np
import pygeodesic.geodesic as geodesic

with open(sys.argv[1]) as file:
    words = file.read().split()
vertices, faces = int(words[0]), int(words[1])
points = np.array(words[2 : 2 + 3 * vertices], dtype=float).reshape(-1, 3)
triangles = np.array(words[2 + 3 * vertices :], dtype=int).reshape(-1, 3)
solver = geodesic.PyGeodesicAlgorithmExact(points, triangles)
for source in sys.argv[2:]:
    distances, _ = solver.geodesicDistances(np.array([int(source)]))
    print(*[repr(float(d)) for d in distances])
