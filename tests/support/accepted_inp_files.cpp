#include "support/accepted_inp_files.h"

#include <string>
#include <string_view>

namespace accepted_files {

namespace {

constexpr std::string_view inp_nodes =
    "1, 0.0, 0.0, 0.0\n2, 2.0, 0.0, 0.0\n3, 2.0, 2.0, 0.0\n4, 0.0, 2.0, 0.0\n5, 0.75, 1.25, 0.0\n";
constexpr std::string_view inp_elements = "1, 1, 2, 5\n2, 2, 3, 5\n3, 3, 4, 5\n4, 4, 1, 5\n";

std::string deck(std::string_view nodes, std::string_view elements) {
  return "*HEADING\na square\n*NODE, NSET=NALL\n" + std::string(nodes) + "*ELEMENT, TYPE=CPS3, ELSET=EALL\n" +
         std::string(elements);
}

std::string with_inp_line_end(std::string text, std::string_view line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

}  // namespace

void add_inp(std::vector<AcceptedFile>& files) {
  const auto add = [&files](const std::string& name, std::string bytes) {
    files.push_back({"inp_" + name, ".inp", std::move(bytes)});
  };
  const std::string plain = deck(inp_nodes, inp_elements);
  add("plain", plain);
  add("flat", deck("1, 0., 0.\n2, 2., 0.\n3, 2., 2.\n4, 0., 2.\n5, .75, 1.25\n", inp_elements));
  add("left_out", deck("1\n2, 2.\n3, 2., 2.\n4, , 2.\n5, 7.5D-1, 1.25, ,\n", inp_elements));
  // As Gmsh writes it.
  add("gmsh",
      "*Heading\n mesh.inp\n*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 2, 0\n4, 0, 2, 0\n5, 0.75, 1.25, 0\n"
      "******* E L E M E N T S *************\n*ELEMENT, type=T3D2, ELSET=Line1\n5, 1, 2\n"
      "*ELEMENT, type=CPS3, ELSET=Surface1\n1, 1, 2, 5\n2, 2, 3, 5\n*ELEMENT, type=CPS3, ELSET=Surface2\n3, 3, 4, 5\n"
      "4, 4, 1, 5\n*ELSET,ELSET=steel\n1, 2, \n*NSET,NSET=steel\n1, 2, 3, 5, \n");
  // As CalculiX takes it.
  add("sections", plain +
                      "*ELSET, ELSET=LEFT, GENERATE\n3, 4\n*ELSET, ELSET=RIGHT\n1, 2\n*ELSET, ELSET=BOTH\nLEFT, RIGHT\n"
                      "*SOLID SECTION, ELSET=LEFT, MATERIAL=M1\n1.\n*SOLID SECTION, ELSET=RIGHT, MATERIAL=M2\n1.\n"
                      "*BOUNDARY\n1, 1, 2\nNALL, 3\n*STEP\n*STATIC\n*CLOAD\n3, 1, 5.\n*END STEP\n");
  // As Abaqus/CAE writes it.
  add("parts", "*Heading\n** Job name: a Model name: b\n*Part, name=Plate\n*Node\n" + std::string(inp_nodes) +
                   "*Element, type=CPE3\n" + std::string(inp_elements) +
                   "*Nset, nset=Set-1, generate\n 1,  5,  1\n*Elset, elset=Set-1\n 1, 2\n"
                   "*Solid Section, elset=Set-1, material=Steel\n,\n*End Part\n*Assembly, name=Assembly\n"
                   "*Instance, name=Plate-1, part=Plate\n1., 0., 0.\n*End Instance\n*Nset, nset=_PickedSet4, internal, "
                   "instance=Plate-1\n 1, 4\n*End Assembly\n");
  add("broken_lines",
      "** first\n*Node ,\n nset = \"all of them\"\n\t1 , 0.0,+0.0\n** between\n\n2,2e0 , 0.\n3, 20e-1,.2E1\n"
      "4,0.0,2.0\n5,7.5-1, 12.5e-1\n*element,type = s3\n1,\n1,2,\n 5\n2,2,3,5,\n3,3,4,5\n4,4,1,5");
  add("user_elements", "*USER ELEMENT, NODES=2, TYPE=U1\n1, 2\n" + plain + "*ELEMENT, TYPE=U1\n9, 1, 2\n");
  add("crlf", with_inp_line_end(plain, "\r\n"));
  add("cr", with_inp_line_end(plain, "\r"));
  add("mark", "\xEF\xBB\xBF" + plain);
}

}  // namespace accepted_files
