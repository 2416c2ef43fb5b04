// SPDX-License-Identifier: BSD-3-Clause
// Small files whose groups overlap so much that their members, one by one, would fill the memory of any
// machine.
#include <string>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"
#include "support/says.h"

namespace {

constexpr int cells = 20'000;
constexpr int overlapping_groups = 400;

std::string many(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    all += text;
  }
  return all;
}

std::string numbered(int count, const std::string& before, const std::string& behind) {
  std::string all;
  for (int i = 1; i <= count; ++i) {
    all += before + std::to_string(i) + behind;
  }
  return all;
}

void check_many_refused(const std::string& name, const std::string& extension, const std::string& bytes) {
  const Outcome outcome = read({name, extension, bytes});
  INFO(name << ": " << outcome.message << " " << bytes.substr(0, 200));
  CHECK_FALSE(outcome.document);
  CHECK(says(outcome.message, "its sets and groups have more members than a mesh of its size can have"));
}

}  // namespace

TEST_CASE("a file whose groups have far more members than it has bytes is refused") {
  check_many_refused("mfem_many", ".mesh",
                     "MFEM mesh v1.3\ndimension\n2\nelements\n" + std::to_string(cells) + "\n" +
                         many(cells, "1 2 0 1 2\n") + "attribute_sets\n" + std::to_string(overlapping_groups) + "\n" +
                         numbered(overlapping_groups, "\"s", "\" 2 1 1\n") +
                         "boundary\n0\nvertices\n3\n2\n0 0\n1 0\n0 1\nmfem_mesh_end\n");
  check_many_refused("msh_many", ".msh",
                     "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 1 1 0 " +
                         std::to_string(overlapping_groups) + numbered(overlapping_groups, " ", "") +
                         " 0\n$EndEntities\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
                         "$Elements\n1 " +
                         std::to_string(cells) + " 1 " + std::to_string(cells) + "\n2 1 2 " + std::to_string(cells) +
                         "\n" + numbered(cells, "", " 1 2 3\n") + "$EndElements\n");
  check_many_refused("inp_many", ".inp",
                     "*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT, TYPE=CPS3, ELSET=all\n" + numbered(cells, "", ",1,2,3\n") +
                         numbered(overlapping_groups, "*ELSET, ELSET=s", "\nall, all\n"));
}
