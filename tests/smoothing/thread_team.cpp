// SPDX-License-Identifier: BSD-3-Clause
// Threads that smooth the parts of a mesh reach each other, and none waits for one that has failed.

#include "trismooth/smoothing/in_parts/thread_team.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "catch.h"

namespace trismooth::thread_team_test {

TEST_CASE("every part gets what every other one sends it, round after round") {
  constexpr int parts = 5;
  ThreadTeam team(parts);
  std::array<std::int64_t, parts> wrong{};
  team.run([&](int own) {
    const auto messenger = team.messenger(own);
    for (int round = 0; round < 200; ++round) {
      std::array<std::array<int, 3>, parts> out{};
      std::array<std::array<int, 3>, parts> in{};
      std::vector<PartMessenger::Message> sends;
      std::vector<PartMessenger::Message> receives;
      for (int other = 0; other < parts; ++other) {
        // Nothing between some of them in some rounds.
        if (other != own && (other + own + round) % 4 != 0) {
          const auto place = static_cast<std::size_t>(other);
          out[place] = {own, other, round};
          sends.push_back({other, std::as_writable_bytes(std::span(out[place]))});
          receives.push_back({other, std::as_writable_bytes(std::span(in[place]))});
        }
      }
      messenger->start(sends, receives);
      messenger->finish();
      for (const PartMessenger::Message& message : receives) {
        const std::array<int, 3> expected{message.part, own, round};
        wrong[static_cast<std::size_t>(own)] += in[static_cast<std::size_t>(message.part)] == expected ? 0 : 1;
      }
    }
  });
  CHECK(wrong == std::array<std::int64_t, parts>{});
}

TEST_CASE("sums and largest numbers are those of all parts, on all of them") {
  constexpr int parts = 4;
  ThreadTeam team(parts);
  std::atomic<int> wrong{0};
  team.run([&](int own) {
    const auto messenger = team.messenger(own);
    for (int round = 0; round < 500; ++round) {
      PartSums sums;
      sums.sums[0] = own + round;
      sums.largest = {-1.0 * own, 1.0 * own * round};
      messenger->join(sums);
      wrong += sums.sums[0] == 6 + 4 * round && sums.largest[0] == 0 && sums.largest[1] == 3.0 * round ? 0 : 1;
    }
  });
  CHECK(wrong == 0);
}

TEST_CASE("where a part fails the others stop waiting, its exception is told, and the team goes on") {
  constexpr int parts = 4;
  ThreadTeam team(parts);
  for (int failing = 0; failing < parts; ++failing) {
    for (const bool in_messages : {false, true}) {
      std::atomic<int> gone_on{0};
      const auto task = [&](int own) {
        if (own == failing) {
          throw std::domain_error("part " + std::to_string(own));
        }
        const auto messenger = team.messenger(own);
        if (in_messages) {
          std::byte out{};
          std::byte in{};
          const std::array sends{PartMessenger::Message{failing, std::span(&out, 1)}};
          const std::array receives{PartMessenger::Message{failing, std::span(&in, 1)}};
          messenger->start(sends, receives);
          messenger->finish();
        } else {
          PartSums sums;
          messenger->join(sums);
        }
        ++gone_on;
      };
      std::string told;
      try {
        team.run(task);
      } catch (const std::domain_error& error) {
        told = error.what();
      }
      CHECK(told == "part " + std::to_string(failing));
      CHECK(gone_on == 0);
    }
    std::atomic<std::int64_t> sum{0};
    team.run([&](int own) {
      PartSums sums;
      sums.sums[0] = 1;
      team.messenger(own)->join(sums);
      sum += sums.sums[0];
    });
    CHECK(sum == parts * parts);
  }
}

TEST_CASE("what all parts throw at the same time is what the caller gets") {
  ThreadTeam team(3);
  for (int round = 0; round < 200; ++round) {
    CHECK_THROWS_AS(team.run([&](int own) {
      PartSums sums;
      team.messenger(own)->join(sums);
      throw std::domain_error("all");
    }),
                    std::domain_error);
  }
}

TEST_CASE("the first part is on the thread of the caller, the others on threads of their own") {
  ThreadTeam team(3);
  std::array<std::thread::id, 3> threads;
  team.run([&](int own) { threads[static_cast<std::size_t>(own)] = std::this_thread::get_id(); });
  CHECK(threads[0] == std::this_thread::get_id());
  CHECK(threads[1] != threads[0]);
  CHECK(threads[2] != threads[0]);
  CHECK(threads[1] != threads[2]);
}

TEST_CASE("a team has a part at least") {
  CHECK_THROWS_AS(ThreadTeam(0), std::invalid_argument);
  CHECK(ThreadTeam(1).count() == 1);
}

}  // namespace trismooth::thread_team_test
