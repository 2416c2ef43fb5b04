// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

/// One sentence for each attribute of an element below `root` that VTK does not know, with its lines: "the attribute
/// 'units' of <DataArray> in lines 3 and 9 is not kept". The root's own attributes are left out, and elements that are
/// not kept themselves.
/// Complexity: n log n in the number of attributes.
std::vector<std::string> unknown_vtk_xml_attributes(const XmlElement& root);

/// The root's attributes as a new file gets them: values of those that VTK knows without white space around them, which
/// it does not take everywhere.
XmlAttributes vtk_file_attributes(const XmlElement& root);

/// The names of the root's attributes that VTK does not know, quoted and joined by commas; empty where there is none.
std::string unknown_vtk_file_attributes(const XmlElement& root);

}  // namespace trismooth
