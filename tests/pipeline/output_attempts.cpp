// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/output_attempts.h"

#include <cerrno>
#include <new>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>

#include "catch.h"

namespace trismooth::output_attempts_test {

/// Takes nothing, for want of space.
class FullDisk : public std::streambuf {
  int_type overflow(int_type /*character*/) override {
    errno = ENOSPC;
    return traits_type::eof();
  }
  int sync() override { return -1; }
};

TEST_CASE("what cannot be written is told by its name, and nothing is thrown") {
  std::ostringstream err;
  CHECK(could_write("a.json", err, [] {}));
  CHECK(err.str().empty());
  CHECK_FALSE(could_write("a.json", err, [] { throw WriteError("a.json", "cannot be written: why"); }));
  CHECK(err.str() == "trismooth: error: a.json: cannot be written: why\n");
  err.str("");
  CHECK_FALSE(could_write("b.html", err, [] { throw std::bad_alloc(); }));
  CHECK(err.str() == "trismooth: error: b.html: cannot be written: not enough memory\n");
}

TEST_CASE("other failures are not taken for those of a file") {
  std::ostringstream err;
  CHECK_THROWS_AS(could_write("a.json", err, [] { throw std::logic_error("a bug"); }), std::logic_error);
}

TEST_CASE("results that cannot be printed are told with the reason of the first write that failed") {
  FullDisk disk;
  std::ostream out(&disk);
  CHECK_THROWS_WITH(print_results(out, "results"), "standard output: cannot be written: No space left on device");
  std::ostringstream fine;
  print_results(fine, "results");
  CHECK(fine.str() == "results");
}

TEST_CASE("results that cannot be flushed are told without the reason of something else") {
  FullDisk disk;
  std::ostream out(&disk);
  errno = EINTR;
  CHECK_THROWS_WITH(flush_results(out), "standard output: cannot be written");
  std::ostringstream fine;
  CHECK_NOTHROW(flush_results(fine));
}

}  // namespace trismooth::output_attempts_test
