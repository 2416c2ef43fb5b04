// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/xdmf/xdmf_paths.h"

namespace trismooth {

/// A uniform grid: what it has itself, and what it includes or refers to.
struct XdmfGrid {
  const XmlElement* element = nullptr;
  const XmlElement* topology = nullptr;
  const XmlElement* geometry = nullptr;
  XmlElements attributes{};
  XmlElements sets{};
  XmlElements information{};
};

/// The grids of an XDMF file.
struct XdmfGrids {
  std::vector<XdmfGrid> first;  ///< of the first time step where there are several
  /// Grids of later steps, each with the place in `first` of the one that it must be.
  std::vector<std::pair<std::size_t, XdmfGrid>> later;
  std::size_t steps = 1;         ///< of the longest collection in time
  std::optional<double> time{};  ///< of the last of these
  std::size_t domains = 1;       ///< whose first one has the grids
};

/// Finds the grids of the first domain, in the file's order, those of collections and trees one by one. Throws
/// ReadError.
XdmfGrids find_xdmf_grids(const std::filesystem::path& file, const XmlElement& root, XdmfPaths& paths);

}  // namespace trismooth
