#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include "trismooth/mesh_io/file_format.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/pipeline/subcommands.h"
#include "trismooth/pipeline/version.h"

namespace trismooth {

namespace {

/// The instructions that the compiler was allowed to use.
constexpr std::string_view simd_level() {
#if defined(__AVX512F__)
  return "avx512";
#elif defined(__AVX2__)
  return "avx2";
#elif defined(__AVX__)
  return "avx";
#elif defined(__SSE4_2__)
  return "sse4.2";
#elif defined(__SSE2__)
  return "sse2 (x86-64 baseline)";
#elif defined(__ARM_NEON)
  return "neon";
#else
  return "none known";
#endif
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

ExitCode run_info(const CommandEnvironment& environment) {
  const CudaSupport cuda = environment.cuda();
  const unsigned threads = std::thread::hardware_concurrency();
  environment.out << "trismooth " << version() << '\n'
                  << "formats:    " << format_list() << " (all are read and written)\n"
                  << "compiler:   " << compiler() << '\n'
                  << "SIMD:       " << simd_level() << '\n'
                  << "threads:    " << threads << '\n'
                  << (cuda.backend != nullptr ? cuda.lines() : "CUDA:       not in this build\n");
  return ExitCode::done;
}

}  // namespace

Subcommand add_info_command(CLI::App& app, const CommandEnvironment& environment) {
  CLI::App& command = *app.add_subcommand("info", "Show version, formats, instructions used, threads and devices");
  return {&command, [&environment] { return run_info(environment); }};
}

}  // namespace trismooth
