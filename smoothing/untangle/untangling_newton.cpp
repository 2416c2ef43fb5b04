// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/untangling_newton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/rings/ring_elements.h"
#include "trismooth/smoothing/systems/conjugate_gradients.h"
#include "trismooth/smoothing/systems/host_rows.h"
#include "trismooth/smoothing/untangle/regularised_energy.h"

namespace trismooth {

namespace {

constexpr std::int64_t newton_grain = 1024;

/// What has an energy: a triangle, or the corner of a quadrilateral with the vertices before and behind it.
struct Term {
  Triangle corners;  ///< counter-clockwise; that of the quadrilateral first
  bool is_corner;    ///< of a quadrilateral

  const IdealTriangle& ideal() const { return is_corner ? IdealTriangle::corner : IdealTriangle::equilateral; }
};

void add_terms(const Triangle& triangle, std::vector<Term>& terms) {
  terms.push_back({triangle, false});
}
void add_terms(const MixedElement& quadrilateral, std::vector<Term>& terms) {
  for (std::size_t i = 0; i < 4; ++i) {
    terms.push_back({{quadrilateral[i], quadrilateral[(i + 1) % 4], quadrilateral[(i + 3) % 4]}, true});
  }
}

/// A term that a vertex is in.
struct TermAt {
  std::int64_t term;
  int corner;  ///< which of its corners the vertex is
  // The places of the vertex's row where the corners behind it and before it are.
  int next;
  int previous;
};

/// Adds the terms of an element that a vertex is in. `first`: of the element; `places`: its other vertices in the row.
void add_terms_at(std::int32_t v, std::int64_t first, const TriangleCorner<int>& places, std::span<const Term> terms,
                  std::vector<TermAt>& found) {
  const Triangle& corners = terms[static_cast<std::size_t>(first)].corners;
  found.push_back({first, corners[0] == v ? 0 : corners[1] == v ? 1 : 2, places.next, places.previous});
}
void add_terms_at(std::int32_t v, std::int64_t first, const QuadrilateralCorner<int>& places,
                  std::span<const Term> terms, std::vector<TermAt>& found) {
  int own = 0;
  while (terms[static_cast<std::size_t>(first + own)].corners[0] != v) {
    ++own;
  }
  found.push_back({first + own, 0, places.next, places.previous});
  found.push_back({first + (own + 1) % 4, 2, places.next, places.opposite});
  found.push_back({first + (own + 3) % 4, 1, places.opposite, places.previous});
}

/// A symmetric matrix of 2 x 2 blocks, one row a vertex that may move: the diagonal block and one for each place in its
/// ring, of opposite vertices, too.
struct BlockMatrix {
  struct Diagonal {
    double xx, xy, yy;
  };
  struct Block {
    double xx, xy, yx, yy;
  };
  std::vector<Diagonal> diagonal;
  std::vector<std::int64_t> offsets;  ///< of rows, into the next two
  std::vector<std::int32_t> columns;  ///< neighbours, then opposite vertices: no_corner where there is none
  std::vector<Block> blocks;
};

class RegularisedMinimiser {
 public:
  RegularisedMinimiser(const Patch& patch, std::span<Point2<double>> points, Workers& workers)
      : patch_(patch), points_(points), workers_(workers) {
    std::vector<std::int64_t> first_terms;
    for (const MixedElement& element : patch_.elements) {
      first_terms.push_back(std::ssize(terms_));
      with_kind(element, [&](const auto& corners) { add_terms(corners, terms_); });
    }
    find_target_areas();
    derivatives_.resize(terms_.size());
    gradient_.resize(static_cast<std::size_t>(patch_.free_count));
    lay_out_matrix(first_terms);
  }

