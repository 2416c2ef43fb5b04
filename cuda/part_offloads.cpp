// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/part_offloads.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/packing/renumbering.h"
#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/cuda/parts/ghost_transport.h"
#include "trismooth/cuda/parts/part_kernels.h"
#include "trismooth/cuda/primitives/falling_key.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/sweeps/smallest_quotient.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/rings/packed_rings.h"

namespace trismooth::cuda {

namespace {

/// The host's, which has its own name for what is packed.
using HostRings = trismooth::PackedRings;

/// While more than one in so many vertices moves, all are evaluated: see sweeps_of_all.cu.
constexpr std::int64_t smallest_share = 8;

/// The rings as they are packed on the host, in records.
SlottedRings<std::int32_t> uploaded(Context& context, const HostRings& rings) {
  if (rings.free_count() == 0) {
    return {};
  }
  const auto vertices = static_cast<std::size_t>(rings.vertex_count());
  std::vector<std::uint32_t> offsets(vertices + 1);
  for (std::size_t v = 0; v < offsets.size(); ++v) {
    offsets[v] = static_cast<std::uint32_t>(rings.offsets[std::min(v, rings.offsets.size() - 1)]);
  }
  std::vector<std::int32_t> same_number(vertices);
  std::iota(same_number.begin(), same_number.end(), 0);
  const DeviceRings from{DeviceBuffer<std::uint32_t>(context, offsets),
                         DeviceBuffer<std::int32_t>(context, std::span<const std::int32_t>(rings.neighbours)),
                         DeviceBuffer<std::int32_t>(context, std::span<const std::int32_t>(rings.opposites))};
  const DeviceBuffer<std::int32_t> input(context, same_number);
  const Renumbering numbers(context, from.view(), input.data(), rings.free_count());
  return from.has_quadrilaterals() ? slotted_mixed<std::int32_t>(context, numbers, from.opposites.data())
                                   : slotted<std::int32_t>(context, numbers);
}

/// What of one colour goes to others and comes from them, on the device.
template <class T>
struct ColourExchange {
  DeviceBuffer<std::int32_t> sent;  ///< vertices
  DeviceBuffer<PointRecord<T>> out;
  DeviceBuffer<std::int32_t> ghosts;
  DeviceBuffer<PointRecord<T>> in;
  DeviceBuffer<std::uint32_t> offsets;
  DeviceBuffer<std::int32_t> around;
  std::vector<GhostTransport::Message> sends;
  std::vector<GhostTransport::Message> receives;

  ColourExchange(Context& context, const VertexExchange& lists, const Halo& halo)
      : sent(context, lists.sends.vertices),
        out(context, lists.sends.vertices.size()),
        ghosts(context, lists.receives.vertices),
        in(context, lists.receives.vertices.size()) {
    std::vector<std::uint32_t> begins{0};
    std::vector<std::int32_t> vertices;
    for (const std::int32_t ghost : lists.receives.vertices) {
      const std::span<const std::int32_t> neighbours = halo.around_ghosts()[ghost];
      vertices.insert(vertices.end(), neighbours.begin(), neighbours.end());
      begins.push_back(static_cast<std::uint32_t>(vertices.size()));
    }
    offsets = DeviceBuffer<std::uint32_t>(context, begins);
    around = DeviceBuffer<std::int32_t>(context, vertices);
    for (std::size_t i = 0; i < halo.part().neighbours.size(); ++i) {
      const int part = halo.part().neighbours[i].part;
      add(part, lists.sends, i, out, sends);
      add(part, lists.receives, i, in, receives);
    }
  }

