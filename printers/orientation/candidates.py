"""Ways a part can stand: on the faces of its convex hull that it touches with an area."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from printers.arrays import Floats
from printers.measure.surface import Surface
from printers.orientation.turning import Turning

MOST = 12
"""Orientations that are compared; a sound part has some six."""

ALIKE = 0.01
"""Two orientations whose figures differ by less than this share are taken for mirror images."""

SAME_FACE = 1e-3  # of a unit normal: facets of the hull that differ less lie on one face
LEAST_CONTACT = 0.02  # of the footprint: less, such as a facet of a fillet, carries nothing
MOST_FACES = 200
"""That are looked at: more than have a fiftieth of a footprint each, also around a long bar."""

MOST_PIECES = 4  # into which the rounding of normals may part one face
FLAT = 1e-3  # mm above the bed
BANDS = 8  # of slope, by which two orientations are compared


@dataclass(frozen=True)
class Stance:
    """A way to stand.

    Attributes:
        turning: Which direction of the file points up.
        contact: Area that lies on the bed, mm².
        height: mm.
        alike: How many other orientations are mirror images of it.
    """

    turning: Turning
    contact: float
    height: float
    alike: int = 0


def stances(surface: Surface) -> tuple[Stance, ...]:
    """As the part stands in its file first, then by the area on the bed, mirror images once."""
    found: list[tuple[Stance, Floats]] = []
    as_it_is = Turning((0.0, 0.0, 1.0))
    for turning in (as_it_is, *_on_faces(surface)):
        stance, figures = _measured(surface, turning)
        same = next((i for i, (_, other) in enumerate(found) if _alike(figures, other)), None)
        if same is None:
            found.append((stance, figures))
        elif stance.turning.name != found[same][0].turning.name:
            known, figures = found[same]
            found[same] = _counted(known), figures
    return tuple(stance for stance, _ in found[:MOST])


def _counted(stance: Stance) -> Stance:
    return Stance(stance.turning, stance.contact, stance.height, stance.alike + 1)


def _on_faces(surface: Surface) -> list[Turning]:
    """The turnings onto faces of the hull, those with the largest contact first."""
    turnings = onto_faces(surface.vertices)
    contacts = np.array([_contact(surface, turning) for turning in turnings])
    footprints = np.array([_footprint(surface.vertices, turning) for turning in turnings])
    order = np.argsort(-contacts, kind="stable")
    return [turnings[i] for i in order if contacts[i] > LEAST_CONTACT * footprints[i]]


def onto_faces(vertices: Floats) -> list[Turning]:
    """The turnings of (n, 3) onto those faces of their hull that may carry a part.

    A part touches the bed with no more than the face it lies on: small faces, as most of a round
    part's are, drop out before the part itself is looked at.
    """
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(vertices)
    except QhullError:  # all in one plane
        return []
    normals, areas = _faces(hull.equations[:, :3], vertices[hull.simplices])
    largest = np.sort(np.argsort(-areas, kind="stable")[:MOST_FACES])
    turnings = [_down(normal) for normal in normals[largest]]
    corners, least = vertices[hull.vertices], LEAST_CONTACT / MOST_PIECES
    return [
        turning
        for turning, area in zip(turnings, areas[largest], strict=True)
        if area >= least * _footprint(corners, turning)
    ]


def _faces(normals: Floats, corners: Floats) -> tuple[Floats, Floats]:
    """Normals (k, 3) and areas (k,) of the faces that triangles (m, 3), (m, 3, 3) make up."""
    first, second = np.diff(corners, axis=1).swapaxes(0, 1)
    areas = np.linalg.norm(np.cross(first, second), axis=1) / 2
    bins = np.round(normals / SAME_FACE).astype(np.int64)
    _, one, face = np.unique(bins, axis=0, return_index=True, return_inverse=True)
    return normals[one], np.bincount(face.ravel(), areas).astype(np.float64)


def _down(normal: Floats) -> Turning:
    """That in which the face with the outward normal lies on the bed."""
    x, y, z = (float(value) + 0.0 for value in np.round(-normal / np.linalg.norm(normal), 9))
    length = float(np.linalg.norm((x, y, z)))
    return Turning((x / length, y / length, z / length))


def _contact(surface: Surface, turning: Turning) -> float:
    heights = surface.vertices @ np.array(turning.up)
    low = (heights <= heights.min() + FLAT)[surface.triangles].all(axis=1)
    return float(-(surface.area_vectors[low] @ np.array(turning.up)).sum())


def _footprint(vertices: Floats, turning: Turning) -> float:
    """Of the rectangle around (n, 3) on the bed, mm²."""
    return float(np.prod(np.ptp(vertices @ turning.matrix[:2].T, axis=0)))


def _measured(surface: Surface, turning: Turning) -> tuple[Stance, Floats]:
    """The stance and its figures, which mirror images have in common."""
    up = np.array(turning.up)
    placed = surface.vertices @ turning.matrix.T
    extent = np.ptp(placed, axis=0)
    slopes = np.histogram(surface.normals @ up, BANDS, (-1, 1), weights=surface.areas)[0]
    centre = (surface.corners.mean(axis=1) @ up - placed[:, 2].min()) @ surface.areas
    middle = centre / surface.areas.sum()
    contact = _contact(surface, turning)
    figures = np.array([contact / extent[2], extent[2], middle, *slopes / surface.areas.sum()])
    return Stance(turning, contact, float(extent[2])), figures


def _alike(first: Floats, second: Floats) -> bool:
    return bool(np.allclose(first, second, rtol=ALIKE, atol=ALIKE / 2))
