// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/errors.h"

#include "memory_peak.h"
#include "support/one_file_codec.h"
#include "support/sanitized.h"
#include "support/share_of_cases.h"

using trismooth::CellList;
using trismooth::DataArray;
using trismooth::MeshDocument;

namespace {

/// Keeps what VTK would print.
class Listener : public vtkOutputWindow {
 public:
  static Listener* New();
  // NOLINTNEXTLINE(bugprone-derived-method-shadowing-base-method): VTK's macro is meant to
  vtkTypeMacro(Listener, vtkOutputWindow) void DisplayText(const char* text) override { heard += text; }
  std::string heard;
};
vtkStandardNewMacro(Listener);

Listener& listener() {
  static const vtkSmartPointer<Listener> only = [] {
    auto made = vtkSmartPointer<Listener>::New();
    vtkOutputWindow::SetInstance(made);
    return made;
  }();
  return *only;
}

/// Whether it is UTF-8 without control characters, and without those that hide, break lines or turn their neighbours
/// round.
bool is_visible(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U; };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    if (length == 0) {
      return false;
    }
    unsigned code = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t k = 1; k < length; ++k) {
      if ((byte(i + k) & 0xC0U) != 0x80) {
        return false;
      }
      code = code << 6U | (byte(i + k) & 0x3FU);
    }
    const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool turns = code == 0x61C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
                       (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
    if (is_control || turns) {
      return false;
    }
    i += length;
  }
  return true;
}

std::string unclear(std::string_view message, std::string_view path) {
  constexpr std::size_t longest = 300;
  if (!message.starts_with(std::string(path) + ":")) {
    return fmt::format("the message does not begin with the file: {}", message);
  }
  if (message.size() > longest) {
    return fmt::format("the message has {} characters: {}", message.size(), message);
  }
  if (!is_visible(message)) {
    return fmt::format("the message is not one line of visible characters: {}", message);
  }
  return {};
}

std::string differing_arrays(std::span<const DataArray> a, std::span<const DataArray> b, std::string_view what) {
  if (a.size() != b.size()) {
    return fmt::format("{} {} arrays, {}", a.size(), what, b.size());
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].name != b[i].name || a[i].type != b[i].type || a[i].components != b[i].components ||
        !std::ranges::equal(a[i].bytes, b[i].bytes)) {
      return fmt::format("{} array {} ({})", what, i, a[i].name);
    }
  }
  return {};
}

/// The most that reading one of these small files may take. Before VTK's classes are used, the memory for their buffers
/// is tried (4 MiB); liblzma makes room for a dictionary of 1 MiB.
constexpr std::size_t most_memory = std::size_t{1} << 20;
constexpr std::size_t most_memory_of_library = std::size_t{6} << 20;

}  // namespace

bool is_vtk_xml(const accepted_files::AcceptedFile& file) {
  return file.extension == ".vtu" || file.extension == ".vtp";
}

bool is_kept_by_hdf5(const accepted_files::AcceptedFile& file) {
  return file.bytes.starts_with("\x89HDF");
}

std::size_t stride_of(const accepted_files::AcceptedFile& file) {
  if (is_kept_by_hdf5(file)) {
    // Each file that is read takes a process.
    return is_sanitized ? 401 : per_cent_of_cases() >= 100 ? 37 : 131;
  }
  if (!is_sanitized && per_cent_of_cases() >= 100) {
    return 1;
  }
  // Odd ones, which meet numbers at all their bytes; rows of Medit's may be three numbers.
  if (!is_sanitized || !is_vtk_xml(file)) {
    return file.name.starts_with("medit") ? 5 : 3;
  }
  return file.name.find("lzma") == std::string::npos ? 13 : 61;
}

