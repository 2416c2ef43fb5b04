# SPDX-License-Identifier: BSD-3-Clause
"""refuse_mesh_types.py COMPILER INCLUDE...: a type that smooth(), plan() and quality() do not take, of meshes or of arrays, ends
in one error, a sentence of ours; types that they take compile beside each other."""

import subprocess
import sys

compiler, *includes = sys.argv[1:]

SOURCE = """
#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <trismooth/mesh_io/halfedge/mesh_quality.h>
#include <trismooth/mesh_io/halfedge/smooth_mesh.h>
#include <trismooth/quality/quality.h>
#include <trismooth/smoothing/keep_never_worse.h>
#include <trismooth/smoothing/smooth.h>
using namespace trismooth;
template <class P>
struct Traits : OpenMesh::DefaultTraits { using Point = P; };
template <class P>
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits<P>>;
struct ByValue : OpenMesh::Vec2d {
  using OpenMesh::Vec2d::Vec2d;
  double operator[](std::size_t) const { return 0; }
};
struct Other {};
struct Node { int id; double x, y; };
struct OtherNode : Node {};
void use(Other& other, std::vector<double>& numbers, const std::vector<std::int32_t>& triangles,
         Mesh<OpenMesh::Vec3f>& mesh, const Mesh<OpenMesh::Vec3f>& constant, Mesh<OpenMesh::Vec4d>& four,
         Mesh<OpenMesh::Vec3i>& whole, Mesh<ByValue>& by_value) {
  std::vector<std::array<double, 2>> points;
  std::vector<Node> nodes;
  std::vector<OtherNode> others;
  const std::vector<OtherNode> const_others;
  Eigen::MatrixXf rows_or_columns_of_float;
  Eigen::MatrixXd rows_or_columns;
  const std::vector<Node> const_nodes;
  std::vector<bool> bits;
  %s;
}
"""

NO_MESH = "this is no OpenMesh mesh with an array kernel"
POINTS = "a point of this OpenMesh mesh is to be two or three numbers"
CONST = "this OpenMesh mesh is const"
NODES = "the type of these points does not say"
MATRIX = "the type of this matrix does not say"
BITS = "std::vector<bool> has its flags in bits"
NUMBERS = "fixed, other_cells and regions of MeshConstraints"
REFUSED = [
    ("smooth(other)", NO_MESH),
    ("smooth(numbers, MeshConstraints{}, SmoothingOptions{})", NO_MESH),
    ("(void)plan(other, SmoothingOptions{})", NO_MESH),
    ("(void)quality(points)", NO_MESH),
    ("smooth(constant)", CONST),
    ("smooth(four)", POINTS),
    ("(void)quality(whole)", POINTS),
    ("smooth(by_value, SmoothingOptions{})", POINTS),
    ("smooth(mesh, {.regions = OpenMesh::FPropHandleT<float>()})", NUMBERS),
    ("smooth(mesh, {.fixed = OpenMesh::FPropHandleT<char>()})", NUMBERS),
    ("smooth(mesh, {.fixed = points})", NUMBERS),
    ("smooth(mesh, {.regions = std::vector<long>(3)})", NUMBERS),
    ("smooth(nodes, triangles)", NODES),
    ("(void)quality(others, triangles)", NODES),
    ("(void)quality(rows_or_columns_of_float, triangles)", MATRIX),
    ("keep_never_worse(others, const_others, triangles)", NODES),
    ("plan(3, triangles).smooth(const_nodes)", NODES),
    ("smooth(rows_or_columns, triangles)", MATRIX),
    ("Constraints{.fixed = bits}", BITS),
    ("smooth(mesh, {.regions = [](OpenMesh::FaceHandle) { return 0.5F; }})", NUMBERS),
]
TAKEN = """smooth(mesh); smooth(mesh, SmoothingOptions{}); smooth(mesh, MeshConstraints{}); smooth(mesh, {}, {});
  smooth(mesh, {.fixed_ids = triangles}, {.max_sweeps = 3}); std::vector<bool> flags; const auto& same = flags;
  smooth(mesh, {.fixed = flags, .other_cells = same, .regions = triangles});
  smooth(mesh, {.fixed = [](OpenMesh::SmartVertexHandle v) { return v.is_boundary(); },
                .regions = [](OpenMesh::FaceHandle f) { return f.idx(); }});
  smooth(mesh, {.fixed = "fixed", .regions = OpenMesh::FPropHandleT<bool>()}); plan(constant).smooth(mesh); (void)quality(constant);
  (void)quality(mesh, {.worst_count = 1}); smooth(points, triangles); smooth(xy_points(numbers), triangles, {}, {});
  smooth(points, triangles, SmoothingOptions{}); (void)quality(points, triangles); plan(3, triangles).smooth(points);
  smooth(xy_points(&nodes[0].x, nodes.size(), sizeof(Node)), triangles);
  std::vector<unsigned long> ids; std::vector<short> tags; std::vector<float> lengths; SmoothingOptions sized;
  sized.mean_ratio.target_lengths = lengths; smooth(points, triangles, Constraints{.fixed_ids = ids, .regions = tags}, sized);
  smooth(points, triangles, Constraints{.fixed_ids = triangles}); (void)other; (void)four; (void)whole; (void)by_value; (void)const_nodes; smooth(point_rows(rows_or_columns), triangles); (void)bits"""


def errors_of(statement):
    command = [compiler, "-std=c++20", "-fsyntax-only", *(f"-I{folder}" for folder in includes), "-x", "c++", "-"]
    run = subprocess.run(command, input=SOURCE % statement, capture_output=True, text=True, check=False)
    return [line for line in run.stderr.splitlines() if "error:" in line]


def sentences(errors):
    """What is said after the place in the source: ours begin with the name of the project."""
    return sorted(error.partition("trismooth: ")[2][:24] or error for error in errors)


# All in one run, which takes 3 s: an error that is not ours, or that comes twice, is one too many.
found = errors_of("; ".join(statement for statement, _ in REFUSED))
if sentences(found) != sorted(sentence[:24] for _, sentence in REFUSED):
    sys.exit("\n".join(["expected one sentence for each of the statements:", *found]))
if refused := errors_of(TAKEN):
    sys.exit("\n".join(["refused:", *refused]))
