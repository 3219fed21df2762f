"""Polylines and lines, computed from the written numbers of a plan."""
import math

import numpy as np

# Largest error of a written length and of a written place, metres: half a unit of the last digit.
ROUND = 0.5e-9
PLACE = 0.87e-9


class Polyline:
    """Places joined by straight segments."""

    def __init__(self, places):
        self.places = np.array(places)
        self.steps = np.diff(self.places, axis=0)
        self.lengths = np.linalg.norm(self.steps, axis=1)
        self.arc = np.concatenate([[0], np.cumsum(self.lengths)])
        self.length = self.arc[-1]

    def at(self, arc):
        """The place at an arc length."""
        i = int(np.clip(np.searchsorted(self.arc, arc) - 1, 0, len(self.steps) - 1))
        share = np.clip((arc - self.arc[i]) / self.lengths[i], 0, 1)
        return self.places[i] + share * self.steps[i]

    def distance(self, place):
        """Distance of a place."""
        offset = place - self.places[:-1]
        share = np.clip(np.einsum("ij,ij->i", offset, self.steps) / self.lengths**2, 0, 1)
        return np.linalg.norm(offset - share[:, None] * self.steps, axis=1).min()


def angle_at(corner, left, right):
    """Angle between two directions from a corner, degrees."""
    a, b = np.subtract(left, corner), np.subtract(right, corner)
    cos = a @ b / np.linalg.norm(a) / np.linalg.norm(b)
    return math.degrees(math.acos(np.clip(cos, -1, 1)))


def slope_range(samples):
    """Smallest and largest slope of the chords between samples."""
    slopes = np.diff(samples[:, 1]) / np.diff(samples[:, 0])
    return slopes.min(), slopes.max()


def crossing_of_lines(first, second):
    """Shares of two planar segments at which their lines cross."""
    (a, b), (c, d) = np.array(first), np.array(second)
    return np.linalg.solve(np.array([b - a, c - d]).T, c - a)


def crossings(first, second):
    """Where two polylines on a surface meet: arc lengths on both, the angle in degrees and how
    well written numbers determine it (None on an edge of the mesh, where directions turn)."""
    p, u = first.places[:-1, None], first.steps[:, None]
    q, v = second.places[None, :-1], second.steps[None]
    uu, vv, uv = ((a * b).sum(-1) for a, b in ((u, u), (v, v), (u, v)))
    w = p - q
    wu, wv = (w * u).sum(-1), (w * v).sum(-1)
    det = uu * vv - uv * uv
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.where(det > 1e-12 * uu * vv, (uv * wv - vv * wu) / det, 0)
    # The closest points of two segments: clamp one, then the other, then the first again.
    for _ in range(2):
        s = np.clip(s, 0, 1)
        t = np.clip((wv + s * uv) / vv, 0, 1)
        s = np.clip((t * uv - wu) / uu, 0, 1)
    gap = np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1)
    found = []
    for i, j in zip(*np.nonzero(gap < 4 * PLACE)):
        on_first = first.arc[i] + s[i, j] * first.lengths[i]
        on_second = second.arc[j] + t[i, j] * second.lengths[j]
        # Neighbouring segments share a place: one meeting, told up to four times.
        if any(abs(on_first - hit[0]) < 1e-7 and abs(on_second - hit[1]) < 1e-7 for hit in found):
            continue
        inside = min(
            s[i, j] * first.lengths[i],
            (1 - s[i, j]) * first.lengths[i],
            t[i, j] * second.lengths[j],
            (1 - t[i, j]) * second.lengths[j],
        )
        angle = angle_at(0 * first.steps[i], first.steps[i], second.steps[j])
        shortest = min(first.lengths[i], second.lengths[j])
        sharpness = math.degrees(4 * PLACE / shortest) if inside > 1e-7 else None
        found.append((on_first, on_second, angle, sharpness))
    return found
