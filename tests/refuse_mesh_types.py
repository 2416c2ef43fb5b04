"""refuse_mesh_types.py COMPILER INCLUDE...: a type that smooth(mesh), plan(mesh) and quality(mesh) do not take ends in one
error, a sentence of ours; types of meshes that they take compile beside the functions over flat arrays."""

import subprocess
import sys

compiler, *includes = sys.argv[1:]

SOURCE = """
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <trismooth/mesh_io/halfedge/mesh_quality.h>
#include <trismooth/mesh_io/halfedge/smooth_mesh.h>
#include <trismooth/quality/quality.h>
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
void use(Other& other, std::vector<double>& numbers, const std::vector<std::int32_t>& triangles,
         Mesh<OpenMesh::Vec3f>& mesh, const Mesh<OpenMesh::Vec3f>& constant, Mesh<OpenMesh::Vec4d>& four,
         Mesh<OpenMesh::Vec3i>& whole, Mesh<ByValue>& by_value) {
  std::vector<std::array<double, 2>> points;
  %s;
}
"""

NO_MESH = "this is no OpenMesh mesh with an array kernel"
POINTS = "a point of this OpenMesh mesh is to be two or three numbers"
CONST = "this OpenMesh mesh is const"
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
  smooth(points, triangles, Constraints{.fixed_ids = triangles}); (void)other; (void)four; (void)whole; (void)by_value"""


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
