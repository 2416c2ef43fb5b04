// SPDX-License-Identifier: BSD-3-Clause
// Measures how long read_mesh() takes for the same mesh in files of several kinds, in turn: all of them once, then all
// of them again, so that what else the machine does meets them alike.
//
//     reading --vertices 1000000 --kinds off msh msh2 vtu msh-binary --threads 1 2 --runs 5

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "trismooth/base/machine/processor_name.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/generate/random_document.h"
#include "trismooth/pipeline/report/spread.h"

#include "mesh_files.h"
#include "run_reporting.h"

namespace {

using namespace trismooth;

struct Settings {
  std::int64_t vertices = 1'000'000;
  std::vector<std::string> kinds{"off", "msh", "vtu", "msh-binary"};
  std::vector<int> threads{1, 2};
  int runs = 5;
  std::filesystem::path folder = std::filesystem::temp_directory_path();
  bool keep = false;
};

struct Row {
  std::string kind;
  std::filesystem::path path;
  std::int64_t bytes = 0;
  std::optional<FileFormat> format;               ///< that has to be told
  std::vector<std::vector<double>> milliseconds;  ///< by number of threads, of every run
};

/// Those of Triangle are two.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    if (entry.path().stem() == path.stem()) {
      files.push_back(entry.path());
    }
  }
  return files;
}

void print(const Settings& settings, const std::vector<Row>& rows) {
  fmt::print("{}; {} vertices; reading, milliseconds, medians of {} runs in turn (least to most)\n\n", processor_name(),
             settings.vertices, settings.runs);
  fmt::print("{:<11} {:>8} {:>3} {:>8} {:>17} {:>7} {:>9}\n", "file", "MB", "thr", "median", "", "MB/s",
             "of " + rows.front().kind);
  for (const Row& row : rows) {
    for (std::size_t t = 0; t < settings.threads.size(); ++t) {
      const Spread spread(row.milliseconds[t]);
      // Run by run: what is measured side by side is compared.
      std::vector<double> ratios;
      for (std::size_t run = 0; run < row.milliseconds[t].size(); ++run) {
        ratios.push_back(row.milliseconds[t][run] / rows.front().milliseconds[t][run]);
      }
      fmt::print("{:<11} {:>8.1f} {:>3} {:>8.1f} {:>17} {:>7.0f} {:>9.2f}\n", row.kind,
                 static_cast<double>(row.bytes) / 1e6, settings.threads[t], spread.median,
                 fmt::format("({:.1f} to {:.1f})", spread.least, spread.most),
                 static_cast<double>(row.bytes) / 1e3 / spread.median, Spread(ratios).median);
    }
  }
}

int run(int argc, char** argv) {
  CLI::App app("Measures reading of the same mesh from files of several kinds");
  Settings settings;
  app.add_option("--vertices", settings.vertices, "size of the mesh")->capture_default_str();
  app.add_option("--kinds", settings.kinds,
                 "extensions, msh-binary, msh2, freefem; the first is what others stand beside")
      ->capture_default_str();
  app.add_option("--threads", settings.threads, "numbers of threads")->capture_default_str();
  app.add_option("--runs", settings.runs)->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--folder", settings.folder, "where meshes are written")->capture_default_str();
  app.add_flag("--keep", settings.keep, "leave the files there, and read those that are there already");
  CLI11_PARSE(app, argc, argv);
  std::vector<Row> rows;
  std::vector<std::string> missing;
  for (const std::string& kind : settings.kinds) {
    const std::string name = fmt::format("reading_{}_{}", settings.vertices, kind);
    rows.push_back({kind, mesh_files::path_of(settings.folder, name, kind), 0, {}, {}});
    if (kind == "freefem") {
      rows.back().format = FileFormat::freefem;
    }
    rows.back().milliseconds.resize(settings.threads.size());
    if (!settings.keep || !std::filesystem::exists(rows.back().path)) {
      missing.push_back(kind);
    }
  }
  if (!missing.empty()) {
    const MeshDocument document = document_of(random_delaunay_mesh(settings.vertices, 1));
    for (const Row& row : rows) {
      if (std::ranges::find(missing, row.kind) != missing.end()) {
        mesh_files::write(row.path, row.kind, document);
      }
    }
  }
  for (Row& row : rows) {
    for (const std::filesystem::path& file : files_of(row.path)) {
      row.bytes += static_cast<std::int64_t>(std::filesystem::file_size(file));
    }
  }
  for (int run = 0; run < settings.runs; ++run) {
    for (std::size_t t = 0; t < settings.threads.size(); ++t) {
      for (Row& row : rows) {
        const Stopwatch watch;
        const MeshDocument document = read_mesh(row.path, FileOptions{settings.threads[t], row.format});
        row.milliseconds[t].push_back(watch.milliseconds());
      }
    }
  }
  print(settings, rows);
  for (const Row& row : rows) {
    for (const std::filesystem::path& file :
         settings.keep ? std::vector<std::filesystem::path>() : files_of(row.path)) {
      std::filesystem::remove(file);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_reporting("reading", run, argc, argv);
}
