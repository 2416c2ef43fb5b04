// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/paper/experiment.h"

namespace trismooth::experiments {

/// A row of a table in the paper's layout: running times in milliseconds, and how many times faster than the serial CPU
/// version that is. What was not measured is empty.
struct TableRow {
  std::int64_t vertices = 0;
  std::optional<Spread> serial_ms;  ///< of the serial CPU version
  std::optional<Spread> aos_ms;
  std::optional<Spread> soa_ms;
  std::optional<Spread> aos_speedup;
  std::optional<Spread> soa_speedup;
  const PublishedRow* published = nullptr;  ///< what the paper has in this place; null: nothing
};

/// A version in one form, over all sizes.
struct Table {
  int number = 0;     ///< of the paper's table; 0: the paper has none like it
  std::string title;  ///< "Table 1: GPU version, Form A", "Resident version, Form A"
  Version version = Version::gpu;
  Form form = Form::swap;
  Order order = Order::colour;
  std::vector<TableRow> rows;  ///< one a size
  std::string missing_reason;  ///< why nothing in it was measured beside the CPU; empty where something was
};

/// Whether any case was measured on this mesh.
bool any_measured_on(const ExperimentResult& result, const MeshCounts& mesh);

/// The paper's four tables in its order, then those like them for what the paper does not have: Form B of its versions
/// in colour order, the resident version. Versions that the experiment was not asked for have no table.
std::vector<Table> tables_of(const ExperimentResult& result);

}  // namespace trismooth::experiments
