// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_information.h"

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <vtkInformationKey.h>
#include <vtkInformationKeyLookup.h>
#include <vtkNew.h>
#include <vtkVersion.h>

#include "catch.h"

using trismooth::InformationKind;
using trismooth::vtk_legacy_information_kind;

namespace {

/// The kind of each class of keys that VTK's legacy writer writes (vtkDataWriter::WriteInformation).
std::optional<InformationKind> kind_of(const std::string& key_class) {
  const std::map<std::string, InformationKind> kinds{
      {"vtkInformationDoubleKey", InformationKind::number},
      {"vtkInformationDoubleVectorKey", InformationKind::numbers},
      {"vtkInformationIdTypeKey", InformationKind::number},
      {"vtkInformationIntegerKey", InformationKind::number},
      {"vtkInformationIntegerVectorKey", InformationKind::numbers},
      {"vtkInformationStringKey", InformationKind::text},
      {"vtkInformationStringVectorKey", InformationKind::texts},
      {"vtkInformationUnsignedLongKey", InformationKind::number},
  };
  const auto found = kinds.find(key_class);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

/// Location and name of every key that VTK knows in this program. Its look-up says them nowhere but where it is
/// printed: "vtkDataArray::UNITS_LABEL @0x7f (vtkInformationStringKey)".
std::vector<std::pair<std::string, std::string>> registered_keys() {
  std::ostringstream printed;
  vtkNew<vtkInformationKeyLookup>()->PrintSelf(printed, vtkIndent());
  std::istringstream lines(printed.str());
  std::vector<std::pair<std::string, std::string>> keys;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colons = line.find("::");
    if (colons != std::string::npos) {
      const std::size_t begin = line.find_first_not_of(" \t");
      keys.emplace_back(line.substr(begin, colons - begin),
                        line.substr(colons + 2, line.find_first_of(" @(\t", colons) - colons - 2));
    }
  }
  return keys;
}

}  // namespace

TEST_CASE("the kind of every information key is the one that VTK registers it with") {
  const auto keys = registered_keys();
  REQUIRE(keys.size() > 50);
  int with_kind = 0;
  for (const auto& [location, name] : keys) {
    CAPTURE(location, name);
    vtkInformationKey* const key = vtkInformationKeyLookup::Find(name, location);
    REQUIRE(key != nullptr);
    const auto kind = vtk_legacy_information_kind(name, location);
    if (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION == 1) {
      CHECK(kind == kind_of(key->GetClassName()));
    } else if (kind) {
      CHECK(kind == kind_of(key->GetClassName()));
    }
    with_kind += kind ? 1 : 0;
  }
  CHECK(with_kind > 50);
}

TEST_CASE("the information keys of arrays are known, and names that VTK does not have are not") {
  CHECK(vtk_legacy_information_kind("UNITS_LABEL", "vtkDataArray") == InformationKind::text);
  CHECK(vtk_legacy_information_kind("COMPONENT_RANGE", "vtkDataArray") == InformationKind::numbers);
  CHECK(vtk_legacy_information_kind("L2_NORM_RANGE", "vtkDataArray") == InformationKind::numbers);
  CHECK(vtk_legacy_information_kind("GUI_HIDE", "vtkAbstractArray") == InformationKind::number);
  CHECK(vtk_legacy_information_kind("SELECTORS", "vtkSelectionNode") == InformationKind::texts);
  CHECK(vtk_legacy_information_kind("DATA_TIME_STEP", "vtkDataObject") == InformationKind::number);
  CHECK_FALSE(vtk_legacy_information_kind("PER_COMPONENT", "vtkAbstractArray"));  // holds no text or number
  CHECK_FALSE(vtk_legacy_information_kind("UNITS_LABEL", "vtkAbstractArray"));
  CHECK_FALSE(vtk_legacy_information_kind("UNITS_LABE", "vtkDataArray"));
  CHECK_FALSE(vtk_legacy_information_kind("UNITS_LABEL2", "vtkDataArray"));
  CHECK_FALSE(vtk_legacy_information_kind("", ""));
  CHECK_FALSE(vtk_legacy_information_kind("Z", "z"));
}
