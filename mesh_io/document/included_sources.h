// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"

namespace trismooth {

/// A file that another one includes, or why it is none: a part of a sentence.
struct IncludedFile {
  std::filesystem::path path;
  std::string problem;
};

/// The file of that name beside the last of the `open` ones, each of which includes the next, or else beside the first;
/// a backslash may be a slash. A problem where there is none, where it is one of these, and where they are too many;
/// `sources` is how many files there are already.
IncludedFile find_included(const std::filesystem::path& name, std::span<const std::filesystem::path> open,
                           std::size_t sources);

/// The note on files that a mesh includes, by their names; `names` has one at least.
std::string note_of_included(const std::set<std::string>& names);

/// Adds the file of that name, which the last of the `open` sources includes, to `sources`: with its
/// `path` and its `bytes`. Returns its index. Calls fail(message), which throws, where there is no such file.
template <class Sources, class Fail>
std::size_t add_included(Sources& sources, std::span<const std::size_t> open, const std::filesystem::path& name,
                         const FileWorkers& workers, const Fail& fail) {
  std::vector<std::filesystem::path> paths;
  std::ranges::transform(open, std::back_inserter(paths), [&](std::size_t source) { return sources[source].path; });
  const IncludedFile file = find_included(name, paths, sources.size());
  if (!file.problem.empty()) {
    fail(file.problem);
  }
  auto& source = sources.emplace_back();
  source.path = file.path;
  source.bytes = read_file_bytes(file.path, workers);
  return sources.size() - 1;
}

/// Adds the note on what the sources include, where they do.
template <class Sources>
void add_note_of_included(const Sources& sources, std::vector<std::string>& notes) {
  std::set<std::string> names;
  for (const auto& source : sources) {
    for (const auto& include : source.includes) {
      names.insert(include.name.string());
    }
  }
  if (!names.empty()) {
    notes.push_back(note_of_included(names));
  }
}

/// Which of the files that a mesh was read from cannot stay outside where it is written to `folder`, one each: those in
/// which anything changes, and those that would not be found from there; with each of them all that include it. Of the
/// sources the first is the file itself, which never is one of them; an included one stands behind that which includes
/// it. A source has a `path` and `includes`, each with the index of its `source` and the `name` that the file gives it.
/// has_changed(source) is asked of included ones.
template <class Sources, class HasChanged>
std::vector<bool> sources_that_come_in(const Sources& sources, const std::filesystem::path& folder,
                                       const HasChanged& has_changed) {
  std::vector<bool> comes_in(sources.size(), false);
  // From inside out, what has changed ...
  for (std::size_t i = sources.size(); i-- > 1;) {
    comes_in[i] =
        std::ranges::any_of(sources[i].includes, [&](const auto& include) { return comes_in[include.source]; }) ||
        has_changed(sources[i]);
  }
  // ... and from outside in, what would not be found any more: a file there that is none or another one.
  const auto is_found = [&](const auto& include) {
    std::error_code error;
    return std::filesystem::equivalent(folder / include.name, sources[include.source].path, error);
  };
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (const auto& include : sources[i].includes) {
      if ((i == 0 || comes_in[i]) && !is_found(include)) {
        comes_in[include.source] = true;
      }
    }
  }
  return comes_in;
}

}  // namespace trismooth
