#include "trismooth/pipeline/report_file.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

#include "trismooth/mesh_io/buffered_writer.h"
#include "trismooth/mesh_io/output_file.h"
#include "trismooth/pipeline/html_report.h"
#include "trismooth/pipeline/json_report.h"

namespace trismooth {

namespace {

using ReportWriter = std::string (*)(const PipelineOptions&, const PipelineResult&);

ReportWriter writer_for(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".json") {
    return &json_report;
  }
  if (extension == ".html") {
    return &html_report;
  }
  throw std::invalid_argument("'" + path.string() + "' is no report file; its name must end in .json or .html");
}

}  // namespace

void require_report_extension(const std::filesystem::path& path) {
  writer_for(path);
}

void write_report(const std::filesystem::path& path, const PipelineOptions& options, const PipelineResult& result) {
  const std::string text = writer_for(path)(options, result);
  OutputFile file(path);
  BufferedWriter writer(file.path());
  writer.write(text);
  writer.close();
  file.commit();
}

}  // namespace trismooth
