// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/suggestion.h"

#include <string>
#include <vector>

#include "catch.h"

namespace {

std::string meant(const std::string& word, const std::vector<std::string>& candidates) {
  return trismooth::did_you_mean(word, candidates);
}

std::string answer(const std::string& word) {
  return " (did you mean '" + word + "'?)";
}

}  // namespace

TEST_CASE("one letter too much, too few, wrong or swapped is understood") {
  const std::vector<std::string> words{"smooth", "quality", "generate", "bench", "info"};
  for (const std::string typed : {"smoooth", "smoth", "smooch", "smotoh", "Smooth", "SMOOTH", "mooth"}) {
    CAPTURE(typed);
    CHECK(meant(typed, words) == answer("smooth"));
  }
  CHECK(meant("bnech", words) == answer("bench"));
  CHECK(meant("qaulity", words) == answer("quality"));
  CHECK(meant("inof", words) == answer("info"));
}

TEST_CASE("the beginning of one word alone is understood") {
  const std::vector<std::string> words{"target-quality", "target-size", "max-sweeps", "laplacian"};
  CHECK(meant("max", words) == answer("max-sweeps"));
  CHECK(meant("lap", words) == answer("laplacian"));
  CHECK(meant("target", words).empty());
  CHECK(meant("la", words).empty());
}

TEST_CASE("the nearest word is named, and none where none is near") {
  CHECK(meant("max-sweep", {"min-sweeps", "max-sweeps"}) == answer("max-sweeps"));
  CHECK(meant("mesh.off", {"smooth", "quality", "bench", "info"}).empty());
  CHECK(meant("", {"a"}).empty());
  CHECK(meant("a", {}).empty());
  CHECK(meant(std::string(1000, 'a'), {std::string(999, 'a')}).empty());
}

TEST_CASE("of short words only upper and lower case are taken for a slip: another letter is another word") {
  CHECK(meant("gpu", {"auto", "cpu", "cuda"}).empty());
  CHECK(meant("c", {"a", "b"}).empty());
  CHECK(meant("A", {"a", "b"}) == answer("a"));
  CHECK(meant("SOA", {"aos", "soa"}) == answer("soa"));
}
