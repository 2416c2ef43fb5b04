// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/slide_guard.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/quality/element.h"
#include "trismooth/smoothing/guard/guard_rule.h"

namespace trismooth {

SlideGuard::SlideGuard(const SlideChains& chains, std::span<SlidePlace> places, std::span<const Point2<double>> before,
                       std::span<Point2<double>> after)
    : chains_(chains),
      view_(chains.view()),
      places_(places),
      before_(before),
      after_(after),
      slider_at_(chains.knots.size(), -1) {
  for (std::size_t s = 0; s < chains.sliders.size(); ++s) {
    slider_at_[chains.sliders[s].knot] = static_cast<std::int32_t>(s);
  }
}

bool SlideGuard::has_slid(const Slider& slider) const {
  bool found = false;
  chains_.for_copies(slider,
                     [&](std::int32_t /*copy*/, std::int32_t v) { found = found || !(after_[v] == before_[v]); });
  return found;
}

bool SlideGuard::put_back(std::int32_t number, std::vector<std::int32_t>& reverted) {
  const Slider& slider = chains_.sliders[number];
  const bool slid = has_slid(slider);
  chains_.for_copies(slider, [&](std::int32_t /*copy*/, std::int32_t v) {
    const auto i = static_cast<std::size_t>(v);
    if (!(after_[i] == before_[i])) {
      after_[i] = before_[i];
      reverted.push_back(v);
    }
  });
  places_[slider.knot] = chains_.places[slider.knot];
  return slid;
}

std::int64_t SlideGuard::settle(std::vector<std::int32_t>& reverted) {
  std::int64_t rounds = 0;
  for (;;) {
    bool found = settle_links(reverted);
    found = settle_lines(reverted) || found;
    if (!found) {
      return rounds;
    }
    ++rounds;
  }
}

bool SlideGuard::settle_links(std::vector<std::int32_t>& reverted) {
  bool found = false;
  for (std::size_t s = 0; s < chains_.sliders.size(); ++s) {
    const Slider& slider = chains_.sliders[s];
    const auto knot = static_cast<std::size_t>(slider.knot);
    bool is_back = false;
    chains_.for_copies(slider,
                       [&](std::int32_t /*copy*/, std::int32_t v) { is_back = is_back || after_[v] == before_[v]; });
    if (is_back && places_[knot].arc != chains_.places[knot].arc) {
      found = put_back(static_cast<std::int32_t>(s), reverted) || found;
    }
  }
  return found;
}

/// Judges the edges of the lines as they are now, between two knots of first copies each.
bool SlideGuard::settle_lines(std::vector<std::int32_t>& reverted) {
  std::vector<std::int32_t> beyond;  // sliders
  deviation_ = {};
  const auto after = [this](std::int32_t v) { return after_[v]; };
  for (std::size_t c = 0; c < chains_.chains.size(); ++c) {
    const SlideChain& chain = chains_.chains[c];
    const ChainCurve curve(view_, static_cast<std::int32_t>(c));
    const std::int32_t edges = chain.is_closed ? chain.count : chain.count - 1;
    for (std::int32_t i = 0; i < edges; ++i) {
      const JudgedEdge edge = judge_edge(curve, view_, places_.data(), i, after);
      deviation_.distance = std::max(deviation_.distance, edge.deviation.distance);
      deviation_.relative = std::max(deviation_.relative, edge.deviation.relative);
      if (!edge.is_good) {
        const std::int32_t first = chain.first + i;
        beyond.push_back(slider_at_[first]);
        beyond.push_back(slider_at_[static_cast<std::size_t>(i + 1 == chain.count ? chain.first : first + 1)]);
      }
    }
  }
  bool found = false;
  for (const std::int32_t slider : beyond) {
    if (slider >= 0) {
      found = put_back(slider, reverted) || found;
    }
  }
  return found;
}

std::int64_t SlideGuard::settle_held_elements(double threshold_of_others, std::vector<std::int32_t>& reverted) {
  std::int64_t rounds = 0;
  while (put_back_held_elements(threshold_of_others, reverted)) {
    ++rounds;
  }
  return rounds;
}

bool SlideGuard::put_back_held_elements(double threshold_of_others, std::vector<std::int32_t>& reverted) {
  const auto has_moved = [this](std::int32_t v) { return v != no_corner && !(after_[v] == before_[v]); };
  double threshold = threshold_of_others;
  for (const MixedElement& element : chains_.held_elements()) {
    if (std::ranges::any_of(element, has_moved)) {
      threshold = std::min(threshold, quotient_at(element, before_));
    }
  }
  std::vector<std::int32_t> offending;
  for (const MixedElement& element : chains_.held_elements()) {
    if (std::ranges::any_of(element, has_moved) &&
        offends(quotient_at(element, before_), quotient_at(element, after_), threshold)) {
      std::ranges::copy_if(element, std::back_inserter(offending), has_moved);
    }
  }
  if (offending.empty()) {
    return false;
  }
  std::ranges::sort(offending);
  bool found = false;
  for (std::size_t s = 0; s < chains_.sliders.size(); ++s) {
    bool is_one = false;
    chains_.for_copies(chains_.sliders[s], [&](std::int32_t /*copy*/, std::int32_t v) {
      is_one = is_one || std::ranges::binary_search(offending, v);
    });
    if (is_one) {
      found = put_back(static_cast<std::int32_t>(s), reverted) || found;
    }
  }
  return found;
}

std::int64_t SlideGuard::slid_vertices() const {
  std::int64_t count = 0;
  for (const Slider& slider : chains_.sliders) {
    chains_.for_copies(slider,
                       [&](std::int32_t /*copy*/, std::int32_t v) { count += after_[v] == before_[v] ? 0 : 1; });
  }
  return count;
}

}  // namespace trismooth
