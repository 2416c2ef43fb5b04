// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/slide/device_slide.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/slide/held_points.h"

namespace trismooth::cuda {

DeviceSlide::DeviceSlide(Context& context, const VertexOrder& order, Slidable slidable,
                         std::vector<std::uint8_t> reversed)
    : context_(&context),
      order_(&order),
      vertices_(context, slidable.vertices),
      points_(context, slidable.vertices.size()),
      held_after_(context, static_cast<std::size_t>(order.vertex_count() - order.free_count())),
      fan_of_(context, held_after_.size()) {
  std::vector<std::int32_t> numbers = find_packed_numbers(context, order, slidable.vertices);
  numbers_ = DeviceBuffer<std::int32_t>(context, numbers);
  slidable_ = PackedSlidable(std::move(slidable), reversed, std::move(numbers));
  elements_.emplace(context, slidable_.packed_elements());
  fan_of_.fill_bytes(0xFF);
  find_fans(context, numbers_, order.free_count(), fan_of_.data());
}

void DeviceSlide::begin(const Point2<double>* stored, const LocalFrame* frame, Storage storage) {
  found_ = {};  // (It waits for a thread that a run has left behind that broke off.)
  device_frame_ = frame;
  storage_ = storage;
  guard_.reset();
  is_judged_by_host_ = false;
  has_targets_ = false;
  has_lines_ = false;
  gather_points(*context_, stored, vertices_, points_.data());
  stored_.resize(points_.size());
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(&frame_, frame, sizeof(frame_), cudaMemcpyDeviceToHost, context_->stream()));
  points_.download(stored_);
  found_ = std::async(std::launch::async, [this] { return slidable_.chains(stored_, storage_, frame_); });
}

bool DeviceSlide::find_lines() {
  has_lines_ = true;
  local_ = found_.get();
  if (!local_.any()) {
    return false;
  }
  device_ = DeviceChains(*context_, local_, slidable_.numbers(), *elements_);
  return true;
}

template <class T>
void DeviceSlide::aim(const DeviceTargets<T>& targets, const Point2<double>* before) {
  if (targets_.size() < local_.sliders.size()) {
    targets_ = DeviceBuffer<FanTarget>(*context_, local_.sliders.size());
  }
  const MeshAims aims{targets.sums(), targets.size_weight(), targets.power(), targets.has_sizes()};
  launch_fan_targets(*context_, device_.view(), device_.places(), before,
                     static_cast<std::int32_t>(local_.sliders.size()), aims, targets.view().inverse_areas,
                     targets_.data());
  has_targets_ = true;
}
template void DeviceSlide::aim(const DeviceTargets<float>&, const Point2<double>*);
template void DeviceSlide::aim(const DeviceTargets<double>&, const Point2<double>*);

SlidPoints DeviceSlide::slid_points() {
  return {device_.view(),       device_.places().places, static_cast<std::int32_t>(local_.sliders.size()),
          order_->free_count(), stored_slid_.data(),     held_after_.data()};
}

void DeviceSlide::judge(const Point2<double>* before, bool guards, LineVerdict* verdict) {
  if (stored_slid_.size() < local_.vertices.size()) {
    stored_slid_ = DeviceBuffer<Point2<double>>(*context_, local_.vertices.size());
  }
  const SlidPoints slid = slid_points();
  place_slid(*context_, slid, before, static_cast<std::int32_t>(held_after_.size()), device_frame_, storage_, verdict);
  judge_lines(*context_, slid, elements_->held.data(), guards ? static_cast<std::int32_t>(elements_->held.size()) : 0,
              before, verdict);
}

void DeviceSlide::take_over() {
  if (guard_) {
    return;
  }
  places_.resize(local_.places.size());
  device_.download_places(places_);
  before_.resize(stored_.size());
  std::ranges::transform(stored_, before_.begin(), [this](Point2<double> point) { return frame_.enter(point); });
  slid_ = SlidVertices(local_, places_, frame_, storage_);
  after_ = before_;
  for (const SlidVertex& slid : slid_) {
    after_[static_cast<std::size_t>(slid.vertex)] = frame_.enter(slid.stored);
  }
  guard_.emplace(local_, places_, before_, after_);
}

void DeviceSlide::place_again(const Point2<double>* before) {
  points_.upload(after_);
  place_held(*context_, before, order_->free_count(), static_cast<std::int32_t>(held_after_.size()), points_, numbers_,
             held_after_.data());
}

std::int32_t DeviceSlide::put_back(std::int32_t packed) {
  const std::span<const std::int32_t> numbers = slidable_.numbers();
  if (by_packed_.empty()) {
    by_packed_.resize(numbers.size());
    std::iota(by_packed_.begin(), by_packed_.end(), 0);
    std::ranges::sort(by_packed_, {}, [&](std::int32_t v) { return numbers[static_cast<std::size_t>(v)]; });
  }
  const auto found = std::ranges::lower_bound(by_packed_, packed, {},
                                              [&](std::int32_t v) { return numbers[static_cast<std::size_t>(v)]; });
  after_[static_cast<std::size_t>(*found)] = before_[static_cast<std::size_t>(*found)];
  return *found;
}

void DeviceSlide::report(const LineVerdict& verdict, SmoothingResult& result) const {
  const LineDeviation deviation = is_judged_by_host_ ? guard_->deviation()
                                                     : LineDeviation{std::bit_cast<double>(verdict.distance),
                                                                     std::bit_cast<double>(verdict.relative)};
  const std::int64_t slid = guard_ ? guard_->slid_vertices() : static_cast<std::int64_t>(verdict.slid);
  result.moved_vertices += slid;
  result.sliding = lines();
  result.sliding->slid = slid;
  result.sliding->largest_deviation = std::ldexp(deviation.distance, frame_.exponent);
  result.sliding->relative_deviation = deviation.relative;
}

}  // namespace trismooth::cuda
