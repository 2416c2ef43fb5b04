// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_original.h"

#include <algorithm>
#include <string>
#include <utility>

#include "trismooth/mesh_io/document/included_sources.h"
#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// The text to write, still with the numbers that were read: sources in each other's places, and zeros in those of
/// coordinates that were left out.
struct ExpandedInp {
  std::string text;
  std::vector<NumberSites> sites;
};

class InpOriginal : public OriginalFile {
 public:
  InpOriginal(std::deque<InpSource> sources, std::vector<double> points)
      : sources_(std::move(sources)), points_(std::move(points)) {}

  void write(const std::filesystem::path& path, const MeshDocument& document,
             std::span<const DataArray> added_point_arrays, std::span<const DataArray> added_cell_arrays,
             Workers& workers) const override {
    require_same_points(path, document, points_.size() / 3, "nodes", added_point_arrays, added_cell_arrays);
    const std::vector<bool> comes_in = sources_that_come_in(
        sources_, path.parent_path(), [&](const InpSource& source) { return has_changed(source, document); });
    if (std::ranges::find(comes_in, true) == comes_in.end() && !fills_gaps(sources_.front(), document)) {
      write_sites(path, sources_.front().bytes, sources_.front().sites, document, workers);
      return;
    }
    ExpandedInp expanded;
    append(expanded, 0, comes_in, document);
    write_sites(path, expanded.text, expanded.sites, document, workers);
  }

 private:
  bool has_changed(const InpSource& source, const MeshDocument& document) const {
    return fills_gaps(source, document) || has_moved_sites(source, document);
  }

  bool fills_gaps(const InpSource& source, const MeshDocument& document) const {
    return std::ranges::any_of(source.gaps,
                               [&](const InpGap& gap) { return has_moved(document, gap.vertex, gap.component); });
  }

  bool has_moved_sites(const InpSource& source, const MeshDocument& document) const {
    return std::ranges::any_of(source.sites, [&](const NumberSites& sites) {
      return std::ranges::any_of(sites.vertices, [&](std::int32_t vertex) {
        return has_moved(document, vertex, 0) || has_moved(document, vertex, 1) || has_moved(document, vertex, 2);
      });
    });
  }

  bool has_moved(const MeshDocument& document, std::int32_t vertex, std::size_t component) const {
    const std::size_t i = 3 * static_cast<std::size_t>(vertex) + component;
    return document.points[i] != points_[i];
  }

  void append(ExpandedInp& out, std::size_t index, const std::vector<bool>& comes_in,
              const MeshDocument& document) const {
    const InpSource& source = sources_[index];
    const std::string_view bytes = source.bytes;
    std::size_t done = index > 0 ? begin_of_text(bytes) : 0;
    auto list = source.sites.begin();
    std::size_t site = 0;
    auto gap = source.gaps.begin();
    const auto copy_until = [&](std::size_t end) {
      // Lists of sites that reach behind `end` are divided there.
      const std::size_t shift = out.text.size() - done;
      while (list != source.sites.end() && (site == list->size() || list->offsets[site * list->columns.size()] < end)) {
        if (site == list->size()) {
          ++list;
          site = 0;
          continue;
        }
        add_site(out, *list, site++, shift);
      }
      out.text.append(bytes.substr(done, end - done));
      done = end;
    };
    const auto fill_gaps_until = [&](std::size_t end) {
      while (gap != source.gaps.end() && gap->offset < end) {
        auto behind = std::find_if(gap, source.gaps.end(), [&](const InpGap& g) { return g.vertex != gap->vertex; });
        auto last = behind;
        while (last != gap && !has_moved(document, std::prev(last)->vertex, std::prev(last)->component)) {
          --last;
        }
        for (; gap != last; ++gap) {
          copy_until(static_cast<std::size_t>(gap->offset));
          out.text.append(gap->needs_comma ? ", " : "");
          NumberSites zero;
          zero.columns = {{.component = gap->component}};
          zero.offsets = {out.text.size()};
          zero.vertices = {gap->vertex};
          zero.most_characters = 20;
          out.sites.push_back(std::move(zero));
          out.text.append("0");
        }
        gap = behind;
      }
    };
    for (const InpInclude& include : source.includes) {
      if (!comes_in[include.source]) {
        continue;
      }
      fill_gaps_until(include.cut_begin);
      copy_until(include.cut_begin);
      done = include.cut_end;
      copy_until(include.place);
      if (include.on_next_line) {
        out.text.append("\n");
      }
      append(out, include.source, comes_in, document);
      // The line end of the last line stands behind the place.
      const std::size_t text_end = out.text.find_last_not_of("\r\n") + 1;
      out.text.resize(text_end);
    }
    fill_gaps_until(bytes.size() + 1);
    copy_until(bytes.size());
  }

  static void add_site(ExpandedInp& out, const NumberSites& from, std::size_t site, std::size_t shift) {
    const std::size_t count = from.columns.size();
    if (out.sites.empty() || out.sites.back().columns != from.columns) {
      NumberSites list;
      list.columns = from.columns;
      list.most_characters = from.most_characters;
      out.sites.push_back(std::move(list));
    }
    NumberSites& list = out.sites.back();
    for (std::size_t column = 0; column < count; ++column) {
      list.offsets.push_back(from.offsets[site * count + column] + shift);
    }
    list.vertices.push_back(from.vertices.empty() ? static_cast<std::int32_t>(site) : from.vertices[site]);
  }

  std::deque<InpSource> sources_;
  std::vector<double> points_;
};

}  // namespace

std::shared_ptr<const OriginalFile> make_inp_original(std::deque<InpSource> sources, std::vector<double> points) {
  return std::make_shared<InpOriginal>(std::move(sources), std::move(points));
}

}  // namespace trismooth
