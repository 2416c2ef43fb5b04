// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include <vtkInformation.h>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// Copies the <InformationKey> children of an array element (units, time and the like) to `information`. Ranges are
/// left out: VTK computes them anew. A key that cannot be kept gives a sentence in `losses`.
void read_information_keys(const XmlElement& array, vtkInformation& information, std::vector<std::string>& losses);

/// What `information` holds that VTK writes to files, ranges left out, in the order of names.
std::vector<ArrayInformation> information_as_text(vtkInformation& information);

/// Sets what the texts say. One that VTK does not know, or whose value is not of its kind, gives a sentence in
/// `losses`; `array_name` is for it.
void set_information(std::span<const ArrayInformation> texts, const std::string& array_name,
                     vtkInformation& information, std::vector<std::string>& losses);

}  // namespace trismooth
