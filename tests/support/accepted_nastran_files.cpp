#include "support/accepted_nastran_files.h"

#include <string>
#include <string_view>

namespace accepted_files {

namespace {

constexpr std::string_view small_nodes =
    "GRID    1               0.      0.      0.\n"
    "GRID    2               2.      0.      0.\n"
    "GRID    3               2.      2.      0.\n"
    "GRID    4               0.      2.      0.\n"
    "GRID    5               .75     1.25    0.\n";

constexpr std::string_view large_nodes =
    "GRID*   1               0               0.              0.              *N1\n*N1     0.\n"
    "GRID*   2               0               2.              0.              *N2\n*N2     0.\n"
    "GRID*   3               0               2.              2.              *N3\n*N3     0.\n"
    "GRID*   4               0               0.              2.              *N4\n*N4     0.\n"
    "GRID*   5               0                            .75            1.25*N5\n*N5     0.\n";

constexpr std::string_view free_nodes =
    "GRID,1,0,0.00E+00,0.00E+00,0.00E+00\nGRID,2,0,2.000000,0.00E+00,0.00E+00\nGRID,3,0,2.000000,2.000000,0.00E+00\n"
    "GRID,4,0,0.00E+00,2.000000,0.00E+00\nGRID,5,0,7.5E-01,1.250000,0.00E+00\n";

constexpr std::string_view small_elements =
    "CTRIA3  1       1       1       2       5\n"
    "CTRIA3  2       1       2       3       5\n"
    "CTRIA3  3       2       3       4       5\n"
    "CTRIA3  4       2       4       1       5\n";

constexpr std::string_view free_elements = "CTRIA3,1,1,1,2,5\nCTRIA3,2,1,2,3,5\nCTRIA3,3,2,3,4,5\nCTRIA3,4,2,4,1,5\n";

std::string joined(std::string_view first, std::string_view second) {
  return std::string(first) + std::string(second);
}

std::string with_nastran_line_end(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

}  // namespace

void add_nastran(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"nastran_" + name, ".bdf", std::move(bytes)});
  };
  const std::string plain = "BEGIN BULK\n" + joined(small_nodes, small_elements) + "ENDDATA\n";
  add("plain", plain);
  add("bare", joined(small_nodes, small_elements));
  // As Gmsh writes it.
  add("free",
      "$ Created by Gmsh\n" + joined(free_nodes, "CBAR,9,3,1,2,0.,0.,0.\n") + std::string(free_elements) + "ENDDATA\n");
  add("large", "$ Created by Gmsh\n" + joined(large_nodes, small_elements) + "ENDDATA\n");
  // As people run it.
  add("deck",
      "$ a deck\nSOL 101\nTIME 5\nCEND\nTITLE = a plate\nSUBCASE 1\n  SPC = 1\n  LOAD = 2\nBEGIN BULK\n"
      "PARAM,POST,-1\n$HMNAME PROP                   1\"left\" 4\n$HMNAME PROP                   2\"right\" 4\n" +
          joined(small_nodes, small_elements) +
          "PSHELL  1       1       .1      1               1\nPSHELL  2       1       .1      1               1\n"
          "MAT1    1       2.1+11          .3\nSPC1    1       123     1       THRU    2\n"
          "FORCE   2       3       0       1.      1.\nCONM2   7       4               1.\nENDDATA\n");
  add("mixed",
      "CTRIA3* 1               1               1               2\n*       5\nctria3,2,1,2,3,5\n"
      "CTRIAR\t3\t2\t3\t4\t5\nCTRIA3  4       2       4       1       5       $ the last\n\n"
      "GRID*   1\nGRID,2,,2.\n$ between\ngrid    3               2.0     +.2+1\nGRID*,4,,,2.,*A\n*A,0.\n"
      "GRID\t5\t\t7.5-1\t1.25D0\n");
  add("systems",
      "CORD2R  3               0.      0.      0.      0.      0.      1.\n+       1.      0.      0.\n"
      "GRDSET          3                               6\n" +
          joined(small_nodes, small_elements));
  add("crlf", with_nastran_line_end(plain, "\r\n"));
  add("cr", with_nastran_line_end(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
  add("rest", plain + "made for a test\n");
}

}  // namespace accepted_files
