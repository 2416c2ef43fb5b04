// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_tree.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::string_view data_name = "/ data";

}  // namespace

std::vector<CgnsNode> CgnsTree::children(const std::string& path, std::string_view label) const {
  std::vector<CgnsNode> found;
  for (Hdf5Member& member : file_.members(path.empty() ? "/" : path)) {
    if (member.kind == Hdf5Kind::link) {
      fail("the node " + quoted(std::string_view(member.name)) +
           " is a link to elsewhere, which is not followed: write the mesh as "
           "one file without links");
    }
    CgnsNode node{path + "/" + member.name, std::move(member.name), {}};
    if (member.kind != Hdf5Kind::group || !file_.has_attribute(node.path, "label")) {
      continue;
    }
    const std::vector<std::string> labels = file_.read_attribute_texts(node.path, "label");
    node.label = labels.size() == 1 ? labels.front() : std::string();
    // A node that is a link has no label of its own.
    if (node.label.empty() && file_.has_attribute(node.path, "type")) {
      const std::vector<std::string> type = file_.read_attribute_texts(node.path, "type");
      if (type.size() == 1 && type.front() == "LK") {
        fail_at(node, "is a link to elsewhere, which is not followed: write the mesh as one file without links");
      }
    }
    if (label.empty() || node.label == label) {
      found.push_back(std::move(node));
    }
  }
  return found;
}

std::optional<CgnsNode> CgnsTree::child(const CgnsNode& node, std::string_view name, std::string_view label) const {
  std::vector<CgnsNode> all = children(node.path, label);
  const auto found = std::ranges::find(all, name, &CgnsNode::name);
  return found == all.end() ? std::nullopt : std::optional(std::move(*found));
}

std::string CgnsTree::data_of(const CgnsNode& node) const {
  std::string data = node.path + std::string(data_name);
  return file_.kind_of(data) == Hdf5Kind::dataset ? data : std::string();
}

std::vector<std::int64_t> CgnsTree::integers(const CgnsNode& node) {
  const std::string data = data_of(node);
  if (data.empty()) {
    fail_at(node, "has no data");
  }
  spend(file_.shape_of(data).count());
  return file_.read<std::int64_t>(data);
}

std::string CgnsTree::text(const CgnsNode& node) {
  const std::string data = data_of(node);
  if (data.empty()) {
    return {};
  }
  spend(file_.shape_of(data).count());
  const std::vector<std::int8_t> characters = file_.read<std::int8_t>(data);
  std::string text(characters.begin(), characters.end());
  text.resize(std::min(text.find('\0'), text.size()));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

void CgnsTree::fail(const std::string& message) const {
  throw ReadError(path_, message);
}

void CgnsTree::fail_at(const CgnsNode& node, const std::string& message) const {
  fail("the node " + quoted(std::string_view(node.name)) + " " + message);
}

}  // namespace trismooth
