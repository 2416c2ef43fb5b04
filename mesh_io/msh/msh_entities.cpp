// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_entities.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <string>

namespace trismooth {

namespace {

/// Version 4.0 writes some counts as int that later ones write as size_t.
std::int64_t read_count(MshInput& input, std::string_view what) {
  return input.header().version < 41 ? input.integer(what, 0, largest_msh_int) : input.size(what);
}

}  // namespace

void MshEntities::read(MshInput& input, bool partitioned) {
  if (partitioned) {
    read_count(input, "the number of partitions");
    const std::int64_t ghosts = read_count(input, "the number of ghost entities");
    for (std::int64_t i = 0; i < ghosts; ++i) {
      input.integer("the tag of a ghost entity", -largest_msh_int, largest_msh_int);
      input.integer("the partition of a ghost entity", -largest_msh_int, largest_msh_int);
    }
  }
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& count : counts) {
    count = input.size("a number of entities");
  }
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      read_one(input, dimension, partitioned);
    }
  }
}

void MshEntities::read_one(MshInput& input, int dimension, bool partitioned) {
  const std::int64_t tag = input.integer("the tag of an entity", -largest_msh_int, largest_msh_int);
  const std::size_t tag_offset = input.number_offset();
  MshEntity entity{.geometrical = static_cast<std::int32_t>(tag)};
  if (partitioned) {
    const std::int64_t parent_dimension = input.integer("the dimension of the parent entity", -1, 3);
    const std::int64_t parent = input.integer("the tag of the parent entity", -largest_msh_int, largest_msh_int);
    if (parent_dimension == dimension && parent != 0) {
      entity.geometrical = static_cast<std::int32_t>(parent);
    }
    const std::int64_t partitions = read_count(input, "the number of partitions");
    for (std::int64_t i = 0; i < partitions; ++i) {
      const std::int64_t partition = input.integer("a partition", -largest_msh_int, largest_msh_int);
      entity.partition = i == 0 ? static_cast<std::int32_t>(partition) : entity.partition;
    }
  }
  // A point has its place, all else, and in version 4.0 points too, the box around it.
  const int numbers = dimension == 0 && input.header().version >= 41 ? 3 : 6;
  for (int i = 0; i < numbers; ++i) {
    input.real("a coordinate of an entity");
  }
  const std::int64_t groups = input.size("the number of physical groups of an entity");
  for (std::int64_t i = 0; i < groups; ++i) {
    const auto group = static_cast<std::int32_t>(
        std::abs(input.integer("the tag of a physical group", -largest_msh_int, largest_msh_int)));
    if (group != 0 && (entity.physical.empty() || group != entity.physical.front())) {
      entity.physical.push_back(group);
    }
  }
  if (entity.physical.size() > 2) {
    std::sort(entity.physical.begin() + 1, entity.physical.end());
    entity.physical.erase(std::unique(entity.physical.begin() + 1, entity.physical.end()), entity.physical.end());
  }
  if (dimension > 0) {
    const std::int64_t bounds = input.size("the number of entities that bound an entity");
    for (std::int64_t i = 0; i < bounds; ++i) {
      input.integer("the tag of an entity that bounds an entity", -largest_msh_int, largest_msh_int);
    }
  }
  if (!entities_.try_emplace({dimension, tag}, std::move(entity)).second && !partitioned) {
    input.fail_at(tag_offset, "the entity " + std::to_string(tag) + " of dimension " + std::to_string(dimension) +
                                  " is listed a second time");
  }
}

const MshEntity& MshEntities::operator()(int dimension, std::int64_t tag) {
  return entities_.try_emplace({dimension, tag}, MshEntity{.geometrical = static_cast<std::int32_t>(tag)})
      .first->second;
}

}  // namespace trismooth
