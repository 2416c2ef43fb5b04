// SPDX-License-Identifier: BSD-3-Clause
#include "tool_runs.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/cli/command_line.h"

#include "support/hostile_meshes.h"

void run_tool(std::vector<std::string> words) {
  words.insert(words.begin(), {"trismooth", "smooth"});
  words.insert(words.end(), {"--backend", "cpu", "--threads", "1", "--max-sweeps", "2"});
  std::vector<const char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  std::ostringstream out;
  std::ostringstream err;
  if (trismooth::run_command_line(static_cast<int>(arguments.size()), arguments.data(), {out, err}) != 0) {
    std::fputs(err.str().c_str(), stdout);
    std::exit(1);
  }
}

GrowthCase file_case(const std::string& name, int size, const std::string& input, const std::string& output,
                     std::string (*make)(int)) {
  return {name + ": " + input + " to " + output, size, [=](int count, const ScratchFolder& folder) {
            const std::string from = folder.write("in." + input, make(count));
            const std::string to = folder / ("out." + output);
            return [=] { run_tool({from, to}); };
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
            return [=] { run_tool({from, to}); };
          }};
}
