// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/small_hdf5.h"

namespace test_support {

/// CGNS files, in HDF5, of one base "B", node by node.
class SmallCgns {
 public:
  using Layout = SmallHdf5::Layout;

  SmallCgns() { node("/CGNSLibraryVersion", "CGNSLibraryVersion_t", "MT"); }

  SmallHdf5& file() { return file_; }
  std::string bytes() { return file_.bytes(); }

  void node(const std::string& path, const std::string& label, const std::string& type) {
    file_.group(path);
    file_.text(path, "label", label, 33);
    file_.text(path, "type", type, 3);
  }

  template <class T>
  void values(const std::string& path, const std::string& label, const std::string& type, const std::vector<T>& all,
              Layout layout = Layout::contiguous) {
    node(path, label, type);
    file_.values(path + "/ data", all, layout);
  }

  void text(const std::string& path, const std::string& label, const std::string& text) {
    values(path, label, "C1", std::vector<std::int8_t>(text.begin(), text.end()));
  }

  void base(std::int32_t axes) { values("/B", "CGNSBase_t", "I4", std::vector<std::int32_t>{2, axes}); }

  void zone(const std::string& name, std::int32_t points, std::int32_t cells,
            const std::string& type = "Unstructured") {
    values("/B/" + name, "Zone_t", "I4", std::vector<std::int32_t>{points, cells, 0});
    text("/B/" + name + "/ZoneType", "ZoneType_t", type);
    node("/B/" + name + "/G", "GridCoordinates_t", "MT");
  }

  template <class T>
  void coordinate(const std::string& zone, char axis, const std::vector<T>& all, Layout layout = Layout::contiguous) {
    values("/B/" + zone + "/G/Coordinate" + axis, "DataArray_t", sizeof(T) == 4 ? "R4" : "R8", all, layout);
  }

  /// `name`: "zone/section".
  void section(const std::string& name, std::int32_t type, std::int32_t first, std::int32_t last,
               const std::vector<std::int32_t>& nodes) {
    const std::string path = "/B/" + name;
    values(path, "Elements_t", "I4", std::vector<std::int32_t>{type, 0});
    values(path + "/ElementRange", "IndexRange_t", "I4", std::vector<std::int32_t>{first, last});
    values(path + "/ElementConnectivity", "DataArray_t", "I4", nodes);
  }

  void condition(const std::string& zone, const std::string& name, const std::string& location,
                 const std::vector<std::int32_t>& members) {
    const std::string all = "/B/" + zone + "/BC";
    if (H5Lexists(file_.id(), all.c_str(), H5P_DEFAULT) <= 0) {
      node(all, "ZoneBC_t", "MT");
    }
    text(all + "/" + name, "BC_t", "BCWall");
    values(all + "/" + name + "/PointList", "IndexArray_t", "I4", members);
    text(all + "/" + name + "/GridLocation", "GridLocation_t", location);
  }

 private:
  SmallHdf5 file_;
};

}  // namespace test_support
