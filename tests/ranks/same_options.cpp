// SPDX-License-Identifier: BSD-3-Clause
// Options that one rank alone is given, or that it is not given, are named, by all ranks.

#include <algorithm>
#include <exception>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <mpi.h>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/cli/command_line.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/ranks/piece_options.h"

#include "catch.h"

namespace trismooth::same_options_test {

using Words = std::vector<std::string>;

struct Option {
  std::string name;
  Words values;  ///< what one rank is given
  Words more;    ///< what all are
};

/// Every option that matters to the other ranks.
const std::vector<Option>& shared_options() {
  static const Words slide{"--slide", "curves"};
  static const std::vector<Option> options{
      {"--method", {"laplacian"}, {}},
      {"--form", {"a"}, {}},
      {"--untangle", {"on"}, {}},
      {"--layers", {"smooth"}, {}},
      {"--precision", {"single"}, {}},
      {"--guard", {"off"}, {}},
      {"--size-weight", {"0.5"}, {}},
      {"--size-array", {"size"}, {}},
      {"--power", {"2"}, {}},
      {"--target", {"input-shape"}, {}},
      {"--slide", {"straight"}, {}},
      {"--corner-angle", {"40"}, slide},
      {"--deviation", {"0.1"}, slide},
      {"--curve", {"spline"}, slide},
      {"--slide-coincident", {}, slide},
      {"--max-sweeps", {"3"}, {}},
      {"--tolerance", {"0.01"}, {}},
      {"--time-limit", {"1000"}, {}},
      {"--target-quality", {"0.5"}, {}},
      {"--region-array", {"none"}, {}},
      {"--fixed-array", {"fixed"}, {}},
      {"--fixed-set", {"none"}, {}},
      {"--merge", {"0"}, {}},
      {"--fixed-ids", {"ids.txt"}, {}},
      {"--fixed-labels", {"ids.txt"}, {}},
      {"--project", {"xy"}, {}},
      {"--quads", {"hold"}, {}},
      {"--geographic", {}, {}},
      {"--fields", {"keep"}, {}},
      {"--field-array", {"*"}, {}},
      {"--partition", {"keep"}, {}},
      {"--format", {"off"}, {"--single"}},
      {"--single", {}, {}},
      {"--gather", {}, {}},
      {"--verbose", {}, {}},
      {"--annotate", {}, {}},
      {"--annotate-metrics", {"shape,min_angle"}, {"--annotate"}},
      {"--require", {"size_ratio<9"}, {}},
  };
  return options;
}

/// What the command line says.
std::string call(Words words, std::optional<PipelineOptions>& options) {
  words.insert(words.begin(), "trismooth");
  std::vector<const char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  std::ostringstream said;
  CommandEnvironment environment{said, said};
  environment.over_ranks = true;
  environment.run = [&](const PipelineOptions& read) -> PipelineResult {
    options = read;
    throw Cancelled();
  };
  run_command_line(static_cast<int>(arguments.size()), arguments.data(), environment);
  return said.str();
}

PipelineOptions options_of(const Words& more) {
  const auto has = [&](const char* name) { return std::ranges::count(more, name) > 0; };
  Words words{"smooth", "mesh.off", has("--format") ? "out" : has("--single") ? "out.vtu" : "out.pvtu"};
  words.insert(words.end(), more.begin(), more.end());
  std::optional<PipelineOptions> options;
  const std::string said = call(words, options);
  INFO(said);
  REQUIRE(options);
  return *options;
}

/// What is said where this rank has these options; empty where they are those of the others.
std::string refusal(const PipelineOptions& options, const mpi::Communicator& ranks) {
  try {
    require_same_options(options, ranks);
  } catch (const mpi::KnownToAll& known) {
    try {
      std::rethrow_exception(known.error);
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  return {};
}

TEST_CASE("every option that is not the same on all ranks is named by all") {
  const mpi::Communicator ranks(MPI_COMM_WORLD);
  const bool is_last = ranks.rank() + 1 == ranks.size();
  for (const Option& option : shared_options()) {
    Words given = option.more;
    const PipelineOptions without = options_of(given);
    given.push_back(option.name);
    given.insert(given.end(), option.values.begin(), option.values.end());
    PipelineOptions with = options_of(given);
    with.output = without.output;  // some need a name of another kind
    CAPTURE(option.name, ranks.rank());
    CHECK(refusal(with, ranks).empty());
    for (const bool last_has_it : {true, false}) {
      const std::string message = refusal(is_last == last_has_it ? with : without, ranks);
      CAPTURE(message);
      CHECK((message.find(option.name) != std::string::npos) == (ranks.size() > 1));
    }
  }
}

TEST_CASE("other files are named, and options that may differ are not") {
  const mpi::Communicator ranks(MPI_COMM_WORLD);
  PipelineOptions options = options_of({});
  if (ranks.rank() + 1 == ranks.size()) {
    options.input = "other.off";
  }
  CHECK((refusal(options, ranks).find("INPUT") != std::string::npos) == (ranks.size() > 1));
  options.input = "mesh.off";
  options.output = "out_" + std::to_string(ranks.rank()) + ".pvtu";
  CHECK((refusal(options, ranks).find("OUTPUT") != std::string::npos) == (ranks.size() > 1));
  for (const Words& own : std::vector<Words>{{"--threads", "1"},
                                             {"--report", "other.json"},
                                             {"--quiet"},
                                             {"--topology", "halfedge"},
                                             {"--execution", "single-block"}}) {
    CAPTURE(own);
    CHECK(refusal(options_of(ranks.rank() == 0 ? Words{} : own), ranks).empty());
  }
}

TEST_CASE("every option of smooth is known to be one that is shared, or one that is not") {
  // These a rank refuses by itself, as the build or a job of several has them not; rank 0 has the say of the others, or
  // each rank for itself, or the CPU takes no notice of them.
  std::set<std::string> known{"--picture", "--picture-metric", "--picture-window", "--picture-worst", "--help",
                              "--devices", "--backend",        "--order",          "--layout",        "--threads",
                              "--report",  "--quiet",          "--topology",       "--execution"};
  for (const Option& option : shared_options()) {
    known.insert(option.name);
  }
  std::optional<PipelineOptions> none;
  const std::string help = call({"smooth", "--help"}, none);
  const std::regex pattern("\n  (?:-\\w, )?(--[a-z-]+)");
  std::set<std::string> named;
  for (std::sregex_iterator found(help.begin(), help.end(), pattern), end; found != end; ++found) {
    named.insert((*found)[1]);
  }
  CHECK(named == known);
}

}  // namespace trismooth::same_options_test
