// SPDX-License-Identifier: BSD-3-Clause
// What is wrong on one rank is said on all of them, alike; no coordinate has moved then, and the ranks go on.

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/smoothing/errors.h"

#include "catch.h"
#include "mpi/pieces.h"
#include "support/fake_backend.h"
#include "support/same_bits.h"
#include "support/says.h"
#include "support/test_meshes.h"

using namespace mpi_tests;
using trismooth::Method;
using trismooth::Progress;
using trismooth::SmoothingOptions;
using trismooth::mpi::Gather;
using trismooth::mpi::Plan;

namespace {

constexpr std::int32_t columns_a_rank = 4;
constexpr std::int32_t rows = 7;

/// A strip of squares for each rank, side by side, each cut into triangles: neighbours share a column of vertices.
RandomMesh strips(double jitter) {
  RandomMesh mesh;
  mesh.mesh = test_meshes::jittered_grid(columns_a_rank * ranks() + 1, rows, jitter, 1);
  return mesh;
}

std::vector<int> ranks_of_strips() {
  const std::int32_t squares = columns_a_rank * ranks();
  std::vector<int> rank_of_triangle;
  for (std::int32_t square = 0; square < squares * (rows - 1); ++square) {
    rank_of_triangle.insert(rank_of_triangle.end(), 2, square % squares / columns_a_rank);
  }
  return rank_of_triangle;
}

/// All that a rank hands in. What is not said is as in a mesh that is smoothed.
struct Job {
  Piece piece = plain_piece(strips(0.3), ranks_of_strips());
  SmoothingOptions options;
  trismooth::Sliding slide{};
  Gather gather = Gather::never;
  std::vector<double> lengths;
  bool is_float = false;
  int numbers = 2;  ///< of a point
  double height = 0;
  double slope = 0;  ///< of heights along x

