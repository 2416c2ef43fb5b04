// SPDX-License-Identifier: BSD-3-Clause
// Every byte of every file of the collection replaced by hostile ones: the file is refused as it should be, or read
// into a document that keeps every promise and can be written.
#include <random>
#include <string_view>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"
#include "support/sanitized.h"
#include "support/share_of_cases.h"

using accepted_files::AcceptedFile;

TEST_CASE("No byte anywhere makes a file that is neither refused nor sound") {
  constexpr std::string_view hostile("\0\xff-9e\n \"<", 9);
  constexpr std::size_t written_of = 5;
  Faults faults;
  std::size_t count = 0;
  for (const AcceptedFile& file : accepted_files::all()) {
    // Some of the pairs in each file, others in the next.
    const std::size_t stride = is_vtk_xml(file) || per_cent_of_cases() < 100 ? 9 : 3;
    ++count;
    for (std::size_t at = 0; at < file.bytes.size(); at += stride_of(file)) {
      for (std::size_t i = (at + count) % stride; i < hostile.size(); i += stride) {
        std::string bytes = file.bytes;
        bytes[at] = hostile[i];
        const Outcome outcome = ++count % written_of == 0 ? read_and_write(file, bytes) : read(file, bytes);
        faults.add_any(file.name, fmt::format("byte {} is {}", at, static_cast<unsigned char>(hostile[i])),
                       outcome.fault);
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("No byte that is lost or doubled makes a file that is neither refused nor sound") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    for (std::size_t at = 0; at < file.bytes.size(); at += stride_of(file)) {
      std::string lost = file.bytes;
      lost.erase(at, 1);
      faults.add_any(file.name, fmt::format("byte {} is lost", at), read(file, lost).fault);
      if (!is_vtk_xml(file)) {
        std::string doubled = file.bytes;
        doubled.insert(at, 1, file.bytes[at]);
        faults.add_any(file.name, fmt::format("byte {} is doubled", at), read(file, doubled).fault);
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("Damage at several places makes no file that is neither refused nor written back as it is") {
  constexpr std::string_view likely = "0123456789-+.eE \n\r#NOFsx\xff\x7f\x80";
  const std::int64_t trials = is_sanitized ? 8 : 120 * per_cent_of_cases() / 100;
  std::mt19937 random(1);
  Faults faults;
  std::size_t accepted = 0;
  for (const AcceptedFile& file : accepted_files::all()) {
    for (int trial = 0; trial < trials; ++trial) {
      std::string damaged = file.bytes;
      for (auto change = random() % 3 + 1; change > 0; --change) {
        const std::size_t at = random() % damaged.size();
        const char byte = random() % 4 == 0 ? static_cast<char>(random()) : likely[random() % likely.size()];
        switch (random() % 4) {
          case 0:
            damaged.erase(at, 1 + random() % 4);
            break;
          case 1:
            damaged.insert(at, 1, byte);
            break;
          default:
            damaged[at] = byte;
        }
      }
      const Outcome outcome = trial % 8 == 0 ? read_and_write(file, damaged) : read(file, damaged);
      faults.add_any(file.name, fmt::format("trial {}", trial), outcome.fault);
      accepted += outcome.document ? 1 : 0;
      if (outcome.document && !is_vtk_xml(file) && written_back(*outcome.document) != damaged) {
        faults.add(file.name, fmt::format("trial {}", trial), "is not written back as it is");
      }
    }
  }
  CHECK(accepted > 0);
  REQUIRE_NONE(faults);
}
