// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/run_record.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>

#include "catch.h"

namespace trismooth::run_record_test {

/// The zone of this process for as long as it lives.
class Zone {
 public:
  explicit Zone(const char* name) {
    const char* const old = std::getenv("TZ");
    was_set_ = old != nullptr;
    old_ = was_set_ ? old : "";
    set(name);
  }
  Zone(const Zone&) = delete;
  Zone& operator=(const Zone&) = delete;
  ~Zone() { was_set_ ? set(old_.c_str()) : clear(); }

 private:
  static void set(const char* name) {
    setenv("TZ", name, 1);
    tzset();
  }
  static void clear() {
    unsetenv("TZ");
    tzset();
  }

  bool was_set_ = false;
  std::string old_;
};

TEST_CASE("a date is that of the zone, and says which") {
  const auto date = [](const char* zone, std::int64_t seconds) {
    const Zone used(zone);
    return trismooth::date_text(std::chrono::system_clock::time_point(std::chrono::seconds(seconds)));
  };
  constexpr std::int64_t noon = 1'795'262'400;  // 2026-11-21 12:00:00 UTC
  CHECK(date("UTC", noon) == "2026-11-21T12:00:00+00:00");
  CHECK(date("CET-1", noon + 61) == "2026-11-21T13:01:01+01:00");
  CHECK(date("IST-5:30", noon) == "2026-11-21T17:30:00+05:30");
  CHECK(date("NST3:30", noon) == "2026-11-21T08:30:00-03:30");
  CHECK(date("LINT-14", noon) == "2026-11-22T02:00:00+14:00");
}

}  // namespace trismooth::run_record_test
