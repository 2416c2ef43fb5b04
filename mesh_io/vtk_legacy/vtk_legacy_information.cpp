// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_information.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace trismooth {

namespace {

struct Key {
  std::string_view location;
  std::string_view name;
  InformationKind kind;
};

using enum InformationKind;

/// The keys of these kinds in the modules of VTK 9.1 that read and write mesh files, in the order of location and
/// name.
constexpr auto known_keys = std::to_array<Key>({
    {"vtkAbstractArray", "DISCRETE_VALUE_SAMPLE_PARAMETERS", numbers},
    {"vtkAbstractArray", "GUI_HIDE", number},
    {"vtkAlgorithm", "CAN_HANDLE_PIECE_REQUEST", number},
    {"vtkAlgorithm", "CAN_PRODUCE_SUB_EXTENT", number},
    {"vtkAlgorithm", "INPUT_CONNECTION", number},
    {"vtkAlgorithm", "INPUT_IS_OPTIONAL", number},
    {"vtkAlgorithm", "INPUT_IS_REPEATABLE", number},
    {"vtkAlgorithm", "INPUT_PORT", number},
    {"vtkAlgorithm", "INPUT_REQUIRED_DATA_TYPE", texts},
    {"vtkAlgorithm", "PORT_REQUIREMENTS_FILLED", number},
    {"vtkAnnotation", "COLOR", numbers},
    {"vtkAnnotation", "ENABLE", number},
    {"vtkAnnotation", "HIDE", number},
    {"vtkAnnotation", "ICON_INDEX", number},
    {"vtkAnnotation", "LABEL", text},
    {"vtkAnnotation", "OPACITY", number},
    {"vtkCompositeDataPipeline", "BLOCK_AMOUNT_OF_DETAIL", number},
    {"vtkCompositeDataPipeline", "DATA_COMPOSITE_INDICES", numbers},
    {"vtkCompositeDataPipeline", "LOAD_REQUESTED_BLOCKS", number},
    {"vtkCompositeDataPipeline", "SUPPRESS_RESET_PI", number},
    {"vtkCompositeDataPipeline", "UPDATE_COMPOSITE_INDICES", numbers},
    {"vtkCompositeDataSet", "CURRENT_PROCESS_CAN_LOAD_BLOCK", number},
    {"vtkCompositeDataSet", "NAME", text},
    {"vtkDataArray", "COMPONENT_RANGE", numbers},
    {"vtkDataArray", "L2_NORM_FINITE_RANGE", numbers},
    {"vtkDataArray", "L2_NORM_RANGE", numbers},
    {"vtkDataArray", "UNITS_LABEL", text},
    {"vtkDataObject", "ALL_PIECES_EXTENT", numbers},
    {"vtkDataObject", "BOUNDING_BOX", numbers},
    {"vtkDataObject", "DATA_EXTENT_TYPE", number},
    {"vtkDataObject", "DATA_NUMBER_OF_GHOST_LEVELS", number},
    {"vtkDataObject", "DATA_NUMBER_OF_PIECES", number},
    {"vtkDataObject", "DATA_PIECE_NUMBER", number},
    {"vtkDataObject", "DATA_TIME_STEP", number},
    {"vtkDataObject", "DATA_TYPE_NAME", text},
    {"vtkDataObject", "DIRECTION", numbers},
    {"vtkDataObject", "FIELD_ACTIVE_ATTRIBUTE", number},
    {"vtkDataObject", "FIELD_ARRAY_TYPE", number},
    {"vtkDataObject", "FIELD_ASSOCIATION", number},
    {"vtkDataObject", "FIELD_ATTRIBUTE_TYPE", number},
    {"vtkDataObject", "FIELD_NAME", text},
    {"vtkDataObject", "FIELD_NUMBER_OF_COMPONENTS", number},
    {"vtkDataObject", "FIELD_NUMBER_OF_TUPLES", number},
    {"vtkDataObject", "FIELD_OPERATION", number},
    {"vtkDataObject", "FIELD_RANGE", numbers},
    {"vtkDataObject", "ORIGIN", numbers},
    {"vtkDataObject", "PIECE_EXTENT", numbers},
    {"vtkDataObject", "SPACING", numbers},
    {"vtkDemandDrivenPipeline", "DATA_NOT_GENERATED", number},
    {"vtkDemandDrivenPipeline", "RELEASE_DATA", number},
    {"vtkDistributedGraphHelper", "DISTRIBUTEDEDGEIDS", number},
    {"vtkDistributedGraphHelper", "DISTRIBUTEDVERTEXIDS", number},
    {"vtkEnsembleSource", "DATA_MEMBER", number},
    {"vtkExecutive", "ALGORITHM_AFTER_FORWARD", number},
    {"vtkExecutive", "ALGORITHM_BEFORE_FORWARD", number},
    {"vtkExecutive", "ALGORITHM_DIRECTION", number},
    {"vtkExecutive", "FORWARD_DIRECTION", number},
    {"vtkExecutive", "FROM_OUTPUT_PORT", number},
    {"vtkExtentTranslator", "DATA_SPLIT_MODE", number},
    {"vtkHyperTreeGrid", "DIMENSION", number},
    {"vtkHyperTreeGrid", "LEVELS", number},
    {"vtkHyperTreeGrid", "ORIENTATION", number},
    {"vtkHyperTreeGrid", "SIZES", numbers},
    {"vtkMultiTimeStepAlgorithm", "UPDATE_TIME_STEPS", numbers},
    {"vtkOverlappingAMR", "NUMBER_OF_BLANKED_POINTS", number},
    {"vtkQuadratureSchemeDefinition", "QUADRATURE_OFFSET_ARRAY_NAME", text},
    {"vtkSelectionNode", "ASSEMBLY_NAME", text},
    {"vtkSelectionNode", "COMPONENT_NUMBER", number},
    {"vtkSelectionNode", "COMPOSITE_INDEX", number},
    {"vtkSelectionNode", "CONNECTED_LAYERS", number},
    {"vtkSelectionNode", "CONTAINING_CELLS", number},
    {"vtkSelectionNode", "CONTENT_TYPE", number},
    {"vtkSelectionNode", "EPSILON", number},
    {"vtkSelectionNode", "FIELD_TYPE", number},
    {"vtkSelectionNode", "HIERARCHICAL_INDEX", number},
    {"vtkSelectionNode", "HIERARCHICAL_LEVEL", number},
    {"vtkSelectionNode", "INDEXED_VERTICES", number},
    {"vtkSelectionNode", "INVERSE", number},
    {"vtkSelectionNode", "PIXEL_COUNT", number},
    {"vtkSelectionNode", "PROCESS_ID", number},
    {"vtkSelectionNode", "PROP_ID", number},
    {"vtkSelectionNode", "SELECTORS", texts},
    {"vtkSelectionNode", "SOURCE_ID", number},
    {"vtkSelectionNode", "ZBUFFER_VALUE", number},
    {"vtkStreamingDemandDrivenPipeline", "BOUNDS", numbers},
    {"vtkStreamingDemandDrivenPipeline", "COMBINED_UPDATE_EXTENT", numbers},
    {"vtkStreamingDemandDrivenPipeline", "CONTINUE_EXECUTING", number},
    {"vtkStreamingDemandDrivenPipeline", "EXACT_EXTENT", number},
    {"vtkStreamingDemandDrivenPipeline", "PREVIOUS_UPDATE_TIME_STEP", number},
    {"vtkStreamingDemandDrivenPipeline", "TIME_DEPENDENT_INFORMATION", number},
    {"vtkStreamingDemandDrivenPipeline", "TIME_RANGE", numbers},
    {"vtkStreamingDemandDrivenPipeline", "TIME_STEPS", numbers},
    {"vtkStreamingDemandDrivenPipeline", "UNRESTRICTED_UPDATE_EXTENT", number},
    {"vtkStreamingDemandDrivenPipeline", "UPDATE_EXTENT", numbers},
    {"vtkStreamingDemandDrivenPipeline", "UPDATE_EXTENT_INITIALIZED", number},
    {"vtkStreamingDemandDrivenPipeline", "UPDATE_NUMBER_OF_GHOST_LEVELS", number},
    {"vtkStreamingDemandDrivenPipeline", "UPDATE_NUMBER_OF_PIECES", number},
    {"vtkStreamingDemandDrivenPipeline", "UPDATE_PIECE_NUMBER", number},
    {"vtkStreamingDemandDrivenPipeline", "UPDATE_TIME_STEP", number},
    {"vtkStreamingDemandDrivenPipeline", "WHOLE_EXTENT", numbers},
});

constexpr bool comes_before(const Key& a, const Key& b) {
  return std::tie(a.location, a.name) < std::tie(b.location, b.name);
}
static_assert(std::ranges::is_sorted(known_keys, comes_before));

}  // namespace

std::optional<InformationKind> vtk_legacy_information_kind(std::string_view name, std::string_view location) {
  const Key wanted{location, name, {}};
  const auto* const found = std::ranges::lower_bound(known_keys, wanted, comes_before);
  return found == known_keys.end() || comes_before(wanted, *found) ? std::nullopt : std::optional(found->kind);
}

}  // namespace trismooth
