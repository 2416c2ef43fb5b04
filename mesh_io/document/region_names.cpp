// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/region_names.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "trismooth/base/text/plain_name.h"

namespace trismooth {

namespace {

// All names are written as by plain_name(). None of them is often an id of each cell, a part of a parallel run or a
// result.

/// Words for regions, of all programs. With one of the beginnings and one of the endings they are names of regions.
constexpr std::array region_words = std::to_array<std::string_view>(
    {"region",    "domain",    "subdomain", "zone",     "material",    "mat",         "medium",   "block",
     "attribute", "marker",    "tag",       "label",    "ref",         "physical",    "property", "prop",
     "section",   "component", "entity",    "family",   "geometrical", "geometry",    "elset",    "elementary",
     "reference", "lithology", "facies",    "rocktype", "soiltype",    "realconstant"});

constexpr std::array beginnings =
    std::to_array<std::string_view>({"", "cell", "element", "elem", "face", "triangle", "mesh"});

constexpr std::array endings = std::to_array<std::string_view>(
    {"",        "s",     "id",        "ids",    "no",       "num",   "number", "numbers", "index",
     "indices", "tag",   "tags",      "marker", "markers",  "label", "labels", "ref",     "type",
     "name",    "names", "attribute", "entity", "entities", "group", "groups"});

/// Names as they are.
constexpr std::array whole_names = std::to_array<std::string_view>({
    "media",
    "properties",
    "families",
    "subdomaindata",
    "imat",
    "partid",
    "partids",
    "groupid",
    "stratigraphy",
    "elementset",
    "elementsets",
    "elementgroup",
    "cellset",
    "cellsets",
    "cellgroup",
    // Gmsh, and what is made from its files
    "gmshphysical",
    "gmshgeometrical",
    "gmshphysicalids",
    "gmshgeometricalids",
    "physicalregion",
    "physicalregions",
    "physicalsurface",
    "physicalsurfaces",
    "elementaryentities",
    "elementaryids",
    // meshio: format:name
    "meditref",
    "freefemlabel",
    "2dmmaterial",
    "mfemattribute",
    "triangleattribute",
    "nastranref",
    "nastranpid",
    "unvgroup",
    "unvpid",
    "cgnsgroup",
    "tetgenref",
    "netgenindex",
    "su2tag",
    "su2marker",
    "su2zone",
    "avsucdmaterial",
    "flac3dgroup",
    "flac3dzone",
    "ansysmaterialid",
    "abaqusmaterial",
    "abaquselset",
    "nametoread",
    // FEniCS and dolfinx: MeshFunction, MeshTags
    "f",
    "meshfunction",
    "cellfunction",
    "meshtagsvalues",
    "celltagsvalues",
    "cellmarkersvalues",
    // MOOSE, libMesh, Exodus, Cubit, and ParaView's readers of these
    "objectid",
    "objectids",
    "exodusblock",
    "exodusblockid",
    // COMSOL
    "geometricentity",
    "geometricentityid",
    "geometricentityids",
    "geometricentityindex",
    "geometricentityindices",
    // Ansys
    "ansysmaterialtype",
    "ansysrealconstant",
    "ansyscomponent",
    "materialset",
    // Salome (MED)
    "familyidcell",
    "familyidelement",
    "medgroup",
    "medfamily",
    // VMTK, SimVascular, PyGIMLi, Netgen
    "modelregionid",
    "modelfaceid",
    "pygimlimarker",
    "netgenmaterial",
    // VTK and ParaView
    "vtkcompositeindex",
    "compositeindex",
    "vtkblockcolors",
    "vtkblockid",
    "vtkmaterialid",
    "stlsolidlabeling",
});

/// Of arrays of points: those of this program's readers, of meshio, and those that people choose.
constexpr std::array marker_names = std::to_array<std::string_view>(
    {"trianglemarker", "meditref", "freefemlabel", "tetgenref", "marker", "markers", "vertexmarker", "vertexmarkers",
     "pointmarker", "pointmarkers", "nodemarker", "nodemarkers", "boundarymarker", "boundarymarkers"});

/// Names that contain one of these are bookkeeping ...
constexpr std::array bookkeeping_parts = std::to_array<std::string_view>(
    {"ghost", "halo", "partition", "rank", "proc", "mpi", "decomposition", "metis", "original", "parent"});

/// ... and those that are one of these. The last ones tell lists of elements apart that differ in their type.
constexpr std::array bookkeeping_names =
    std::to_array<std::string_view>({"pid", "owner", "thread", "threadid", "cgnssection", "exodustypedblock"});

/// scikit-fem: an array for each named subdomain, and one for each named boundary. The name follows.
constexpr std::string_view skfem_subdomain = "skfem:s:";
constexpr std::string_view skfem_boundary = "skfem:b:";

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// Whether the name is a beginning, a word and an ending.
bool is_made_of_words(std::string_view name) {
  return std::ranges::any_of(beginnings, [&](std::string_view beginning) {
    return name.starts_with(beginning) && std::ranges::any_of(endings, [&](std::string_view ending) {
             const std::string_view rest = name.substr(beginning.size());
             return rest.ends_with(ending) && contains(region_words, rest.substr(0, rest.size() - ending.size()));
           });
  });
}

}  // namespace

bool is_region_name(std::string_view name) {
  const std::string plain = plain_name(name);
  return contains(whole_names, plain) || is_made_of_words(plain) || name.starts_with(skfem_subdomain);
}

bool is_side_name(std::string_view name) {
  return name.starts_with(skfem_boundary);
}

bool is_marker_name(std::string_view name) {
  return contains(marker_names, plain_name(name));
}

bool is_bookkeeping_name(std::string_view name) {
  const std::string plain = plain_name(name);
  return contains(bookkeeping_names, plain) ||
         std::ranges::any_of(bookkeeping_parts, [&](std::string_view part) { return plain.find(part) != plain.npos; });
}

}  // namespace trismooth
