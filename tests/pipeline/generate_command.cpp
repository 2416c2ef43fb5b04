// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/pipeline/cli/command_line.h"

#include "catch.h"
#include "command_line_calls.h"
#include "support/scratch_folder.h"

namespace trismooth::generate_command_test {

using namespace command_line_calls;

TEST_CASE("a generated mesh has as many vertices as asked for and can be smoothed in place") {
  const ScratchFolder folder;
  const std::string mesh = (folder / "mesh.off").string();
  const Outcome made = call({"generate", mesh, "--vertices", "500", "--seed", "7"});
  REQUIRE(made.code == 0);
  CHECK(made.shows("500 vertices"));
  const Outcome smoothed =
      call({"smooth", mesh, mesh, "--require", "triangles>500", "--require", "inverted==0"}, &trismooth::run_pipeline);
  CAPTURE(smoothed.err);
  CHECK(smoothed.code == 0);
  CHECK(smoothed.shows("500 vertices"));
  CHECK(folder.size() == 1);
}

TEST_CASE("with --quiet nothing is printed, as elsewhere, and the mesh is written") {
  const ScratchFolder folder;
  for (const char* const quiet : {"-q", "--quiet"}) {
    const Outcome made = call({"generate", (folder / "mesh.off").string(), "--vertices", "50", quiet});
    CHECK(made.code == 0);
    CHECK(made.out.empty());
    CHECK(made.err.empty());
    CHECK(std::filesystem::remove(folder / "mesh.off"));
  }
}

TEST_CASE("the same seed makes the same file, another seed another") {
  const ScratchFolder folder;
  const auto made_with = [&](const std::string& seed) {
    REQUIRE(call({"generate", (folder / (seed + ".off")).string(), "--vertices", "300", "--seed", seed}).code == 0);
    return bytes_of(folder / (seed + ".off"));
  };
  const std::string first = made_with("1");
  REQUIRE(call({"generate", (folder / "again.off").string(), "--vertices", "300"}).code == 0);
  CHECK(bytes_of(folder / "again.off") == first);
  CHECK(made_with("18446744073709551615") != first);
}

TEST_CASE("the boundary is that of random points, or the square resolved like the inside") {
  const ScratchFolder folder;
  const auto made = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"generate", (folder / name).string(), "--vertices", "300"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    REQUIRE(call(arguments).code == 0);
    return bytes_of(folder / name);
  };
  const std::string by_default = made("default.off", {});
  CHECK(made("random.off", {"--boundary", "random"}) == by_default);
  CHECK(made("resolved.off", {"--boundary", "resolved"}) != by_default);
  const Outcome smoothed = call({"smooth", (folder / "resolved.off").string(), (folder / "smoothed.off").string()},
                                &trismooth::run_pipeline);
  CHECK(smoothed.shows("300 vertices"));
  CHECK(smoothed.shows("64 boundary"));
  CHECK(call({"generate", (folder / "none.off").string(), "--vertices", "300", "--boundary", "rough"}).code == 2);
}

TEST_CASE("the number of vertices may have a unit, as the sizes of bench") {
  const ScratchFolder folder;
  const auto made = [&](const std::string& count) {
    REQUIRE(call({"generate", (folder / (count + ".off")).string(), "--vertices", count}).code == 0);
    return bytes_of(folder / (count + ".off"));
  };
  CHECK(made("1K") == made("1000"));
  CHECK(made("2k") == made("2000"));
}

TEST_CASE("generate cannot write where there is no folder or no format") {
  const ScratchFolder folder;
  CHECK(call({"generate", (folder / "mesh.xyz").string(), "--vertices", "10"}).code == 4);
  CHECK(call({"generate", (folder / "missing/mesh.off").string(), "--vertices", "10"}).code == 4);
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace trismooth::generate_command_test