 private:
  static void add(int part, const VertexLists& lists, std::size_t i, DeviceBuffer<PointRecord<T>>& points,
                  std::vector<GhostTransport::Message>& messages) {
    if (const std::size_t count = lists.begins[i + 1] - lists.begins[i]; count > 0) {
      messages.push_back(
          {part, reinterpret_cast<std::byte*>(points.data() + lists.begins[i]), count * sizeof(PointRecord<T>)});
    }
  }
};

template <class T>
class PartSweeps final : public SweepOffload<T> {
 public:
  PartSweeps(int device, const HostRings& rings, const Halo& halo, const SmoothingOptions& options)
      : device_(device), rings_(rings), options_(options) {
    const DeviceScope scope(device_);
    transport_ = make_ghost_transport(halo.part());
    context_.emplace();
    records_ = uploaded(*context_, rings);
    swaps_ = options.form == Form::swap;
    for (std::size_t i = 0; i < (swaps_ ? 2U : 1U); ++i) {
      points_[i] = DeviceBuffer<PointRecord<T>>(*context_, static_cast<std::size_t>(rings.vertex_count()));
      marks_[i] = DeviceBuffer<std::uint32_t>(*context_, (static_cast<std::size_t>(rings.free_count()) + 31) / 32);
    }
    for (const VertexExchange& exchange : halo.of_colours()) {
      exchanges_.emplace_back(*context_, exchange, halo);
    }
    sums_ = DeviceBuffer<SweepSums>(*context_, 1);
    context_->synchronize();
  }
  ~PartSweeps() override {
    // What is freed belongs to that device.
    after_.begin(device_);
  }

  void begin(std::span<const Point2<T>> points, const MeanRatioTargets<T>& targets) override {
    const DeviceScope scope(device_);
    static_assert(sizeof(Point2<T>) == sizeof(PointRecord<T>));
    current_ = 0;
    for (DeviceBuffer<PointRecord<T>>& buffer : points_) {
      buffer.upload({reinterpret_cast<const PointRecord<T>*>(points.data()), buffer.size()});
    }
    method_ = {options_.method, {}, {}};
    if (options_.method == Method::mean_ratio) {
      const auto vertices = static_cast<std::size_t>(rings_.vertex_count());
      method_.targets.inverse_areas = kept(inverse_areas_, targets.inverse_areas, vertices);
      method_.targets.largest_shares =
          kept(largest_shares_, targets.largest_shares, static_cast<std::size_t>(rings_.free_count()));
      method_.targets.scales = kept(scales_, targets.scales, 1);
      method_.targets.edges = targets.edges == nullptr ? nullptr : kept(edges_, targets.edges, vertices);
    }
    context_->synchronize();
  }

  void begin_stage() override {
    const DeviceScope scope(device_);
    for (DeviceBuffer<std::uint32_t>& marks : marks_) {
      marks.fill_bytes(0);
    }
    visit_ = Visit::all;
  }

  SweepTally<T> sweep(const MeanRatioStep<T>& step) override {
    const DeviceScope scope(device_);
    method_.step = step;
    sums_.fill_bytes(0);
    with_rings([this](const auto& rings) { this->sweep_over(rings); });
    SweepSums found{};
    sums_.download({&found, 1});
    choose_visit(static_cast<std::int64_t>(found.moved), step);
    return tally_of<T>(found);
  }

  T smallest_quotient() override {
    const DeviceScope scope(device_);
    if (rings_.free_count() == 0) {
      return std::numeric_limits<T>::infinity();
    }
    sums_.fill_bytes(0);
    with_rings([this](const auto& rings) {
      launch_smallest_quotient(rings, array(current_), sums_.data(), context_->stream());
    });
    SweepSums found{};
    sums_.download({&found, 1});
    return found.min_quotient == 0 ? std::numeric_limits<T>::infinity()
                                   : static_cast<T>(from_falling_key(found.min_quotient));
  }

  void end(std::span<Point2<T>> points) override {
    const DeviceScope scope(device_);
    points_[current_].download(
        {reinterpret_cast<PointRecord<T>*>(points.data()), static_cast<std::size_t>(rings_.first_fixed())});
  }

 private:
  PointArray<T> array(std::size_t buffer) { return {points_[buffer].data()}; }

  /// Calls body() with the records, of triangles or of a mesh with quadrilaterals.
  template <class Body>
  void with_rings(const Body& body) const {
    rings_.opposites.empty() ? body(records_.view()) : body(records_.mixed_view());
  }

