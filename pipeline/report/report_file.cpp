// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/report_file.h"

#include <array>
#include <string>

#include "trismooth/pipeline/report/html_report.h"
#include "trismooth/pipeline/report/json_report.h"
#include "trismooth/pipeline/report/report_format.h"

namespace trismooth {

namespace {

using ReportWriter = std::string (*)(const PipelineOptions&, const PipelineResult&, const RunRecord&);

ReportWriter writer_of(const std::filesystem::path& path) {
  static constexpr std::array<ReportFormat<ReportWriter>, 2> formats{
      {{".json", &json_report}, {".html", &html_report}}};
  return writer_for<ReportWriter>(path, formats);
}

}  // namespace

void require_report_extension(const std::filesystem::path& path) {
  writer_of(path);
}

bool shows_mesh(const std::filesystem::path& path) {
  return writer_of(path) == &html_report;
}

WrittenAside write_report_aside(const std::filesystem::path& path, const PipelineOptions& options,
                                const PipelineResult& result, const RunRecord& record) {
  return write_report_text_aside(path, writer_of(path)(options, result, record));
}

}  // namespace trismooth
