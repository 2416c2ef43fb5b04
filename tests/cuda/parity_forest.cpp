// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/parity_forest.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

using test_meshes::Random;
using trismooth::ParityForest;

namespace {

struct Statement {
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t parity;
};

struct Joins {
  std::uint32_t joined = 0;
  std::uint32_t contradicted = 0;
};

/// Makes all statements, by as many threads at once.
Joins join_all(const ParityForest& forest, const std::vector<Statement>& statements, std::size_t threads) {
  std::atomic<std::uint32_t> joined{0};
  std::atomic<std::uint32_t> contradicted{0};
  const auto work = [&](std::size_t first) {
    for (std::size_t i = first; i < statements.size(); i += threads) {
      const auto [a, b, parity] = statements[i];
      const ParityForest::Join join = forest.join(a, b, parity);
      joined += join == ParityForest::Join::joined ? 1 : 0;
      contradicted += join == ParityForest::Join::contradicted ? 1 : 0;
    }
  };
  {
    std::vector<std::jthread> pool;
    for (std::size_t first = 1; first < threads; ++first) {
      pool.emplace_back(work, first);
    }
    work(0);
  }
  return {joined, contradicted};
}

/// Elements of both kinds in sets by their number modulo `sets`; the statements are random, and true.
struct Sample {
  std::vector<std::uint32_t> kinds;
  std::vector<Statement> statements;

  Sample(std::uint32_t elements, std::uint32_t sets, std::uint32_t count, Random& random) {
    const auto below = [&](std::uint32_t bound) {
      return static_cast<std::uint32_t>(random.below(static_cast<std::int32_t>(bound)));
    };
    for (std::uint32_t i = 0; i < elements; ++i) {
      kinds.push_back(below(2));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = below(elements);
      const std::uint32_t b = below(elements / sets) * sets + a % sets;
      statements.push_back({a, b, kinds[a] ^ kinds[b]});
    }
    // Every element is named, in chains that are long in one direction.
    for (std::uint32_t a = elements; a-- > sets;) {
      statements.push_back({a, a - sets, kinds[a] ^ kinds[a - sets]});
    }
  }
};

std::vector<std::uint32_t> planted(std::uint32_t elements) {
  std::vector<std::uint32_t> words(elements);
  for (std::uint32_t i = 0; i < elements; ++i) {
    ParityForest{words.data()}.plant(i);
  }
  return words;
}

}  // namespace

TEST_CASE("every tree has its lowest element as root, and knows of which kind each element is") {
  Random random(1);
  for (const std::size_t threads : {1U, 2U, 4U}) {
    for (const std::uint32_t sets : {1U, 3U, 50U}) {
      CAPTURE(threads);
      CAPTURE(sets);
      constexpr std::uint32_t elements = 6000;
      const Sample sample(elements, sets, 4 * elements, random);
      std::vector<std::uint32_t> words = planted(elements);
      const ParityForest forest{words.data()};
      const Joins joins = join_all(forest, sample.statements, threads);
      CHECK(joins.contradicted == 0);
      CHECK(joins.joined == elements - sets);
      for (std::uint32_t i = 0; i < elements; ++i) {
        const ParityForest::Root root = forest.find(i);
        REQUIRE(root.element == i % sets);
        REQUIRE(root.parity == (sample.kinds[i] ^ sample.kinds[i % sets]));
      }
    }
  }
}

TEST_CASE("one false statement among true ones is found, whenever it is made") {
  Random random(2);
  for (std::size_t round = 0; round < 40; ++round) {
    constexpr std::uint32_t elements = 500;
    Sample sample(elements, 1, 2 * elements, random);
    const std::size_t place = round % 2 == 0 ? round : sample.statements.size() - 1 - round;
    Statement wrong = sample.statements[place];
    wrong.parity ^= 1U;
    // Said and gainsaid: whichever comes first.
    sample.statements.insert(sample.statements.begin() + static_cast<std::ptrdiff_t>(place / 2), wrong);
    std::vector<std::uint32_t> words = planted(elements);
    CHECK(join_all(ParityForest{words.data()}, sample.statements, 1 + round % 3).contradicted > 0);
  }
}
