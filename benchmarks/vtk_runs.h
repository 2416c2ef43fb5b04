// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

/// What VTK takes for the same work.
namespace vtk_runs {

/// Milliseconds.
struct Times {
  double read = 0;
  double smooth = 0;
  double write = 0;
};

/// Whether VTK has a reader and a writer for it: vtk (legacy), vtu.
bool reads(const std::string& format);

/// Reads `input`, smooths it by vtkSmoothPolyDataFilter with its boundary held, and writes it to `output`.
Times run(const std::filesystem::path& input, const std::filesystem::path& output, const std::string& format,
          int sweeps);

}  // namespace vtk_runs
