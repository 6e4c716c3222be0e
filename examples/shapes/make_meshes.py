#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Writes the meshes of this folder: a ring that stands (OBJ) and a hare of eleven balls that cross each other (PLY).
import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))


def ring(radius=1.0, tube=0.36, around=28, across=12):
    points, quads = [], []
    for i in range(around):
        for k in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * k / across
            r = radius + tube * math.cos(b)
            points.append((r * math.cos(a), r * math.sin(a) + radius + tube, tube * math.sin(b)))
            i1, k1 = (i + 1) % around, (k + 1) % across
            quads.append((i * across + k, i1 * across + k, i1 * across + k1, i * across + k1))
    return points, quads


def ball(center, radii, lean=0.0, around=12, across=8):
    """An ellipsoid, its upper end leaning towards +x."""
    points, faces = [], []
    for i in range(across + 1):
        a = math.pi * i / across
        for k in range(around):
            b = 2 * math.pi * k / around
            x, y, z = radii[0] * math.sin(a) * math.cos(b), radii[1] * math.cos(a), radii[2] * math.sin(a) * math.sin(b)
            points.append((center[0] + x + lean * y, center[1] + y, center[2] + z))
    for i in range(across):
        for k in range(around):
            k1 = (k + 1) % around
            corners = [i * around + k, i * around + k1, (i + 1) * around + k1, (i + 1) * around + k]
            if i == 0:
                corners = [corners[0], corners[2], corners[3]]
            elif i == across - 1:
                corners = corners[:3]
            faces.append(tuple(corners))
    return points, faces


def hare():
    parts = [
        ball((0, 0.95, 0), (1.35, 0.95, 0.85)),
        ball((-0.75, 0.95, 0), (0.85, 0.95, 0.8)),
        ball((0.75, 1.05, 0), (0.7, 1.0, 0.65)),
        ball((1.15, 2.05, 0), (0.68, 0.55, 0.5)),
        ball((1.6, 1.95, 0), (0.36, 0.33, 0.33)),
        ball((0.75, 3.1, 0.27), (0.27, 0.95, 0.17), lean=-0.3),
        ball((0.75, 3.1, -0.27), (0.27, 0.95, 0.17), lean=-0.3),
        ball((-1.65, 1.0, 0), (0.36, 0.36, 0.36)),
        ball((1.0, 0.28, 0.4), (0.55, 0.28, 0.27)),
        ball((1.0, 0.28, -0.4), (0.55, 0.28, 0.27)),
        ball((-0.5, 0.25, 0), (0.9, 0.25, 0.85)),
    ]
    points, faces = [], []
    for own, corners in parts:
        faces += [tuple(len(points) + c for c in face) for face in corners]
        points += own
    return points, faces


def write_obj(name, points, faces):
    with open(os.path.join(FOLDER, name), "w", encoding="ascii") as out:
        out.write("# examples/shapes/make_meshes.py\n")
        for p in points:
            out.write("v %.3f %.3f %.3f\n" % p)
        for face in faces:
            out.write("f " + " ".join(str(c + 1) for c in face) + "\n")


def write_ply(name, points, faces):
    with open(os.path.join(FOLDER, name), "w", encoding="ascii") as out:
        out.write("ply\nformat ascii 1.0\ncomment examples/shapes/make_meshes.py\n")
        out.write("element vertex %d\nproperty float x\nproperty float y\nproperty float z\n" % len(points))
        out.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(faces))
        for p in points:
            out.write("%.3f %.3f %.3f\n" % p)
        for face in faces:
            out.write(" ".join(str(c) for c in (len(face), *face)) + "\n")


write_obj("ring.obj", *ring())
write_ply("hare.ply", *hare())