  Job() {
    options.threads = 1;
    options.max_sweeps = 5;
  }
};

/// How it ended on this rank.
struct Outcome {
  std::string error;  ///< its type and its message; empty: none
  bool has_moved = false;
  std::vector<double> xy;
  trismooth::SmoothingResult result;
};

std::string text_of(const std::exception& error) {
  const auto is = [&](auto* type) { return dynamic_cast<decltype(type)>(&error) != nullptr; };
  const char* type = is(static_cast<const std::invalid_argument*>(nullptr))    ? "invalid_argument"
                     : is(static_cast<const trismooth::MeshError*>(nullptr))   ? "MeshError"
                     : is(static_cast<const trismooth::DeviceError*>(nullptr)) ? "DeviceError"
                     : is(static_cast<const std::logic_error*>(nullptr))       ? "logic_error"
                     : is(static_cast<const std::runtime_error*>(nullptr))     ? "runtime_error"
                                                                               : "exception";
  return std::string(type) + ": " + error.what();
}

template <class T>
void smooth(Plan& plan, const Job& job, Outcome& outcome) {
  std::vector<T> numbers;
  for (std::size_t i = 0; i < job.piece.xy.size(); i += 2) {
    numbers.insert(numbers.end(), {static_cast<T>(job.piece.xy[i]), static_cast<T>(job.piece.xy[i + 1])});
    if (job.numbers == 3) {
      numbers.push_back(static_cast<T>(job.height + job.slope * job.piece.xy[i]));
    }
  }
  const std::vector<T> before = numbers;
  const auto compare = [&] {
    outcome.has_moved = !std::ranges::equal(numbers, before, [](T a, T b) { return same_bits(a, b); });
    outcome.xy.assign(numbers.begin(), numbers.end());
  };
  try {
    outcome.result = job.numbers == 3 ? plan.smooth(trismooth::xyz_points(numbers)) : plan.smooth(numbers);
  } catch (...) {
    compare();
    throw;
  }
  compare();
}

Outcome run(const Job& job) {
  Outcome outcome;
  SmoothingOptions options = job.options;
  options.mean_ratio.target_lengths = job.lengths;
  trismooth::Constraints constraints = job.piece.constraints();
  constraints.slide = job.slide;
  try {
    Plan plan(MPI_COMM_WORLD, job.piece.mesh(), constraints, options, job.gather);
    if (job.is_float) {
      smooth<float>(plan, job, outcome);
    } else {
      smooth<double>(plan, job, outcome);
    }
  } catch (const std::exception& error) {
    outcome.error = text_of(error);
  }
  return outcome;
}

/// The rank on which something is wrong: the last one.
int spoiled() {
  return ranks() - 1;
}

using Change = std::function<void(Job&)>;

/// What is wrong with how a job ends in which `all` is done on all ranks, and `spoil` on one.
std::string fault(const std::string& type, const std::vector<std::string>& words, const Change& all,
                  const Change& spoil) {
  Job job;
  all(job);
  if (rank() == spoiled()) {
    spoil(job);
  }
  const Outcome outcome = run(job);
  if (!say_the_same(outcome.error)) {
    return said_by_any("the ranks do not say the same; this one: " + outcome.error);
  }
  std::string wrong = outcome.has_moved ? "points have moved" : "";
  if (outcome.error.substr(0, type.size() + 2) != type + ": ") {
    wrong += "not of the type " + type + ": " + outcome.error;
  }
  for (const std::string& word : words) {
    wrong += says(outcome.error, word) ? "" : "\"" + word + "\" is not in: " + outcome.error;
  }
  // The ranks have not lost step.
  static const Outcome good = run(Job());
  const Outcome again = run(Job());
  wrong += good.error.empty() && good.has_moved ? "" : "the good mesh fails: " + good.error;
  wrong += again.error.empty() && same_bits(good.xy, again.xy) ? "" : "the good mesh after it: " + again.error;
  return said_by_any(wrong);
}

void nothing(Job& /*job*/) {}

/// Checks that an error of `type`, whose message names the spoiled rank and has these words, is on all ranks.
void check_refused(const std::string& type, std::vector<std::string> words, const Change& spoil,
                   const Change& all = nothing) {
  if (ranks() > 1) {
    words.push_back("rank " + std::to_string(spoiled()));
  }
  CHECK(fault(type, words, all, spoil) == "");
}

/// The same of what two ranks do not agree on: whoever finds it says so, and one rank alone has nobody to differ from.
void check_disagreement(const std::string& type, const std::vector<std::string>& words, const Change& spoil,
                        const Change& all = nothing) {
  if (ranks() > 1) {
    CHECK(fault(type, words, all, spoil) == "");
  }
}

/// A vertex of the spoiled rank that the rank before it has as well.
std::size_t shared_vertex(const Piece& piece) {
  const auto column = columns_a_rank * spoiled();
  const auto place =
      std::ranges::find_if(piece.global, [&](std::int32_t v) { return v % (columns_a_rank * ranks() + 1) == column; });
  return static_cast<std::size_t>(place - piece.global.begin());
}

}  // namespace

TEST_CASE("lists of the wrong length on one rank are refused on all") {
  check_refused("invalid_argument", {"points", "expected one for each of"}, [](Job& job) { job.piece.xy.resize(4); });
  check_refused("invalid_argument", {"owners has 1 entries"}, [](Job& job) { job.piece.owners = {0}; });
  check_refused("invalid_argument", {"ghost_triangles has 1 entries"}, [](Job& job) { job.piece.ghosts = {0}; });
  check_refused("invalid_argument", {"triangle_ids has 1 entries"}, [](Job& job) { job.piece.triangle_ids = {0}; });
  check_refused("invalid_argument", {"fixed"}, [](Job& job) { job.piece.fixed = {0}; });
  check_refused("invalid_argument", {"other_cells"}, [](Job& job) { job.piece.other_cells = {0}; });
  check_refused("invalid_argument", {"regions"}, [](Job& job) { job.piece.regions = {0}; });
  check_refused("invalid_argument", {"fixed vertex 100000"}, [](Job& job) { job.piece.fixed_ids = {100000}; });
  check_refused(
      "invalid_argument", {"target_lengths has 1 entries"},
      [](Job& job) {
        job.options.method = Method::mean_ratio;
        job.lengths = {1};
      },
      [](Job& job) {
        job.options.method = Method::mean_ratio;
        job.lengths.assign(job.piece.ids.size(), 1);
      });
}

