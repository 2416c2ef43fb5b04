#include "trismooth/smoothing/slide/slide_guard.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "trismooth/smoothing/guard/guard_rule.h"
#include "trismooth/smoothing/slide/slide_deviation.h"

namespace trismooth {

SlideGuard::SlideGuard(const SlideChains& chains, std::span<SlidePlace> places, std::span<const Point2<double>> before,
                       std::span<Point2<double>> after, bool guards_triangles)
    : chains_(chains),
      view_(chains.view()),
      places_(places),
      before_(before),
      after_(after),
      guards_triangles_(guards_triangles),
      slider_at_(chains.knots.size(), -1) {
  for (std::size_t s = 0; s < chains.sliders.size(); ++s) {
    slider_at_[static_cast<std::size_t>(chains.sliders[s].knot)] = static_cast<std::int32_t>(s);
  }
}

bool SlideGuard::has_slid(const Slider& slider) const {
  bool found = false;
  chains_.for_copies(slider, [&](std::int32_t /*copy*/, std::int32_t v) {
    found = found || !(after_[static_cast<std::size_t>(v)] == before_[static_cast<std::size_t>(v)]);
  });
  return found;
}

bool SlideGuard::put_back(std::int32_t number, std::vector<std::int32_t>& reverted) {
  const Slider& slider = chains_.sliders[static_cast<std::size_t>(number)];
  const bool slid = has_slid(slider);
  chains_.for_copies(slider, [&](std::int32_t /*copy*/, std::int32_t v) {
    const auto i = static_cast<std::size_t>(v);
    if (!(after_[i] == before_[i])) {
      after_[i] = before_[i];
      reverted.push_back(v);
    }
  });
  places_[static_cast<std::size_t>(slider.knot)] = chains_.places[static_cast<std::size_t>(slider.knot)];
  return slid;
}

std::int64_t SlideGuard::settle(std::vector<std::int32_t>& reverted) {
  std::int64_t rounds = 0;
  for (;;) {
    bool found = settle_links(reverted);
    found = settle_lines(reverted) || found;
    found = (guards_triangles_ && settle_triangles(reverted)) || found;
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
    chains_.for_copies(slider, [&](std::int32_t /*copy*/, std::int32_t v) {
      is_back = is_back || after_[static_cast<std::size_t>(v)] == before_[static_cast<std::size_t>(v)];
    });
    if (is_back && places_[knot].arc != chains_.places[knot].arc) {
      found = put_back(static_cast<std::int32_t>(s), reverted) || found;
    }
  }
  return found;
}

/// Judges the edges of the lines as they are now, between two knots of first copies each.
bool SlideGuard::settle_lines(std::vector<std::int32_t>& reverted) {
  SlideView by_allowed = view_;
  by_allowed.limits = chains_.allowed.data();
  SlideView by_length = view_;
  by_length.limits = chains_.lengths.data();
  std::vector<std::int32_t> beyond;  // sliders
  deviation_ = {};
  for (std::size_t c = 0; c < chains_.chains.size(); ++c) {
    const SlideChain& chain = chains_.chains[c];
    const ChainCurve curve(by_allowed, static_cast<std::int32_t>(c));
    const ChainCurve lengths(by_length, static_cast<std::int32_t>(c));
    const std::int32_t edges = chain.is_closed ? chain.count : chain.count - 1;
    for (std::int32_t i = 0; i < edges; ++i) {
      const bool is_seam = i + 1 == chain.count;
      const std::int32_t first = chain.first + i;
      const std::int32_t second = is_seam ? chain.first : first + 1;
      const SlidePlace from = places_[static_cast<std::size_t>(first)];
      SlidePlace to = places_[static_cast<std::size_t>(second)];
      if (is_seam) {
        to = {to.arc + chain.length, to.segment + chain.count};
      }
      bool is_good = from.arc < to.arc;
      for (std::int32_t copy = 0; is_good && copy < chain.copies; ++copy) {
        const auto at = [&](std::int32_t knot) {
          return after_[static_cast<std::size_t>(chains_.vertices[knot + copy * chain.count])];
        };
        LargestShare of_allowed;
        LargestShare of_length;
        for_deviations(curve, copy, from, at(first), to, at(second),
                       [&](double distance, std::int32_t j, std::int32_t k) {
                         deviation_.distance = std::max(deviation_.distance, distance);
                         of_allowed.add(distance, curve.limit(j, k));
                         of_length.add(distance, lengths.limit(j, k));
                       });
        deviation_.relative = std::max(deviation_.relative, of_length.value);
        // (Two vertices may be stored at the same place, of few digits.)
        is_good = of_allowed.value <= 1 && !(at(first) == at(second));
      }
      if (!is_good) {
        beyond.push_back(slider_at_[static_cast<std::size_t>(first)]);
        beyond.push_back(slider_at_[static_cast<std::size_t>(second)]);
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

bool SlideGuard::settle_triangles(std::vector<std::int32_t>& reverted) {
  const auto quotient = [](std::span<const Point2<double>> points, const Triangle& triangle) {
    const auto [a, b, c] = triangle;
    return shape_quotient(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)],
                          points[static_cast<std::size_t>(c)]);
  };
  const auto has_moved = [this](std::int32_t v) {
    return !(after_[static_cast<std::size_t>(v)] == before_[static_cast<std::size_t>(v)]);
  };
  double threshold = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : chains_.held_triangles) {
    if (std::ranges::any_of(triangle, has_moved)) {
      threshold = std::min(threshold, quotient(before_, triangle));
    }
  }
  std::vector<std::int32_t> offending;
  for (const Triangle& triangle : chains_.held_triangles) {
    if (std::ranges::any_of(triangle, has_moved) &&
        offends(quotient(before_, triangle), quotient(after_, triangle), threshold)) {
      std::ranges::copy_if(triangle, std::back_inserter(offending), has_moved);
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
    chains_.for_copies(slider, [&](std::int32_t /*copy*/, std::int32_t v) {
      count += after_[static_cast<std::size_t>(v)] == before_[static_cast<std::size_t>(v)] ? 0 : 1;
    });
  }
  return count;
}

}  // namespace trismooth
