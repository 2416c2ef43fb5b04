// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "trismooth/base/enum_text.h"
#include "trismooth/base/real_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/method.h"
#include "trismooth/smoothing/proposal.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

class Backend;

/// The paper's iteration forms.
enum class Form : std::uint8_t {
  swap,      ///< Form A (Jacobi): every move of a sweep is computed from the positions before the sweep (equation 1)
  in_place,  ///< Form B (coloured Gauss-Seidel): a move sees the neighbours already moved in this sweep (equation 2);
             ///< vertices are visited colour by colour, and no two of one colour share an edge
};

/// How the data of the paper's versions lie in the memory of the device (CUDA single-block and cdp only).
/// Execution::resident has a way of its own, and goes with `aos`.
enum class Layout : std::uint8_t {
  aos,  ///< an array of structures: x, y and all else of a vertex side by side
  soa,  ///< a structure of arrays: all x, all y, ...
};

/// How the sweeps run on the device (CUDA only).
enum class Execution : std::uint8_t {
  resident,      ///< the fastest: kernels that stay on the device until the smoothing stops
  single_block,  ///< one block of threads for the whole mesh: the paper's GPU version, of Method::smart and laplacian
  cdp,  ///< kernels started by a kernel (CUDA dynamic parallelism): the paper's CDP version, of the same methods
};

/// The order in which a sweep of Form B visits the vertices.
enum class Order : std::uint8_t {
  colour,     ///< by colour: the same result every time
  unordered,  ///< as threads happen to run (CUDA single-block and cdp only): the result may differ from run to run
};

/// Who finds neighbours, orientation and constraints. The results are the same bit for bit.
enum class Topology : std::uint8_t {
  automatic,  ///< the device where it smooths by Execution::resident and its memory suffices; else halfedges, where
              ///< files of up to 16,000,000 triangles are smoothed; else the host
  host,       ///< the host, in parallel, from the triangle list
  halfedge,   ///< for files: the host, in parallel, by way of an OpenMesh mesh. Else as `host`
  device,     ///< the device, in parallel, from the triangle list; where the backend has none, as `automatic`
};

/// The working precision of the sweeps. The guard always evaluates in double.
enum class Precision : std::uint8_t {
  double_precision,  ///< float64
  single_precision,  ///< float32: faster on most devices; the caller's coordinates keep their type
};

/// Whether free vertices around inverted elements are moved apart before the sweeps.
enum class Untangle : std::uint8_t {
  automatic,  ///< with Method::mean_ratio, whose energy needs valid elements
  off,
  on,
};

/// Which vertices a sweep evaluates. The result is the same bit for bit. The CUDA executions single_block and cdp
/// evaluate all, as the paper does, whatever is asked for.
enum class Evaluation : std::uint8_t {
  changed,  ///< those whose closed neighbourhood changed since their last evaluation
  all,      ///< every free vertex in every sweep, as in the paper: for comparison
};

/// The shapes that the mean-ratio method aims at.
enum class TargetShape : std::uint8_t {
  uniform,  ///< equilateral
  input,    ///< as flat as the edges nearby are in the input: for layers that are flat on purpose
};

/// What becomes of triangles that are flat on purpose: stretches of triangles four times as long as high and more, all
/// in one direction, with angles near 90 degrees: boundary layers, thin insulation.
enum class Layers : std::uint8_t {
  automatic,  ///< their vertices are held; other stretches that are flat in one direction are smoothed, and counted.
              ///< With TargetShape::input, which aims at such shapes, as `smooth`
  keep,       ///< the vertices of these are held as well
  smooth,     ///< nothing is looked for: all are smoothed
};

/// What a progress callback answers.
enum class Progress : std::uint8_t {
  proceed,  ///< go on
  stop,     ///< end here: StopReason::cancelled
};

