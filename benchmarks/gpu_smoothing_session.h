// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/report/spread.h"
#include "trismooth/smoothing/options.h"

/// What the experiments of gpu_smoothing have in common.
namespace benchmarks {

using Json = nlohmann::ordered_json;

/// The command line.
struct Settings {
  std::vector<std::string> experiments{"to-stop"};
  std::vector<std::int64_t> vertices;  ///< empty: those of each experiment
  std::vector<std::string> executions{"cpu", "single-block", "cdp", "resident"};
  std::vector<std::string> layouts{"aos", "soa"};
  std::vector<std::string> forms{"a", "b"};
  std::vector<std::string> precisions{"single", "double"};
  std::string method = "smart";
  std::string boundary = "random";
  std::string topology = "auto";
  std::string evaluation = "changed";
  std::int64_t max_sweeps = 1000;
  std::int64_t full_sweeps = 20;
  int runs = 7;
  int threads = 0;
  std::string json;
};

using trismooth::Spread;

Json json_of(const Spread& spread);

/// One run of the program: the device, the meshes, the report.
class Session {
 public:
  /// Looks for a device, measures a copy in its memory, and prints both.
  explicit Session(const Settings& settings);

  const Settings& settings() const { return settings_; }
  bool has_device() const { return has_device_; }
  /// Throws DeviceError where there is none.
  void require_device() const;
  /// Bytes that a copy within device memory reads and writes a second; 0 without a device.
  double bandwidth() const { return bandwidth_; }
  Json& report() { return report_; }

  /// The sizes asked for, or else these.
  std::vector<std::int64_t> sizes(std::initializer_list<std::int64_t> of_experiment) const;
  /// Generated when it is first asked for.
  const trismooth::RandomMesh& mesh(std::int64_t vertices);
  /// The options of the command line for an execution, or for "cpu". `layout`: "-" for what has none.
  trismooth::SmoothingOptions options(const std::string& execution, const std::string& layout, const std::string& form,
                                      const std::string& precision, const trismooth::RandomMesh& mesh) const;

  void note_different_bits() { same_bits_ = false; }
  bool same_bits() const { return same_bits_; }

 private:
  const Settings& settings_;
  bool has_device_ = false;
  double bandwidth_ = 0;
  std::map<std::int64_t, trismooth::RandomMesh> meshes_;
  Json report_;
  bool same_bits_ = true;
};

/// Results that are to be the same bit for bit.
class SameBits {
 public:
  explicit SameBits(Session& session) : session_(session) {}
  void compare(std::span<const double> xy);
  /// Of the first of them, as reports give it.
  std::string hash() const;

 private:
  Session& session_;
  std::vector<double> first_;
};

std::int32_t vertex_count_of(const trismooth::RandomMesh& mesh);

/// Milliseconds that function() takes by the host's clock.
double milliseconds_of(const std::function<void()>& function);

/// The most device memory in bytes that smoothing has had in use since the last call.
std::uint64_t most_memory_used();

}  // namespace benchmarks
