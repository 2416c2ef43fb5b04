// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/inp/inp_element_types.h"
#include "trismooth/mesh_io/inp/inp_source.h"

namespace trismooth {

/// What the names of sets are looked up in.
using InpNames = std::map<std::string, std::size_t, std::less<>>;

/// Nodes or elements of a part, an instance, an assembly, or of a file without these.
struct InpItems {
  std::vector<std::int64_t> labels;   ///< as the file numbers them; ids takes them over
  std::vector<std::int32_t> indices;  ///< of points or cells
  InpNames sets;                      ///< by key: places in the lists of the model
  PointIds ids{{}};
};

/// A space of labels and names.
struct InpScope {
  std::string name;                 ///< of the part or instance
  std::optional<std::size_t> part;  ///< the scope of the part that an instance is of
  InpItems nodes;
  InpItems elements;
};

/// A node set or an element set.
struct InpSet {
  std::string name;
  std::size_t scope = 0;
  bool is_of_lines = false;  ///< named by the keyword line of nodes or elements
  std::vector<std::int32_t> members = {};
};

/// Numbers from `first` to `last`, every `step`th.
struct InpRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::int64_t step = 1;
};

/// What a block of lines adds to a set.
struct InpSetLines {
  std::size_t set = 0;
  std::size_t scope = 0;  ///< in which its labels and names are
  std::vector<std::int64_t> labels = {};
  std::vector<InpRange> ranges = {};
  std::vector<std::string> names = {};  ///< of other sets, or "instance.label"; as in the file
  std::string elements = {};            ///< node sets: the element set whose nodes they are; empty: none
  std::int32_t first = 0;               ///< points or cells from here ...
  std::int32_t behind = 0;              ///< ... to before here
};

/// Elements of one keyword line.
struct InpElementBlock {
  std::size_t first_cell = 0;
  std::size_t scope = 0;
  std::string type;
  InpElementType known;
};

/// A section: it assigns what a region is made of to an element set.
struct InpSection {
  std::size_t scope = 0;
  std::string elements;  ///< the name of the set
};

/// An input file with all that belongs to it, as its lines say it.
struct InpModel {
  std::deque<InpSource> sources;  ///< the first is the file itself

  std::vector<double> points;  ///< x, y, z of every node, in the order of the lines
  std::vector<std::uint64_t> node_offsets;
  InpOrigins node_origins;

  std::vector<InpElementBlock> blocks;
  std::vector<std::size_t> element_begins{0};  ///< element e has references[element_begins[e] .. element_begins[e + 1])
  std::vector<std::int64_t> references;        ///< labels of nodes
  std::map<std::size_t, std::size_t> foreign;  ///< references in another scope than their element's
  std::vector<std::uint64_t> element_offsets;
  InpOrigins element_origins;

  std::deque<InpScope> scopes;  ///< the first: what is in no part
  InpNames parts;
  InpNames instances;
  std::vector<InpSet> node_sets;
  std::vector<InpSet> element_sets;
  std::vector<InpSetLines> node_set_lines;
  std::vector<InpSetLines> element_set_lines;
  std::vector<InpSection> sections;
  bool names_other_files = false;  ///< files that hold no part of the mesh

  std::size_t element_count() const { return element_offsets.size(); }
};

}  // namespace trismooth