TEST_CASE("ids that are none on one rank are refused on all") {
  check_refused("invalid_argument", {"vertex_ids", "local vertex 3", "-5", "must not be negative"},
                [](Job& job) { job.piece.ids[3] = -5; });
  check_refused("invalid_argument", {"vertex_ids", "local vertices 2 and 3", "same id"},
                [](Job& job) { job.piece.ids[3] = job.piece.ids[2]; });
  check_refused("MeshError", {}, [](Job& job) { job.piece.triangles[2][1] = 100000; });
  check_refused("MeshError", {}, [](Job& job) { job.piece.triangles[2][1] = -1; });
  check_refused("MeshError", {}, [](Job& job) { job.piece.triangles[2][1] = job.piece.triangles[2][0]; });
}

TEST_CASE("owners that are no ranks, or that ranks disagree about, are refused on all") {
  const Change say_owners = [](Job& job) { job.piece.owners.assign(job.piece.ids.size(), 0); };
  check_refused(
      "invalid_argument", {"owners", "local vertex 2", "-1"}, [](Job& job) { job.piece.owners[2] = -1; }, say_owners);
  check_refused(
      "invalid_argument", {"owners", "local vertex 2", std::to_string(ranks())},
      [](Job& job) { job.piece.owners[2] = ranks(); }, say_owners);
  check_disagreement(
      "invalid_argument",
      {"disagree about who owns the vertex of id " + std::to_string(columns_a_rank * spoiled()),
       "rank " + std::to_string(spoiled())},
      [](Job& job) { job.piece.owners[shared_vertex(job.piece)] = spoiled(); }, say_owners);
}

TEST_CASE("a triangle that two ranks have and none calls a ghost is refused on all") {
  // The last rank takes over what the one before it has, beside its own.
  const Change take_too_much = [](Job& job) {
    std::vector<int> rank_of_triangle = ranks_of_strips();
    std::ranges::replace(rank_of_triangle, spoiled() - 1, spoiled());
    job.piece = plain_piece(strips(0.3), rank_of_triangle);
  };
  const std::string one = "rank " + std::to_string(spoiled() - 1);
  const std::string other = "rank " + std::to_string(spoiled());
  check_disagreement("invalid_argument", {"triangle_ids", one, other, "ghost_triangles"}, take_too_much);
  const auto without_ids = [](Job& job) { job.piece.triangle_ids.clear(); };
  check_disagreement(
      "invalid_argument", {"the triangle of vertex ids", one, other, "ghost_triangles"},
      [&](Job& job) {
        take_too_much(job);
        without_ids(job);
      },
      without_ids);
  check_refused("invalid_argument", {"triangle_ids"},
                [](Job& job) { job.piece.triangle_ids[1] = job.piece.triangle_ids[0]; });
}

TEST_CASE("ids of triangles that are none, or there twice without any rank that sees both, are refused on all") {
  check_refused("invalid_argument", {"triangle_ids", "from 0 to"}, [](Job& job) { job.piece.triangle_ids[0] = -1; });
  // The first triangle of all is rank 0's, far from the last rank where there are three.
  check_disagreement("invalid_argument", {"triangle_ids: 0 is on rank 0", "on rank " + std::to_string(spoiled())},
                     [](Job& job) { job.piece.triangle_ids[0] = 0; });
}

