// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/error_kinds.h"

#include <array>
#include <new>
#include <stdexcept>
#include <string>

#include "trismooth/base/machine/out_of_memory.h"
#include "trismooth/mpi/communicator.h"

#include "catch.h"
#include "mpi/pieces.h"

using namespace mpi_tests;
using trismooth::mpi::Communicator;
using trismooth::mpi::error_kind;
using trismooth::mpi::ErrorKinds;
using trismooth::mpi::KnownToAll;

namespace {

/// What the last rank throws, as this one hears of it: its type, of those below, and its message.
template <class Error>
std::string heard(const Error& error, const ErrorKinds& kinds) {
  const Communicator all(MPI_COMM_WORLD);
  try {
    all.on_all(
        [&] {
          if (rank() == ranks() - 1) {
            throw error;  // NOLINT(bugprone-std-exception-baseclass): whatever it is
          }
        },
        kinds);
  } catch (const KnownToAll& known) {
    try {
      std::rethrow_exception(known.error);
    } catch (const std::length_error& e) {
      return std::string("length_error ") + e.what();
    } catch (const std::logic_error& e) {
      return std::string("logic_error ") + e.what();
    } catch (const std::bad_alloc& e) {
      return std::string("bad_alloc ") + e.what();
    } catch (const std::runtime_error& e) {
      return std::string("runtime_error ") + e.what();
    }
  }
  return "nothing";
}

}  // namespace

TEST_CASE("errors of one rank are thrown on all as the first kind that includes them") {
  static constexpr std::array kinds{error_kind<std::length_error>(), error_kind<std::logic_error>()};
  const std::string last = ranks() > 1 ? "rank " + std::to_string(ranks() - 1) + ": " : "";
  const std::array<std::array<std::string, 2>, 5> said{{
      {heard(std::length_error("long"), {kinds}), "length_error long"},
      {heard(std::invalid_argument("none"), {kinds}), "logic_error none"},
      {heard(std::runtime_error("gone"), {kinds, true}), "runtime_error " + last + "gone"},
      {heard(std::bad_alloc(), {kinds}), "bad_alloc " + (last.empty() ? "std::bad_alloc" : last + "out of memory")},
      {heard(7, {kinds}), "runtime_error an exception that is no std::exception"},
  }};
  for (const auto& [found, expected] : said) {
    CHECK(said_by_any(found == expected ? "" : found) == "");
  }
}

TEST_CASE("whose memory was used up stays known where the error is agreed on once more, by all ranks") {
  const int last = ranks() - 1;
  const Communicator all(MPI_COMM_WORLD);
  try {
    all.on_all([&] { throw trismooth::OutOfMemory(last); });
    FAIL("nothing was thrown");
  } catch (const KnownToAll& known) {
    try {
      std::rethrow_exception(known.error);
    } catch (const std::bad_alloc& error) {
      CHECK(trismooth::whose_memory(error) == (ranks() > 1 ? "rank " + std::to_string(last) + ": " : ""));
    }
  }
}
