#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <vector>

namespace trismooth {

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