  void run(int most_steps) {
    double smallest = smallest_determinant();
    energy_.size_weight = size_weight;
    energy_.epsilon = first_epsilon(smallest);
    int steps_after = 0;
    double smallest_then = smallest;
    double energy_then = std::numeric_limits<double>::infinity();
    for (int step = 1; step <= most_steps && std::isfinite(smallest); ++step) {
      const double before = differentiate();
      const bool has_moved = find_step() && search_line(before);
      const double after = has_moved ? value() : before;
      smallest = smallest_determinant();
      // Where it is untangled, the shapes get better for some steps more, while that is quick.
      if (smallest > 0 && (++steps_after > 6 || !(after < 0.99 * before) || !has_moved)) {
        break;
      }
      const double next = first_epsilon(smallest);
      if (step % stall_window == 0) {
        const bool stalls =
            !(after < 0.98 * energy_then) && !(smallest > smallest_then + 0.1 * std::abs(smallest_then));
        if (stalls) {
          break;
        }
        energy_then = after;
        smallest_then = smallest;
      }
      if (!has_moved && !(next < energy_.epsilon)) {
        break;
      }
      energy_.epsilon = std::min(next, energy_.epsilon);
    }
  }

 private:
  /// `first_terms`: of each element.
  void lay_out_matrix(std::span<const std::int64_t> first_terms) {
    const RingView rings = patch_.rings();
    matrix_.diagonal.resize(gradient_.size());
    matrix_.offsets.assign(1, 0);
    terms_at_offsets_.assign(1, 0);
    for (std::int32_t v = 0; v < patch_.free_count; ++v) {
      const std::span<const std::int32_t> elements = patch_.elements_around(v);
      const auto add = [&](const auto& places) {
        const std::int32_t element = elements[static_cast<std::size_t>(places.next)];
        add_terms_at(v, first_terms[static_cast<std::size_t>(element)], places, terms_, terms_at_);
      };
      rings.with_ring(v, [&](const auto& ring) {
        for_elements_around(
            ring, [](int place) { return place; }, add);
      });
      terms_at_offsets_.push_back(std::ssize(terms_at_));
      std::ranges::copy(rings[v], std::back_inserter(matrix_.columns));
      if (rings.has_quadrilaterals()) {
        std::ranges::copy(rings.mixed(v).opposites, std::back_inserter(matrix_.columns));
      }
      matrix_.offsets.push_back(std::ssize(matrix_.columns));
    }
    matrix_.blocks.resize(matrix_.columns.size());
  }

  /// Steps in which the energy or the smallest D must get better by some hundredths.
  static constexpr int stall_window = 8;

  /// lambda: enough that no triangle shrinks to a point where that is cheaper than to turn it.
  static constexpr double size_weight = 0.5;

  /// The size that each term is to have: the mean of the sizes around its corners, three times. So it follows a
  /// grading, and a triangle that the start has collapsed gets the size of its neighbours.
  void find_target_areas() {
    targets_.resize(terms_.size());
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      targets_[t] = 0.5 * std::abs(doubled_area(points_of(terms_[t].corners, points_)));
    }
    std::vector<double> sums(points_.size());
    std::vector<double> counts(points_.size());
    for (int pass = 0; pass < 3; ++pass) {
      std::ranges::fill(sums, 0);
      std::ranges::fill(counts, 0);
      for (std::size_t t = 0; t < targets_.size(); ++t) {
        for (const std::int32_t v : terms_[t].corners) {
          sums[v] += targets_[t];
          counts[v] += 1;
        }
      }
      for (std::size_t t = 0; t < targets_.size(); ++t) {
        const auto [a, b, c] = terms_[t].corners;
        targets_[t] = (sums[a] / counts[a] + sums[b] / counts[b] + sums[c] / counts[c]) / 3;
      }
    }
    double total = 0;
    for (const double target : targets_) {
      total += target;
    }
    const double least = 1e-9 * total / static_cast<double>(targets_.size());
    for (double& target : targets_) {
      target = std::max(target, least);
    }
  }

  std::int32_t term_count() const { return static_cast<std::int32_t>(terms_.size()); }

  RegularisedEnergy::Shape shape_of(std::int32_t t, std::span<const Point2<double>> points) const {
    const auto [a, b, c] = terms_[t].corners;
    return RegularisedEnergy::shape_of(points[a], points[b], points[c], targets_[t], terms_[t].ideal());
  }