  /// Queues a sweep.
  template <class Rings>
  void sweep_over(const Rings& rings) {
    const std::size_t next = swaps_ ? 1 - current_ : current_;
    PartBatch<T, Rings> batch{rings,
                              array(current_),
                              array(next),
                              marks_[current_].data(),
                              marks_[next].data(),
                              0,
                              0,
                              static_cast<T>(options_.tolerance)};
    cudaStream_t stream = context_->stream();
    for (std::size_t colour = 0; colour < exchanges_.size() && 2 * colour + 2 < rings_.batches.size(); ++colour) {
      ColourExchange<T>& exchange = exchanges_[colour];
      visit(batch, 2 * colour);
      launch_gathering(batch.to, exchange.sent.data(), static_cast<std::int32_t>(exchange.sent.size()),
                       exchange.out.data(), stream);
      transport_->start(exchange.sends, exchange.receives, stream);
      visit(batch, 2 * colour + 1);
      transport_->finish(stream);
      const ArrivedGhosts ghosts{exchange.ghosts.data(), static_cast<std::int32_t>(exchange.ghosts.size()),
                                 exchange.offsets.data(), exchange.around.data()};
      launch_arrival(exchange.in.data(), ghosts, batch.from, batch.to,
                     visit_ == Visit::all ? nullptr : batch.next_marks, stream);
    }
    current_ = next;
  }

  template <class V>
  const V* kept(DeviceBuffer<V>& buffer, const V* values, std::size_t count) {
    if (buffer.size() != count) {
      buffer = DeviceBuffer<V>(*context_, count);
    }
    buffer.upload({values, count});
    return buffer.data();
  }

  template <class Rings>
  void visit(PartBatch<T, Rings>& batch, std::size_t number) {
    batch.begin = rings_.batches[number];
    batch.end = rings_.batches[number + 1];
    launch_part_batch(method_, batch, visit_, sums_.data(), context_->stream());
  }

  /// How the next sweep visits vertices. Whether it marks is said before it begins, and so which one is the last to
  /// evaluate every vertex.
  void choose_visit(std::int64_t moved, const MeanRatioStep<T>& step) {
    const bool visits_all =
        options_.evaluation == Evaluation::all || (options_.method == Method::mean_ratio && !step.is_last);
    const bool many_move = moved > rings_.free_count() / smallest_share;
    if (visits_all) {
      visit_ = Visit::all;
    } else if (visit_ == Visit::all) {
      visit_ = many_move ? Visit::all : Visit::all_and_mark;
    } else {
      visit_ = Visit::marked_and_mark;
    }
  }

  DeviceAtEnd after_;  ///< the last to go
  int device_;
  const HostRings& rings_;
  const SmoothingOptions& options_;
  bool swaps_ = false;
  std::optional<Context> context_;
  std::unique_ptr<GhostTransport> transport_;
  SlottedRings<std::int32_t> records_;
  DeviceBuffer<PointRecord<T>> points_[2];
  DeviceBuffer<std::uint32_t> marks_[2];
  std::size_t current_ = 0;
  std::vector<ColourExchange<T>> exchanges_;
  DeviceBuffer<SweepSums> sums_;
  DeviceBuffer<T> inverse_areas_;
  DeviceBuffer<T> largest_shares_;
  DeviceBuffer<MeanRatioScales<T>> scales_;
  DeviceBuffer<EdgeTensor<T>> edges_;
  MethodInUse<T> method_;
  Visit visit_ = Visit::all;
};

class PartOffloads final : public SweepOffloads {
 public:
  explicit PartOffloads(int device) : device_(device) {
    const DeviceScope scope(device_);
    name_ = require_device();
  }

  std::unique_ptr<SweepOffload<float>> in_single(const HostRings& rings, const Halo& halo,
                                                 const SmoothingOptions& options) override {
    return std::make_unique<PartSweeps<float>>(device_, rings, halo, options);
  }
  std::unique_ptr<SweepOffload<double>> in_double(const HostRings& rings, const Halo& halo,
                                                  const SmoothingOptions& options) override {
    return std::make_unique<PartSweeps<double>>(device_, rings, halo, options);
  }
  std::string backend() const override { return "cuda"; }
  std::string device() const override { return name_; }

 private:
  int device_;
  std::string name_;
};

}  // namespace

std::unique_ptr<SweepOffloads> part_offloads(const MeshPart& part) {
  require_device();
  int devices = 0;
  TRISMOOTH_CUDA_CHECK(cudaGetDeviceCount(&devices));
  return part_offloads_on(part.place_on_machine % devices);
}

std::unique_ptr<SweepOffloads> part_offloads_on(int device) {
  return std::make_unique<PartOffloads>(device);
}

}  // namespace trismooth::cuda
