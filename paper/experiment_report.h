// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/paper/conclusions.h"
#include "trismooth/paper/experiment.h"
#include "trismooth/paper/tables.h"

namespace trismooth::experiments {

/// Where and when an experiment ran.
struct Setting {
  std::string command;  ///< that started it
  std::string date;     ///< "2026-11-21 20:28 UTC"
  std::string cpu;      ///< by name
  int threads = 0;      ///< of Version::cpu
  std::string gpu;      ///< by name; empty: none was used
  std::string cuda;     ///< versions and devices, as `trismooth info` shows them; empty: not in this build
};

/// All there is to say of an experiment.
struct ExperimentReport {
  Setting setting;
  ExperimentResult result;
  std::vector<Table> tables;
  std::vector<Conclusion> conclusions;
};

/// Tables and conclusions from a result; CPU, threads and GPU from its measurements.
ExperimentReport make_report(ExperimentResult result, std::string command, std::string date, std::string cuda);

/// What a reader must know beside the numbers, a sentence or two each: what was not measured and why, what stopped at
/// the sweep limit, whether all runs gave the same bits.
std::vector<std::string> remarks_on(const ExperimentReport& report);

/// How things were measured, the same for every report.
std::vector<std::string> how_it_is_measured();

/// For people, as the command line prints it: each mesh, the tables, the conclusions. Ends in a line feed.
std::string text_of(const ExperimentReport& report);

/// The tables, one line for each row of each, below a line with the names of the columns. Times are in milliseconds;
/// what was not measured or published is empty.
std::string csv_of(const ExperimentReport& report);

/// Everything, under keys that stay: see docs/command_line.md. What was not measured is null.
std::string json_of(const ExperimentReport& report);

/// A page for people, with the figures: one file that needs no other, no network and no script, and prints well. It is
/// well-formed XML, too.
std::string page_of(const ExperimentReport& report);

}  // namespace trismooth::experiments
