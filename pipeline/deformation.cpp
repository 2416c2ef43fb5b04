// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/deformation.h"

#include <string>
#include <tuple>

#include <fmt/format.h>

#include "trismooth/mesh_io/file_format.h"

namespace trismooth {

std::filesystem::path output_of_step(const std::filesystem::path& output, std::size_t step, std::size_t count) {
  const std::size_t digits = std::to_string(count).size();
  const std::filesystem::path plain = names_gzip(output) ? output.stem() : output.filename();
  std::filesystem::path numbered = output;
  return numbered.replace_filename(fmt::format("{}_{:0{}}{}{}", plain.stem().string(), step + 1, digits,
                                               plain.extension().string(),
                                               names_gzip(output) ? output.extension().string() : ""));
}

bool DeformedStep::is_worse_than(const DeformedStep& other) const {
  // (A mesh without triangles has no shape: NaN is not below anything.)
  return std::tuple(-invalid(), -invalid_quadratic(), quality[Metric::shape].min) <
         std::tuple(-other.invalid(), -other.invalid_quadratic(), other.quality[Metric::shape].min);
}

}  // namespace trismooth