Outcome read(const accepted_files::AcceptedFile& file, const std::string& bytes) {
  const std::string path = "some folder/" + file.name + file.extension;
  // (HDF5 takes some for itself.)
  const bool is_large = is_vtk_xml(file) || bytes.starts_with("\x89HDF");
  const std::size_t limit = is_large ? most_memory_of_library : most_memory;
  Outcome outcome;
  listener().heard.clear();
  const MemoryPeak peak;
  try {
    outcome.document = test_support::one_file_codec(accepted_files::format_of(file)).read(path, bytes);
    outcome.fault = broken_promise(*outcome.document);
  } catch (const trismooth::ReadError& error) {
    outcome.message = error.what();
    outcome.fault = unclear(outcome.message, path);
  } catch (const std::exception& error) {
    outcome.fault = std::string("throws another exception: ") + error.what();
  }
  if (peak.bytes() > limit) {
    outcome.fault += fmt::format(" takes {} bytes of memory", peak.bytes());
  }
  if (!listener().heard.empty()) {
    outcome.fault += " VTK prints: " + listener().heard;
  }
  return outcome;
}

Outcome read(const accepted_files::AcceptedFile& file) {
  return read(file, file.bytes);
}

Outcome read_and_write(const accepted_files::AcceptedFile& file, const std::string& bytes) {
  Outcome outcome = read(file, bytes);
  if (outcome.document && outcome.fault.empty()) {
    try {
      written_back(*outcome.document);
    } catch (const std::exception& error) {
      outcome.fault = std::string("is read, but not written: ") + error.what();
    }
    if (!listener().heard.empty()) {
      outcome.fault += " VTK prints: " + listener().heard;
    }
  }
  return outcome;
}

std::string broken_promise(const MeshDocument& document) {
  const CellList& cells = document.cells;
  const auto points = static_cast<std::int64_t>(document.point_count());
  const auto are_rows = [](std::size_t rows) {
    return
        [rows](const DataArray& array) { return array.bytes.size() == rows * array.components * size_of(array.type); };
  };
  if (document.points.size() % 3 != 0 ||
      !std::ranges::all_of(document.points, [](double x) { return std::isfinite(x); })) {
    return "points";
  }
  if (cells.offsets.size() != cells.size() + 1 || cells.offsets.front() != 0 ||
      !std::ranges::is_sorted(cells.offsets) ||
      cells.offsets.back() != static_cast<std::int64_t>(cells.connectivity.size())) {
    return "offsets of cells";
  }
  if (!std::ranges::all_of(cells.connectivity, [&](std::int32_t v) { return v >= 0 && v < points; })) {
    return "vertex indices";
  }
  if (!std::ranges::all_of(document.point_arrays, are_rows(document.point_count()))) {
    return "rows of point arrays";
  }
  if (!std::ranges::all_of(document.cell_arrays, are_rows(cells.size()))) {
    return "rows of cell arrays";
  }
  return document.original == nullptr ? "no original" : "";
}

std::string difference(const MeshDocument& a, const MeshDocument& b) {
  if (!std::ranges::equal(std::as_bytes(std::span(a.points)), std::as_bytes(std::span(b.points))) ||
      a.point_type != b.point_type) {
    return "points";
  }
  if (a.cells.offsets != b.cells.offsets || a.cells.connectivity != b.cells.connectivity ||
      a.cells.types != b.cells.types) {
    return "cells";
  }
  return differing_arrays(a.point_arrays, b.point_arrays, "point") +
         differing_arrays(a.cell_arrays, b.cell_arrays, "cell") +
         differing_arrays(a.field_arrays, b.field_arrays, "field");
}

std::string written_back(const MeshDocument& document) {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("trismooth_bad_input_{}", getpid());
  document.original->write(path, document, {}, {});
  std::ifstream file(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(path);
  return bytes;
}

void Faults::add(std::string_view file, std::string_view place, std::string_view what) {
  constexpr std::size_t most_told = 30;
  if (count_++ < most_told) {
    text_ += fmt::format("{}, {}: {}\n", file, place, what);
  }
}