TEST_CASE("what one rank has and the others have not, or the other way round, is refused on all") {
  const Change regions = [](Job& job) { job.piece.regions.assign(job.piece.triangles.size(), 0); };
  const Change owners = [](Job& job) { job.piece.owners.assign(job.piece.ids.size(), 0); };
  check_disagreement("invalid_argument", {"regions", "not on this one", "rank 0"}, regions);
  check_disagreement("invalid_argument", {"owners", "not on this one", "rank 0"}, owners);
  check_disagreement("invalid_argument", {"triangle_ids", "not on this one", "rank " + std::to_string(spoiled())},
                     [](Job& job) { job.piece.triangle_ids.clear(); });
  check_disagreement(
      "invalid_argument", {"regions", "not on this one", "rank " + std::to_string(spoiled())},
      [](Job& job) { job.piece.regions.clear(); }, regions);
}

TEST_CASE("options that are not the same on one rank are refused on all, by name") {
  using trismooth::TargetShape;
  static const fakes::FakeBackend backend;
  const Change can_gather = [](Job& job) { job.gather = Gather::where_needed; };
  const std::vector<std::pair<const char*, Change>> changes{
      {"method", [](Job& job) { job.options.method = Method::laplacian; }},
      {"form", [](Job& job) { job.options.form = trismooth::Form::swap; }},
      {"precision", [](Job& job) { job.options.precision = trismooth::Precision::single_precision; }},
      {"evaluation", [](Job& job) { job.options.evaluation = trismooth::Evaluation::all; }},
      {"size_weight", [](Job& job) { job.options.mean_ratio.size_weight = 0.5; }},
      {"power", [](Job& job) { job.options.mean_ratio.power = 2; }},
      {"steady", [](Job& job) { job.options.mean_ratio.steady = true; }},
      {"target", [](Job& job) { job.options.mean_ratio.target = TargetShape::input; }},
      {"guard", [](Job& job) { job.options.guard = false; }},
      {"untangle", [](Job& job) { job.options.untangle = trismooth::Untangle::on; }},
      {"layers", [](Job& job) { job.options.layers = trismooth::Layers::keep; }},
      {"max_sweeps", [](Job& job) { job.options.max_sweeps = 7; }},
      {"tolerance", [](Job& job) { job.options.tolerance = 1e-3; }},
      {"time_limit_seconds", [](Job& job) { job.options.time_limit_seconds = 1000; }},
      {"target_quality", [](Job& job) { job.options.target_quality = 0.5; }},
      {"record_min_shape", [](Job& job) { job.options.record_min_shape = true; }},
      {"backend", [](Job& job) { job.options.backend = &backend; }},
      {"slide.along", [](Job& job) { job.slide.along = trismooth::Slide::straight; }},
      {"slide.corner_angle", [](Job& job) { job.slide.corner_angle = 45; }},
      {"slide.deviation", [](Job& job) { job.slide.deviation = 0.01; }},
      {"slide.curve", [](Job& job) { job.slide.curve = trismooth::SlideCurve::spline; }},
      {"slide.coincident", [](Job& job) { job.slide.coincident = !job.slide.coincident; }},
      {"gather", [](Job& job) { job.gather = Gather::never; }}};
  for (const auto& [name, change] : changes) {
    INFO(name);
    check_disagreement("invalid_argument", {std::string("the option ") + name, "rank " + std::to_string(spoiled())},
                       change, can_gather);
  }
}

TEST_CASE("options that nobody may have are refused on all") {
  check_refused("invalid_argument", {"tolerance"}, [](Job& job) { job.options.tolerance = -1; });
  check_refused("invalid_argument", {"sweep limit"}, [](Job& job) { job.options.max_sweeps = -1; });
  check_refused("invalid_argument", {"threads"}, [](Job& job) { job.options.threads = -1; });
  check_refused("invalid_argument", {"paper"},
                [](Job& job) { job.options.execution = trismooth::Execution::single_block; });
}

