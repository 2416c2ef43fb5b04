#include "support/accepted_freefem_files.h"

#include <string>
#include <string_view>

namespace accepted_files {

namespace {

std::string freefem_lines(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

}  // namespace

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

}  // namespace accepted_files
