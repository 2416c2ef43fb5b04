// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

namespace trismooth {

/// A node of a CGNS file: a group of HDF5 that has a label, data and children.
struct CgnsNode {
  std::string path;
  std::string name;
  std::string label;  ///< its type: "Zone_t"
};

/// The nodes of a CGNS file in HDF5. Throws ReadError, which names the file and
/// the node.
class CgnsTree {
 public:
  /// `bytes` outlive the object.
  CgnsTree(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), file_(path, bytes), budget_(path, bytes.size()) {}

  const Hdf5Reader& file() const { return file_; }

  /// Of the root, whose path is empty, or of a node: those with that label, all
  /// where it is empty. A link to another node or file is refused.
  std::vector<CgnsNode> children(const std::string& path, std::string_view label) const;
  /// The child of that name and label.
  std::optional<CgnsNode> child(const CgnsNode& node, std::string_view name, std::string_view label) const;

  /// The dataset with the data of the node; empty where it has none.
  std::string data_of(const CgnsNode& node) const;
  /// The data, which are to be whole numbers.
  std::vector<std::int64_t> integers(const CgnsNode& node);
  /// The data, which are to be characters, without blanks at the end; empty
  /// where there are none.
  std::string text(const CgnsNode& node);
  /// To be called before so many numbers are read: a file may name one list
  /// many times.
  void spend(std::uint64_t numbers) { budget_.spend(static_cast<std::size_t>(numbers)); }

  [[noreturn]] void fail(const std::string& message) const;
  /// "the node 'TRI' message".
  [[noreturn]] void fail_at(const CgnsNode& node, const std::string& message) const;

 private:
  std::filesystem::path path_;
  Hdf5Reader file_;
  MemberBudget budget_;
};

}  // namespace trismooth
