// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "catch.h"
#include "targets.h"

namespace fs = std::filesystem;

namespace {

void run(const fuzz::Target& target, const std::string& name, const std::string& bytes) {
  CAPTURE(target.name, name);
  CHECK_NOTHROW(target.run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
}

}  // namespace

TEST_CASE("what once broke a promise keeps it now") {
  // ctest says where they are; by hand, from the project's folder, they are here.
  const char* const folder = std::getenv("TRISMOOTH_FUZZ_REGRESSIONS");
  const fs::path regressions = folder != nullptr ? folder : "tests/fuzz/regressions";
  REQUIRE(fs::is_directory(regressions));
  for (const fuzz::Target& target : fuzz::all_targets()) {
    if (!fs::is_directory(regressions / target.name)) {
      continue;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(regressions / target.name)) {
      std::ifstream file(entry.path(), std::ios::binary);
      run(target, entry.path().filename().string(), {std::istreambuf_iterator<char>(file), {}});
    }
  }
}

TEST_CASE("the seeds of every fuzz target keep all promises") {
  for (const fuzz::Target& target : fuzz::all_targets()) {
    const std::vector<fuzz::Seed> seeds = fuzz::seeds_of(target);
    CHECK_FALSE(seeds.empty());
    for (const fuzz::Seed& seed : seeds) {
      CHECK(seed.bytes.size() <= fuzz::most_input_bytes);
      run(target, seed.name, seed.bytes);
    }
  }
}
