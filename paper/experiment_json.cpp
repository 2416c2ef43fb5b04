// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "trismooth/paper/experiment_report.h"
#include "trismooth/version.h"

namespace trismooth::experiments {

namespace {

using Json = nlohmann::ordered_json;

Json spread_json(const Spread& spread) {
  return {{"median", spread.median}, {"least", spread.least}, {"most", spread.most}};
}

Json spread_json(const std::optional<Spread>& spread) {
  return spread ? spread_json(*spread) : Json(nullptr);
}

Json text_json(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

/// The lines of a text; null where there are none.
Json lines_json(const std::string& text) {
  Json lines = nullptr;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

template <class Enum>
Json enum_json(Enum value) {
  return std::string(to_string(value));
}

Json machine_json(const Setting& setting) {
  return {{"cpu", setting.cpu},
          {"threads", setting.threads > 0 ? Json(setting.threads) : Json(nullptr)},
          {"gpu", text_json(setting.gpu)},
          {"cuda", lines_json(setting.cuda)}};
}

Json options_json(const ExperimentOptions& options) {
  Json versions = Json::array();
  for (const Version version : options.versions) {
    versions.push_back(enum_json(version));
  }
  return {{"sizes", options.sizes},
          {"versions", std::move(versions)},
          {"precision", enum_json(options.precision)},
          {"seed", options.seed},
          {"runs", options.runs},
          {"seconds", options.seconds},
          {"threads", options.threads}};
}

Json meshes_json(const std::vector<MeshCounts>& meshes) {
  Json list = Json::array();
  for (const MeshCounts& mesh : meshes) {
    list.push_back({{"size", mesh.asked}, {"vertices", mesh.vertices}, {"triangles", mesh.triangles}});
  }
  return list;
}

Json case_json(const Case& what) {
  return {{"version", enum_json(what.version)},
          {"layout", runs_on_device(what.version) ? enum_json(what.layout) : Json(nullptr)},
          {"form", enum_json(what.form)},
          {"order", enum_json(what.order)}};
}

Json measurement_json(const Measurement& measured) {
  return {{"runs", measured.runs},
          {"device", measured.device},
          {"threads", measured.threads},
          {"topology_ms", spread_json(measured.topology)},
          {"transfer_ms", spread_json(measured.transfer)},
          {"smoothing_ms", spread_json(measured.smoothing)},
          {"together_ms", spread_json(measured.together)},
          {"sweeps", spread_json(measured.sweeps)},
          {"stop_reason", enum_json(measured.stop_reason)},
          {"vertex_updates", measured.vertex_updates},
          {"free_vertices", measured.free_vertices},
          {"coordinates_hash", measured.coordinates_hash},
          {"same_bits_in_every_run", measured.same_bits_again},
          {"same_bits_as_first_case", measured.same_bits_as_first}};
}

Json rows_json(const ExperimentResult& result) {
  Json list = Json::array();
  for (const Row& row : result.rows) {
    Json json{{"size", row.vertices}};
    json.update(case_json(row.what));
    json["missing_reason"] = text_json(row.missing_reason);
    json["measured"] = row.measured ? measurement_json(*row.measured) : Json(nullptr);
    json["speedup"] = spread_json(result.speedup(row.vertices, row.what));
    json["speedup_together"] = spread_json(result.speedup_together(row.vertices, row.what));
    list.push_back(std::move(json));
  }
  return list;
}

Json published_json(const PublishedRow* row) {
  return row == nullptr ? Json(nullptr)
                        : Json{{"serial_ms", row->cpu_ms},
                               {"aos_ms", row->aos_ms},
                               {"soa_ms", row->soa_ms},
                               {"aos_speedup", row->aos_speedup},
                               {"soa_speedup", row->soa_speedup}};
}

Json tables_json(const std::vector<Table>& tables) {
  Json list = Json::array();
  for (const Table& table : tables) {
    Json rows = Json::array();
    for (const TableRow& row : table.rows) {
      rows.push_back({{"size", row.vertices},
                      {"serial_ms", spread_json(row.serial_ms)},
                      {"aos_ms", spread_json(row.aos_ms)},
                      {"soa_ms", spread_json(row.soa_ms)},
                      {"aos_speedup", spread_json(row.aos_speedup)},
                      {"soa_speedup", spread_json(row.soa_speedup)},
                      {"paper", published_json(row.published)}});
    }
    list.push_back({{"table", table.number > 0 ? Json(table.number) : Json(nullptr)},
                    {"title", table.title},
                    {"version", enum_json(table.version)},
                    {"form", enum_json(table.form)},
                    {"order", enum_json(table.order)},
                    {"missing_reason", text_json(table.missing_reason)},
                    {"rows", std::move(rows)}});
  }
  return list;
}

Json comparison_json(const Comparison& comparison) {
  return {{"claimed_faster", case_json(comparison.claimed_faster)},
          {"claimed_slower", case_json(comparison.claimed_slower)},
          {"size", comparison.vertices},
          {"factor", spread_json(comparison.factor)},
          {"support", enum_json(comparison.support)},
          {"paper_factor", comparison.published ? Json(*comparison.published) : Json(nullptr)},
          {"sweeps", comparison.sweeps ? Json{{"claimed_faster", spread_json((*comparison.sweeps)[0])},
                                              {"claimed_slower", spread_json((*comparison.sweeps)[1])}}
                                       : Json(nullptr)}};
}

Json conclusions_json(const std::vector<Conclusion>& conclusions) {
  Json list = Json::array();
  for (const Conclusion& conclusion : conclusions) {
    Json comparisons = Json::array();
    for (const Comparison& comparison : conclusion.comparisons) {
      comparisons.push_back(comparison_json(comparison));
    }
    list.push_back({{"number", conclusion.number},
                    {"claim", conclusion.claim},
                    {"verdict", enum_json(conclusion.verdict)},
                    {"findings", conclusion.findings},
                    {"comparisons", std::move(comparisons)}});
  }
  return list;
}

}  // namespace

std::string json_of(const ExperimentReport& report) {
  const Json json{{"trismooth", std::string(version())},
                  {"date", report.setting.date},
                  {"command", report.setting.command},
                  {"machine", machine_json(report.setting)},
                  {"options", options_json(report.result.options)},
                  {"meshes", meshes_json(report.result.meshes)},
                  {"rows", rows_json(report.result)},
                  {"tables", tables_json(report.tables)},
                  {"conclusions", conclusions_json(report.conclusions)},
                  {"same_bits", report.result.same_bits()},
                  {"remarks", remarks_on(report)}};
  constexpr int indent = 1;
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace trismooth::experiments
