// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/bytes/file_content.h"

namespace trismooth {

/// A kind of report: the extension of the file name that asks for it (".json"), and the function that writes its text.
template <class Writer>
struct ReportFormat {
  std::string_view extension;
  Writer write;
};

/// The function of the format whose extension the path has, in upper or lower case. Throws std::invalid_argument, which
/// names all that there are, for `what` is written.
template <class Writer>
Writer writer_for(const std::filesystem::path& path, std::span<const ReportFormat<Writer>> formats,
                  std::string_view what = "report") {
  const std::string extension = lower_case(path.extension().string());
  std::string known;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (formats[i].extension == extension) {
      return formats[i].write;
    }
    known.append(i == 0 ? "" : i + 1 == formats.size() ? " or " : ", ").append(formats[i].extension);
  }
  throw std::invalid_argument("'" + path.string() + "' is no " + std::string(what) + " file; its name must end in " +
                              known);
}

/// Writes `text` to a file, which takes its place when it is committed. Throws WriteError.
WrittenAside write_report_text_aside(const std::filesystem::path& path, std::string_view text);

/// Writes `text` to a file. An old file of that name survives any failure. Throws WriteError.
void write_report_text(const std::filesystem::path& path, std::string_view text);

}  // namespace trismooth