template <>
struct EnumText<Form> {
  static constexpr std::string_view what = "form";
  static constexpr std::array<std::pair<Form, std::string_view>, 2> texts{{{Form::swap, "a"}, {Form::in_place, "b"}}};
};
template <>
struct EnumText<Layout> {
  static constexpr std::string_view what = "layout";
  static constexpr std::array<std::pair<Layout, std::string_view>, 2> texts{
      {{Layout::aos, "aos"}, {Layout::soa, "soa"}}};
};
template <>
struct EnumText<Execution> {
  static constexpr std::string_view what = "execution";
  static constexpr std::array<std::pair<Execution, std::string_view>, 3> texts{
      {{Execution::resident, "resident"}, {Execution::single_block, "single-block"}, {Execution::cdp, "cdp"}}};
};
template <>
struct EnumText<Order> {
  static constexpr std::string_view what = "order";
  static constexpr std::array<std::pair<Order, std::string_view>, 2> texts{
      {{Order::colour, "colour"}, {Order::unordered, "unordered"}}};
};
template <>
struct EnumText<Topology> {
  static constexpr std::string_view what = "topology";
  static constexpr std::array<std::pair<Topology, std::string_view>, 4> texts{{{Topology::automatic, "auto"},
                                                                               {Topology::host, "host"},
                                                                               {Topology::halfedge, "halfedge"},
                                                                               {Topology::device, "device"}}};
};
template <>
struct EnumText<Precision> {
  static constexpr std::string_view what = "precision";
  static constexpr std::array<std::pair<Precision, std::string_view>, 2> texts{
      {{Precision::double_precision, "double"}, {Precision::single_precision, "single"}}};
};
template <>
struct EnumText<TargetShape> {
  static constexpr std::string_view what = "target";
  static constexpr std::array<std::pair<TargetShape, std::string_view>, 2> texts{
      {{TargetShape::uniform, "uniform"}, {TargetShape::input, "input-shape"}}};
};

template <>
struct EnumText<Layers> {
  static constexpr std::string_view what = "setting of layers";
  static constexpr std::array<std::pair<Layers, std::string_view>, 3> texts{
      {{Layers::automatic, "auto"}, {Layers::keep, "keep"}, {Layers::smooth, "smooth"}}};
};
template <>
struct EnumText<Evaluation> {
  static constexpr std::string_view what = "evaluation";
  static constexpr std::array<std::pair<Evaluation, std::string_view>, 2> texts{
      {{Evaluation::changed, "changed"}, {Evaluation::all, "all"}}};
};

/// What steers Method::mean_ratio alone.
struct MeanRatioOptions {
  /// How much the sizes of elements count beside their shapes, from 0. Without target_lengths it is multiplied by the
  /// fifth power of the mesh's mean shape: the sizes of a distorted mesh say little.
  double size_weight = 1;
  /// The power of 1 / shape in the energy, up to 8: the higher, the more the worst elements count. 0: 3 where the
  /// mesh's mean shape is 0.8 or more, else 2.
  int power = 0;
  TargetShape target = TargetShape::uniform;
  /// For meshes that move in time, and are about right before the first sweep: moves die away towards the least gain
  /// that is worth one, there is no first stage, and the sweeps end where nothing moves, or at max_sweeps, not 0. So
  /// where no triangle was inverted the result goes with the points as smoothly as these go. Otherwise it may jump by a
  /// few hundredths of an edge where a vertex begins to move, or the smoothing takes one sweep more.
  bool steady = false;
  /// The sizes to aim at in place of those that the mesh has: for every vertex the edge length wanted around it, float
  /// or double, in any unit, since with so many triangles only their relations can be met. Lengths below a millionth of
  /// the largest count as that; those of vertices in no triangle do not count. Empty: none. The caller owns the numbers
  /// and keeps them for as long as the options are used, by a plan, too; they are read in every smooth(), which throws
  /// std::invalid_argument where they are not as many as vertices, with every method, or where one is not a positive
  /// number.
  RealView target_lengths{};
};

template <>
struct EnumText<Untangle> {
  static constexpr std::string_view what = "setting of untangling";
  static constexpr std::array<std::pair<Untangle, std::string_view>, 3> texts{
      {{Untangle::automatic, "auto"}, {Untangle::off, "off"}, {Untangle::on, "on"}}};
};

