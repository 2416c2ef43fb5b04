// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/report_format.h"

#include <memory>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

WrittenAside write_report_text_aside(const std::filesystem::path& path, std::string_view text) {
  std::vector<std::unique_ptr<OutputFile>> files;
  OutputFile& file = *files.emplace_back(std::make_unique<OutputFile>(path));
  try {
    BufferedWriter writer(file.path());
    writer.write(text);
    writer.close();
  } catch (const WriteError& error) {
    // The writer knows the temporary file only.
    throw WriteError(path, error.reason);
  }
  file.prepare();
  return WrittenAside(std::move(files));
}

void write_report_text(const std::filesystem::path& path, std::string_view text) {
  write_report_text_aside(path, text).commit();
}

}  // namespace trismooth
