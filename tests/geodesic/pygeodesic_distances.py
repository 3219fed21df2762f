"""Exact distances from vertices of a mesh by pygeodesic (Kirsanov's MMP).

usage: pygeodesic_distances.py [--time] MESH SOURCES... > distances
MESH: counts, then positions, then faces, white-space separated. One line of distances to
all vertices per source; with --time the seconds of processor time of each instead.
"""

import sys
import time

import numpy as np
import pygeodesic.geodesic as geodesic

timed = sys.argv[1] == "--time"
if timed:
    del sys.argv[1]
with open(sys.argv[1]) as file:
    words = file.read().split()
vertices, faces = int(words[0]), int(words[1])
points = np.array(words[2 : 2 + 3 * vertices], dtype=float).reshape(-1, 3)
triangles = np.array(words[2 + 3 * vertices :], dtype=int).reshape(-1, 3)
solver = geodesic.PyGeodesicAlgorithmExact(points, triangles)
for source in sys.argv[2:]:
    begin = time.process_time()
    distances, _ = solver.geodesicDistances(np.array([int(source)]))
    if timed:
        print(time.process_time() - begin)
    else:
        print(*[repr(float(d)) for d in distances])