TEST_CASE("points that differ, or are none, on one rank are refused on all") {
  check_disagreement("invalid_argument",
                     {"disagree about the vertex of id " + std::to_string(columns_a_rank * spoiled())},
                     [](Job& job) { job.piece.xy[2 * shared_vertex(job.piece)] += 1e-15; });
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    check_refused("MeshError", {"finite"}, [&](Job& job) { job.piece.xy[job.piece.xy.size() - 3] = none; });
  }
  check_disagreement("invalid_argument", {"double here and float on other ranks"},
                     [](Job& job) { job.is_float = true; });
  check_disagreement("invalid_argument", {"two numbers each here and three on other ranks"},
                     [](Job& job) { job.numbers = 3; });
}

TEST_CASE("heights that differ are refused on all") {
  const Change heights = [](Job& job) {
    job.numbers = 3;
    job.height = 3;
  };
  CHECK(fault(
            "MeshError", {"z runs from", "must be the same everywhere"},
            [&](Job& job) {
              heights(job);
              job.slope = 1;
            },
            nothing) == "");
  check_disagreement(
      "invalid_argument", {"disagree about z of the vertex of id"}, [](Job& job) { job.height = 3.5; }, heights);
  // A slope that is none to the digits that count.
  Job job;
  heights(job);
  job.slope = 1e-9;
  const Outcome outcome = run(job);
  CHECK(said_by_any(outcome.error + (outcome.has_moved ? "" : "nothing has moved")) == "");
}

TEST_CASE("a one-sided surface over all ranks is refused on all") {
  for (const std::int32_t length : {3, 12, 40}) {
    RandomMesh band;
    band.mesh = test_meshes::moebius_band(length);
    const auto triangles = static_cast<int>(band.mesh.triangles.size());
    std::vector<int> in_turn;
    std::vector<int> in_runs;
    for (int t = 0; t < triangles; ++t) {
      in_turn.push_back(t % ranks());
      in_runs.push_back(t * ranks() / triangles);
    }
    for (const std::vector<int>& cut : {in_turn, in_runs}) {
      CHECK(fault(
                "MeshError", {"oriented consistently"}, [&](Job& job) { job.piece = plain_piece(band, cut); },
                nothing) == "");
    }
  }
}

TEST_CASE("a progress callback that throws on one rank ends all, of the type that it throws") {
  const auto throws = [](const auto& error) {
    return [error](Job& job) {
      job.options.progress = [error](const trismooth::SweepRecord& record) -> Progress {
        if (record.sweep == 2) {
          throw error;  // NOLINT(bugprone-std-exception-baseclass): a caller may throw anything
        }
        return Progress::proceed;
      };
    };
  };
  check_refused("runtime_error", {"no more"}, throws(std::runtime_error("no more")));
  check_refused("invalid_argument", {"not that"}, throws(std::invalid_argument("not that")));
  check_refused("DeviceError", {"gone"}, throws(trismooth::DeviceError("gone")));
  check_refused("runtime_error", {"no std::exception"}, throws(7));
  check_refused("runtime_error", {"no more"}, throws(std::runtime_error("no more")), [](Job& job) {
    job.options.progress = [](const trismooth::SweepRecord& record) {
      return record.sweep == 2 ? Progress::stop : Progress::proceed;
    };
  });
}

TEST_CASE("a progress callback that says stop on one rank stops all after the same sweep") {
  Job job;
  job.options.max_sweeps = 100;
  if (rank() == spoiled()) {
    job.options.progress = [](const trismooth::SweepRecord& record) {
      return record.sweep == 2 ? Progress::stop : Progress::proceed;
    };
  }
  const Outcome outcome = run(job);
  std::string wrong = outcome.error;
  wrong += outcome.result.sweeps == 2 ? "" : "another number of sweeps";
  wrong += outcome.result.stop_reason == trismooth::StopReason::cancelled ? "" : "another reason";
  CHECK(said_by_any(wrong) == "");
}

