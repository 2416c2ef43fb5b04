// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/machine/instruction_set.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/file_format.h"
#include "trismooth/pipeline/cli/rank_job.h"
#include "trismooth/pipeline/cli/subcommands.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/pipeline/report/labelled_line.h"
#include "trismooth/version.h"

namespace trismooth {

namespace {

/// The instructions that the compiler was allowed to use, and those that the sweeps use on this processor.
std::string simd_level() {
#if defined(__AVX512F__)
  const std::string_view baseline = "avx512";
#elif defined(__AVX2__)
  const std::string_view baseline = "avx2";
#elif defined(__AVX__)
  const std::string_view baseline = "avx";
#elif defined(__SSE4_2__)
  const std::string_view baseline = "sse4.2";
#elif defined(__SSE2__)
  const std::string_view baseline = "sse2 (x86-64 baseline)";
#elif defined(__ARM_NEON)
  const std::string_view baseline = "neon";
#else
  const std::string_view baseline = "none known";
#endif
  const InstructionSet used = instruction_set();
  return std::string(baseline) +
         (used == InstructionSet::baseline
              ? ""
              : fmt::format("; sweeps: {}", instruction_set_names[static_cast<std::size_t>(used)]));
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

std::string wrapped_lines(const std::string& lines) {
  std::string text;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = std::min(line.find(':'), line.size() - 1);
    const std::size_t value = std::min(line.find_first_not_of(' ', colon + 1), line.size());
    text += labelled_line(line.substr(0, colon + 1), line.substr(value));
  }
  return text;
}

/// "off (.off), obj (.obj), ...": the names that --format takes, with their extensions.
std::string names_of_formats() {
  std::vector<std::string> names;
  for (const FileFormat format : all_formats()) {
    if (is_available(format)) {
      names.push_back(fmt::format("{} ({})", to_string(format), fmt::join(extensions_of(format), " ")));
    }
  }
  return list_text(names);
}

/// "; .vtu, .vtp need a build with VTK", or empty.
std::string missing_formats() {
  std::string names;
  for (const FileFormat format : all_formats()) {
    if (!is_available(format)) {
      names.append(names.empty() ? "; ." : ", .").append(to_string(format));
    }
  }
  return names.empty() ? names : names + " need a build with VTK";
}

ExitCode run_info(const CommandEnvironment& environment) {
  const CudaSupport cuda = environment.cuda();
  const int threads = Workers(0).count();
  environment.out << "trismooth " << version() << '\n'
                  << labelled_line(
                         "formats:",
                         names_of_formats() + "; all are read and written, also compressed (.gz)" + missing_formats())
                  << labelled_line("compiler:", compiler()) << labelled_line("SIMD:", simd_level())
                  << labelled_line("threads:", std::to_string(threads)) << labelled_line("MPI:", mpi_text())
                  << (cuda.backend != nullptr ? wrapped_lines(cuda.lines())
                                              : labelled_line("CUDA:", "not in this build"));
  return ExitCode::done;
}

}  // namespace

Subcommand add_info_command(CLI::App& app, const CommandEnvironment& environment) {
  CLI::App& command = *app.add_subcommand("info", "Show version, formats, instructions used, threads and devices");
  return {&command, [&environment] { return run_info(environment); }};
}

}  // namespace trismooth
