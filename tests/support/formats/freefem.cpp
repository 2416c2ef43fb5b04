// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/cell_list.h"

#include "support/format_sample.h"
#include "support/text_words.h"

namespace accepted_files {

namespace {

std::string freefem_lines(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

void add_freefem(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"freefem_" + name, ".msh", std::move(bytes)});
  };
  const std::string vertices = "0 0 1\n2 0 1\n2 2 2\n0 2 3\n0.75 1.25 0\n";
  const std::string triangles = "1 2 5 7\n2 3 5 7\n3 4 5 8\n4 1 5 8\n";
  const std::string plain = "5 4 2\n" + vertices + triangles + "1 2 1\n2 3 4\n";
  add("edges", plain);
  add("no_edges", "5 4 0\n" + vertices + triangles);
  add("negative_label",
      " 5\t4 1 \n0e0 -0.0 0\n20e-1 +0 0\n2. .2E1 0\n\n0 2 0\n.75 1.25 -3\n" + triangles + "1 2 -4\n\n");
  add("no_labels", "5 4 1\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0.75 1.25 0\n1 2 5 0\n2 3 5 0\n3 4 5 0\n4 1 5 0\n1 2 0");
  add("crlf", freefem_lines(plain, "\r\n"));
  add("cr", freefem_lines(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
}

/// FreeFem's text ends with its last number, wherever that is cut.
bool is_whole_freefem(const AcceptedFile& file, std::size_t cut) {
  const std::size_t last = file.bytes.find_last_not_of(" \r\n");
  return cut > file.bytes.find_last_of(" \r\n", last) + (contains(file.name, "negative") ? 2 : 1);
}

}  // namespace

FormatSample freefem_sample() {
  return {.format = trismooth::FileFormat::freefem,
          .add_files = &add_freefem,
          .is_whole = &is_whole_freefem,
          .cells = {{cell_type::triangle}, {cell_type::line}}};
}

}  // namespace accepted_files