TEST_CASE("target lengths that are missing, none or different on one rank are refused on all") {
  const Change lengths = [](Job& job) {
    job.options.method = Method::mean_ratio;
    job.lengths.assign(job.piece.ids.size(), 1);
  };
  check_disagreement(
      "invalid_argument", {"target_lengths has 0 entries", "rank " + std::to_string(spoiled())},
      [](Job& job) { job.lengths.clear(); }, lengths);
  for (const double none :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto last_id = std::to_string((columns_a_rank * ranks() + 1) * rows - 1);
    check_refused(
        "invalid_argument", {"target_lengths", "id " + last_id, "not a positive number"},
        [&](Job& job) { job.lengths.back() = none; }, lengths);
  }
  check_disagreement(
      "invalid_argument",
      {"target_lengths", "disagree about the vertex of id " + std::to_string(columns_a_rank * spoiled())},
      [](Job& job) { job.lengths[shared_vertex(job.piece)] = 2; }, lengths);
}

TEST_CASE("target lengths that the method does not look at are to be as many as vertices, and whatever they like") {
  const Change lengths = [](Job& job) { job.lengths.assign(job.piece.ids.size(), -1); };
  check_refused(
      "invalid_argument", {"target_lengths has 1 entries"}, [](Job& job) { job.lengths = {1}; }, lengths);
  const Outcome expected = run(Job());
  Job job;
  lengths(job);
  const Outcome outcome = run(job);
  CHECK(said_by_any(outcome.error + (same_bits(outcome.xy, expected.xy) ? "" : "other points")) == "");
}

TEST_CASE("what is not done in pieces is refused on all, with what to do instead") {
  CHECK(fault(
            "invalid_argument", {"slide", "Gather::where_needed"},
            [](Job& job) { job.slide.along = trismooth::Slide::curves; }, nothing) == "");
  const Change untangles = [](Job& job) { job.options.untangle = trismooth::Untangle::on; };
  // One vertex of the last rank is beyond its neighbours.
  check_disagreement(
      "invalid_argument", {"inverted", "Gather::where_needed"},
      [](Job& job) {
        const std::int32_t columns = columns_a_rank * ranks() + 1;
        const auto place = std::ranges::find(job.piece.global, 3 * columns + columns - 3);
        job.piece.xy[2 * static_cast<std::size_t>(place - job.piece.global.begin())] += 2;
      },
      untangles);
}

TEST_CASE("a plan that was moved from says so, and one that it was moved to works") {
  const Job job;
  Plan first(MPI_COMM_WORLD, job.piece.mesh(), job.piece.constraints(), job.options);
  Plan second = std::move(first);
  std::vector<double> xy = job.piece.xy;
  std::string wrong = "no exception";
  try {
    // NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move): that is the question
    first.smooth(xy);
  } catch (const std::logic_error& error) {
    wrong = says(error.what(), "moved from") && same_bits(xy, job.piece.xy) ? "" : error.what();
  }
  CHECK(said_by_any(wrong) == "");
  second.smooth(xy);
  CHECK(said_by_any(same_bits(xy, run(job).xy) ? "" : "other points") == "");
}

TEST_CASE("the caller's communicator may be freed, and its messages and the plan's do not meet") {
  MPI_Comm callers = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &callers);
  const Job job;
  Plan plan(callers, job.piece.mesh(), job.piece.constraints(), job.options);
  // A message of the caller's that is on its way all the while.
  const int next = (rank() + 1) % ranks();
  int received = -1;
  std::array<MPI_Request, 2> requests{};
  const int sent = rank();
  MPI_Irecv(&received, 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, callers, &requests[0]);
  std::vector<double> xy = job.piece.xy;
  plan.smooth(xy);
  MPI_Isend(&sent, 1, MPI_INT, next, 7302, callers, &requests[1]);
  MPI_Waitall(2, requests.data(), MPI_STATUSES_IGNORE);
  MPI_Comm_free(&callers);
  xy = job.piece.xy;
  plan.smooth(xy);
  std::string wrong = received == (rank() + ranks() - 1) % ranks() ? "" : "another message";
  wrong += same_bits(xy, run(job).xy) ? "" : "other points";
  CHECK(said_by_any(wrong) == "");
}