/// Everything that steers a smoothing. The defaults are those of the command line.
struct SmoothingOptions {
  Method method = Method::smart;
  /// A method of the caller's own in place of `method`, which stays as it is by default then. On the CPU, for whole
  /// meshes, where no vertices slide. See proposal.h.
  Proposal proposal{};
  Form form = Form::in_place;
  Layout layout = Layout::aos;
  Execution execution = Execution::resident;
  Order order = Order::colour;
  Topology topology = Topology::automatic;
  Precision precision = Precision::double_precision;
  MeanRatioOptions mean_ratio{};
  Evaluation evaluation = Evaluation::changed;
  /// The never-worse guard: when the sweeps are over, the vertices go back whose moves made an element invalid, or
  /// worse than it was and worse than the worst of all elements around moved vertices was.
  bool guard = true;
  /// Before the sweeps, find places for the free vertices in which no triangle is inverted or degenerate. Costs one
  /// pass where none is. `automatic`: with Method::mean_ratio.
  Untangle untangle = Untangle::automatic;
  /// Layers are looked for once, in the points that come first: a plan holds the same vertices from then on.
  Layers layers = Layers::automatic;
  std::int64_t max_sweeps = 1000;  ///< 0: no limit
  /// Stop after a sweep in which every move was at most this part of the vertex's (root mean square) edge length.
  double tolerance = 1e-6;
  /// How long a call of smooth() may take, all in all: what it finds out about the mesh, untangling, targets, sweeps
  /// and guard. Sweeps end early enough for the guard, which a first call can only guess at; where there is no time for
  /// one, nothing moves. What an untangling has mended by then is kept. A sweep that has begun is made whole, which
  /// matters where a proposal takes long; a cancel waits for it as well. Over parts and ranks the clock is looked at
  /// between sweeps and before the first one. A plan() has no limit, nor what its first smooth() makes ready for later
  /// ones.
  double time_limit_seconds = std::numeric_limits<double>::infinity();
  std::optional<double> target_quality{};  ///< stop as soon as the smallest shape of all elements reaches this
  int threads = 0;                ///< 0: one for each core; most_threads() at most. The result does not depend on it
  bool record_min_shape = false;  ///< fill SweepRecord::min_shape; costs a pass over the mesh after every sweep
  /// Called for every sweep in order, from the thread that called; `stop` ends the smoothing with a valid mesh, as that
  /// sweep left it. A device hands the records over in batches, some hundred times a second, so that a callback costs
  /// nothing; where it says stop the device has gone on meanwhile and makes the sweeps up to there again.
  std::function<Progress(const SweepRecord&)> progress{};
  /// Asked in every phase but the guard, many times a second, from the thread that called: true ends the call as if its
  /// time were up. plan() asks as well, and throws PlanCancelled. What it throws leaves the call, and the points as
  /// they were. Over ranks every rank may have one of its own.
  std::function<bool()> cancel{};
  /// Who runs the sweeps; the caller owns it. Null: the CPU backend.
  const Backend* backend = nullptr;

  /// What moves vertices: the name of the method, "proposal" where that is the caller's own.
  [[nodiscard]] std::string_view method_name() const { return proposal ? "proposal" : to_string(method); }

  /// Whether the smallest shape of the mesh is found after every sweep: for a quality target or for the record.
  [[nodiscard]] bool measures_shape() const { return record_min_shape || target_quality.has_value(); }

  /// Whether inverted elements are untangled before the sweeps.
  [[nodiscard]] bool untangles() const {
    return untangle == Untangle::on || (untangle == Untangle::automatic && method == Method::mean_ratio);
  }

  /// Whether the backend is asked to find the topology before the host does.
  [[nodiscard]] bool prefers_topology_of_device() const {
    return topology == Topology::device ||
           // By the paper's version one thread of the device finds it, which is for comparison.
           (topology == Topology::automatic && execution == Execution::resident);
  }

  /// What becomes of layers with the method and its target.
  [[nodiscard]] Layers used_layers() const {
    const bool aims_at_layers = method == Method::mean_ratio && mean_ratio.target == TargetShape::input;
    return layers == Layers::automatic && aims_at_layers ? Layers::smooth : layers;
  }

  /// Whether sizes are asked for, and heard.
  [[nodiscard]] bool aims_at_sizes() const {
    return method == Method::mean_ratio && !mean_ratio.target_lengths.empty();
  }

  /// Throws std::invalid_argument for values out of range (a negative count, a NaN, more than most_threads()) and for
  /// combinations that no backend has: an execution other than resident with a method other than smart and laplacian,
  /// Order::unordered with Form::swap or Execution::resident, Layout::soa with Execution::resident, a proposal with
  /// another method or without the energy that it is accepted by.
  void validate() const;
};

}  // namespace trismooth
