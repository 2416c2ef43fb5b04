#pragma once

#include <string>
#include <vector>

#include <vtkInformation.h>

#include "trismooth/mesh_io/xml_tree.h"

namespace trismooth {

/// Copies the <InformationKey> children of an array element (units, time and the like) to `information`. Ranges are
/// left out: VTK computes them anew. A key that cannot be kept gives a sentence in `losses`.
void read_information_keys(const XmlElement& array, vtkInformation& information, std::vector<std::string>& losses);

}  // namespace trismooth
