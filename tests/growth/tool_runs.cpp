// SPDX-License-Identifier: BSD-3-Clause
#include "tool_runs.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/cli/mesh_run.h"
#include "trismooth/pipeline/cli/printable_stream.h"

#include "support/hostile_meshes.h"

void run_tool(const std::string& from, const std::string& to, const std::vector<std::filesystem::path>& reports) {
  trismooth::MeshRunSettings settings;
  settings.pipeline.input = from;
  settings.pipeline.output = to;
  settings.pipeline.smoothing.threads = 1;
  settings.pipeline.smoothing.max_sweeps = 2;
  settings.reports = reports;
  settings.verbosity = reports.empty() ? trismooth::Verbosity::normal : trismooth::Verbosity::verbose;
  std::ostringstream text;
  trismooth::PrintableStream said(text);
  try {
    trismooth::run_on_mesh(settings, {said, said});
  } catch (const std::exception& error) {
    std::printf("%s: %s\n", from.c_str(), error.what());
    std::exit(1);
  }
}

GrowthCase file_case(const std::string& name, int size, const std::string& input, const std::string& output,
                     std::string (*make)(int)) {
  return {name + ": " + input + " to " + output, size, [=](int count, const ScratchFolder& folder) {
            const std::string from = folder.write("in." + input, make(count));
            const std::string to = folder / ("out." + output);
            return [=] { run_tool(from, to); };
          }};
}

std::string off_text(const test_meshes::Mesh& mesh) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const auto& point : mesh.points) {
    text << point.x << ' ' << point.y << " 0\n# a comment\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "3 " << a << ' ' << b << ' ' << c << '\n';
  }
  return text.str();
}

std::string chain_off_text(int length) {
  return off_text(hostile_meshes::chain(length));
}

GrowthCase chain_in(const std::string& format, const std::string& extension) {
  return {"a chain of vertices: " + format + " to " + format + " (." + extension + ")", 100,
          [=](int count, const ScratchFolder& folder) {
            const std::string off = folder.write("chain.off", chain_off_text(count));
            const std::string from = folder / ("in." + extension);
            const std::string to = folder / ("out." + extension);
            write_mesh(from, trismooth::read_mesh(off), {}, {1, trismooth::format_named(format)});
            return [=] { run_tool(from, to); };
          }};
}