  double smallest_determinant() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::int32_t t = 0; t < term_count(); ++t) {
      const double determinant = shape_of(t, points_).determinant;
      if (!(determinant >= smallest)) {
        smallest = determinant;
      }
    }
    return smallest;
  }

  static double first_epsilon(double smallest) {
    return smallest > 0 ? 1e-10 : std::sqrt(1e-6 + 0.04 * smallest * smallest);
  }

  template <class Value>
  double sum(std::int32_t count, const Value& value) {
    return ordered_sum(count, value, workers_);
  }

  double value_at(std::span<const Point2<double>> points) {
    return sum(term_count(), [&](std::int32_t t) { return energy_.value(shape_of(t, points)); });
  }
  double value() { return value_at(points_); }

  /// Gradient and matrix at the points; returns the energy.
  double differentiate() {
    const double total = sum(term_count(), [&](std::int32_t t) {
      derivatives_[t] = energy_.derivatives(shape_of(t, points_));
      return derivatives_[t].value;
    });
    workers_.for_blocks(patch_.free_count, newton_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        assemble_row(v);
      }
    });
    return total;
  }

  /// How corner i of a term comes into e (times the unit matrix); into t (times J): IdealTriangle::into_t.
  static constexpr double into_e[3] = {1, -0.5, -0.5};

  /// What a term gives to the block of its corners i and j.
  static BlockMatrix::Block block_of(const RegularisedEnergy::Derivatives& of, const std::array<double, 3>& into_t,
                                     int i, int j) {
    const double aa = into_e[i] * into_e[j];
    const double ab = into_e[i] * into_t[j];
    const double ba = into_t[i] * into_e[j];
    const double bb = into_t[i] * into_t[j];
    // et J, its transpose, and J^T tt J; J = (0 -1; 1 0).
    const double m[4] = {of.et[1], -of.et[0], of.et[3], -of.et[2]};
    return {
        aa * of.ee[0] + ab * m[0] + ba * m[0] + bb * of.tt[2], aa * of.ee[1] + ab * m[1] + ba * m[2] - bb * of.tt[1],
        aa * of.ee[1] + ab * m[2] + ba * m[1] - bb * of.tt[1], aa * of.ee[2] + ab * m[3] + ba * m[3] + bb * of.tt[0]};
  }

  static void add(BlockMatrix::Block& to, const BlockMatrix::Block& from) {
    to.xx += from.xx;
    to.xy += from.xy;
    to.yx += from.yx;
    to.yy += from.yy;
  }

  void assemble_row(std::int32_t v) {
    const std::span row = std::span(matrix_.blocks)
                              .subspan(static_cast<std::size_t>(matrix_.offsets[v]),
                                       static_cast<std::size_t>(matrix_.offsets[v + 1] - matrix_.offsets[v]));
    std::ranges::fill(row, BlockMatrix::Block{0, 0, 0, 0});
    BlockMatrix::Diagonal diagonal{0, 0, 0};
    Point2<double> gradient{0, 0};
    for (std::int64_t k = terms_at_offsets_[v]; k < terms_at_offsets_[v + 1]; ++k) {
      const auto [t, i, next, previous] = terms_at_[k];
      const RegularisedEnergy::Derivatives& of_term = derivatives_[t];
      const std::array<double, 3>& into_t = terms_[t].ideal().into_t;
      // J^T by_t = (by_t.y, -by_t.x).
      gradient.x += into_e[i] * of_term.by_e.x + into_t[i] * of_term.by_t.y;
      gradient.y += into_e[i] * of_term.by_e.y - into_t[i] * of_term.by_t.x;
      const BlockMatrix::Block own = block_of(of_term, into_t, i, i);
      diagonal.xx += own.xx;
      diagonal.xy += 0.5 * (own.xy + own.yx);
      diagonal.yy += own.yy;
      add(row[next], block_of(of_term, into_t, i, (i + 1) % 3));
      add(row[previous], block_of(of_term, into_t, i, (i + 2) % 3));
    }
    matrix_.diagonal[v] = diagonal;
    gradient_[v] = gradient;
  }

  /// The Newton step, into step_; false where there is none.
  bool find_step() {
    const auto free = static_cast<std::uint32_t>(patch_.free_count);  // which no_corner, without its sign, is beyond
    const auto apply = [&, free](const Point2<double>* x, std::int32_t v) {
      const BlockMatrix::Diagonal& d = matrix_.diagonal[v];
      Point2<double> sum{d.xx * x[v].x + d.xy * x[v].y, d.xy * x[v].x + d.yy * x[v].y};
      for (std::int64_t k = matrix_.offsets[v]; k < matrix_.offsets[v + 1]; ++k) {
        const std::int32_t other = matrix_.columns[k];
        if (static_cast<std::uint32_t>(other) < free) {
          const BlockMatrix::Block& b = matrix_.blocks[k];
          sum.x += b.xx * x[other].x + b.xy * x[other].y;
          sum.y += b.yx * x[other].x + b.yy * x[other].y;
        }
      }
      return sum;
    };
    const auto precondition = [&](std::int32_t v, Point2<double> r) {
      const BlockMatrix::Diagonal& d = matrix_.diagonal[v];
      const double determinant = d.xx * d.yy - d.xy * d.xy;
      if (!(determinant > 0)) {
        const double trace = d.xx + d.yy;
        return Point2<double>{r.x / trace, r.y / trace};
      }
      return Point2<double>{(d.yy * r.x - d.xy * r.y) / determinant, (d.xx * r.y - d.xy * r.x) / determinant};
    };
    step_.assign(gradient_.size(), {0, 0});
    residual_.resize(gradient_.size());
    const double reference = std::sqrt(sum(patch_.free_count, [&](std::int32_t v) {
      residual_[v] = {-gradient_[v].x, -gradient_[v].y};
      const Point2<double> answer = precondition(v, residual_[v]);
      return answer.x * residual_[v].x + answer.y * residual_[v].y;
    }));
    if (!(reference > 0) || !std::isfinite(reference)) {
      return false;
    }
    constexpr double tolerance = 0.1;  // a rough step at little cost beats an exact one
    constexpr int most_steps = 2000;
    HostRows rows(workers_);
    conjugate_gradients(apply, precondition, patch_.free_count, step_.data(), residual_.data(), reference, tolerance,
                        most_steps, rows);
    return true;
  }

  /// Moves the points along the step as far as the energy gets smaller.
  bool search_line(double before) {
    const double slope = sum(patch_.free_count,
                             [&](std::int32_t v) { return gradient_[v].x * step_[v].x + gradient_[v].y * step_[v].y; });
    if (!(slope < 0)) {
      return false;
    }
    trial_.assign(points_.begin(), points_.end());
    double length = 1;
    for (int halving = 0; halving < 30; ++halving, length *= 0.5) {
      for (std::int32_t v = 0; v < patch_.free_count; ++v) {
        trial_[v] = {points_[v].x + length * step_[v].x, points_[v].y + length * step_[v].y};
      }
      if (value_at(trial_) <= before + 1e-4 * length * slope) {
        std::ranges::copy(trial_, points_.begin());
        return true;
      }
    }
    return false;
  }

  const Patch& patch_;
  std::span<Point2<double>> points_;
  Workers& workers_;
  RegularisedEnergy energy_;
  std::vector<Term> terms_;
  std::vector<TermAt> terms_at_;                             ///< of one vertex that may move after the other
  std::vector<std::int64_t> terms_at_offsets_;               ///< of the vertices, into these
  std::vector<double> targets_;                              ///< A* of each term
  std::vector<RegularisedEnergy::Derivatives> derivatives_;  ///< of each term's energy, by e and t
  std::vector<Point2<double>> gradient_;
  BlockMatrix matrix_;
  std::vector<Point2<double>> step_;
  std::vector<Point2<double>> residual_;
  std::vector<Point2<double>> trial_;
};

}  // namespace

void minimise_regularised(const Patch& patch, std::span<Point2<double>> points, int most_steps, Workers& workers) {
  RegularisedMinimiser(patch, points, workers).run(most_steps);
}

}  // namespace trismooth
