#include "trismooth/pipeline/bench/wording.h"

#include <fmt/format.h>

#include "trismooth/quality/report_text.h"

namespace trismooth::bench {

std::string size_text(std::int64_t vertices) {
  constexpr std::int64_t thousand = 1'000;
  constexpr std::int64_t million = thousand * thousand;
  if (vertices >= million && vertices % (million / 10) == 0) {
    return fmt::format("{}M", static_cast<double>(vertices) / million);
  }
  if (vertices >= thousand && vertices % (thousand / 10) == 0) {
    return fmt::format("{}K", static_cast<double>(vertices) / thousand);
  }
  return count_text(vertices);
}

std::string runs_text(int runs) {
  return fmt::format("{} run{}", runs, runs == 1 ? "" : "s");
}

std::string sweeps_text(const Spread& sweeps) {
  return sweeps.least == sweeps.most ? fmt::format("{:.0f}", sweeps.median)
                                     : fmt::format("{:.0f} ({:.0f}-{:.0f})", sweeps.median, sweeps.least, sweeps.most);
}

}  // namespace trismooth::bench
