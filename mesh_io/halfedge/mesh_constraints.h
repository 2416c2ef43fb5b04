// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <OpenMesh/Core/Utils/Property.hh>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/array_view.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth {

/// What ElementNumbers is made of.
namespace element_numbers {

/// What counts as a whole number: bool, integers, enumerations.
template <class T>
concept Whole = std::integral<std::remove_cv_t<T>> || std::is_enum_v<std::remove_cv_t<T>>;

/// An array of them; no text.
template <class R>
concept Array = array_layout::ContiguousRange<R> && array_layout::Lasting<R> && Whole<std::ranges::range_value_t<R>> &&
    !std::same_as<std::ranges::range_value_t<R>, char>;

template <class S>
concept Name = std::convertible_to<S, std::string_view>;

/// OpenMesh's PropertyManager: VProp<T>, FProp<T>.
template <class P>
concept Manager = requires(const P& property) {
  property.getRawProperty();
};

/// What functions are given: a handle that knows its mesh, and is one that does not as well.
template <class Handle>
using Smart = typename OpenMesh::SmartHandle<Handle>::type;

template <class F, class Handle>
concept Function = !Name<F> && !Manager<F> && std::invocable<const F&, Smart<Handle>> &&
                   Whole<std::remove_cvref_t<std::invoke_result_t<const F&, Smart<Handle>>>>;

/// Handles of the other elements, and of properties whose values are no whole numbers, are no numbers of `Handle`.
template <class Handle, class T>
inline constexpr bool is_property_of = false;
template <class T>
inline constexpr bool is_property_of<OpenMesh::VertexHandle, OpenMesh::VPropHandleT<T>> = Whole<T>;
template <class T>
inline constexpr bool is_property_of<OpenMesh::FaceHandle, OpenMesh::FPropHandleT<T>> = Whole<T>;

/// A constructor of ElementNumbers takes it.
template <class T, class Handle>
concept Source =
    Array<T> || Name<T> || Manager<std::remove_cvref_t<T>> || Function<std::remove_cvref_t<T>, Handle> ||
    is_property_of<Handle, std::remove_cvref_t<T>> || std::same_as<std::remove_reference_t<T>, std::vector<bool>> ||
    std::same_as < std::remove_reference_t<T>,
const std::vector < bool >> ;

using Mesh = OpenMesh::PolyConnectivity;

/// The property of that number in the mesh; null: there is none. Compiled for handles of vertices and of faces.
template <class Handle>
const OpenMesh::BaseProperty* property_at(const Mesh& mesh, int index);

/// The numbers of the property of that name. Throws std::invalid_argument, in which `member` is what was asked for.
template <class Handle>
std::function<std::int64_t(Handle)> named(const Mesh& mesh, const std::string& name, std::string_view member);

/// Throws std::invalid_argument where an array of so many numbers is not one for each vertex, or face, of the mesh.
template <class Handle>
void require_one_each(const Mesh& mesh, std::size_t numbers, std::string_view member);

/// Throws std::invalid_argument: `member` names a property that the mesh does not have.
template <class Handle>
[[noreturn]] void refuse_handle(const Mesh& mesh, std::string_view member);

}  // namespace element_numbers

/// A whole number for every vertex or every face of an OpenMesh mesh, from wherever the caller has it; or nothing. What
/// it is made from stays the caller's, and is looked at while a function takes the constraints, not afterwards. Made by
/// itself from
///
/// - an array (std::vector, std::span, ...) of bool, any integer type but char, or an enumeration: a number for each
///   handle.idx(), of deleted elements as well. A temporary does not compile;
/// - a property by its handle, of bool, any integer type or an enumeration, or by OpenMesh's PropertyManager;
/// - the name of a property of bool or any integer type;
/// - a function that is given a handle, smart or not, and answers with a whole number, for what traits add:
///   `[&](auto f) { return mesh.data(f).material; }`. It is asked for elements that are not deleted.
template <class Handle>
class ElementNumbers {
 public:
  /// One number an element.
  using Reader = std::function<std::int64_t(Handle)>;

  /// Nothing.
  ElementNumbers() = default;

  /// From a contiguous array with a number for each handle.idx(); it stays the caller's.
  template <element_numbers::Array R>
  ElementNumbers(R&& array) : source_(source_of_array(std::span(std::ranges::data(array), std::ranges::size(array)))) {}

  /// From a flag for each handle.idx(); they stay the caller's.
  ElementNumbers(const std::vector<bool>& flags) : source_(source_of_array(std::ref(flags))) {}
  ElementNumbers(std::vector<bool>&&) = delete;

  /// From a property of vertices, which has to be one of the mesh that the constraints are for.
  template <element_numbers::Whole T>
  requires std::same_as<Handle, OpenMesh::VertexHandle> ElementNumbers(OpenMesh::VPropHandleT<T> property)
      : source_(source_of<T>(property)) {}

  /// From a property of faces, which has to be one of the mesh that the constraints are for.
  template <element_numbers::Whole T>
  requires std::same_as<Handle, OpenMesh::FaceHandle> ElementNumbers(OpenMesh::FPropHandleT<T> property)
      : source_(source_of<T>(property)) {}

  /// From OpenMesh's PropertyManager, for its property.
  template <element_numbers::Manager P>
  ElementNumbers(const P& property) : ElementNumbers(property.getRawProperty()) {}

  /// From the name of a property of the mesh that the constraints are for.
  template <element_numbers::Name S>
  ElementNumbers(const S& name)
      : source_(
            [name = std::string(std::string_view(name))](const element_numbers::Mesh& mesh, std::string_view member) {
              return element_numbers::named<Handle>(mesh, name, member);
            }) {}

  /// From a function of a handle; it is copied.
  template <element_numbers::Function<Handle> F>
  ElementNumbers(F function)
      : source_(
            [function = std::move(function)](const element_numbers::Mesh& mesh, std::string_view /*member*/) -> Reader {
              return [&function, &mesh](Handle h) {
                return static_cast<std::int64_t>(function(OpenMesh::make_smart(h, mesh)));
              };
            }) {}

  /// What cannot be taken: one sentence says so.
  template <class T>
  requires(!element_numbers::Source<T, Handle> && !std::same_as<std::remove_cvref_t<T>, ElementNumbers>)
      ElementNumbers(T&& /*other*/) {
    static_assert(
        sizeof(T) == 0,
        "trismooth: fixed, other_cells and regions of MeshConstraints are whole numbers of the vertices or the "
        "faces that they are for: an array that outlives the call, a property by handle or by name, or a "
        "function of a handle");
  }

  /// Whether there are none.
  [[nodiscard]] bool empty() const { return source_ == nullptr; }

  /// The numbers of `mesh`, while this object and what it was made from are there. Throws std::invalid_argument for an
  /// array of another length, for a property that the mesh has not or that is of another type; `member` says to the
  /// user whose numbers these are.
  [[nodiscard]] Reader of(const OpenMesh::PolyConnectivity& mesh, std::string_view member) const {
    return source_(mesh, member);
  }

 private:
  using Source = std::function<Reader(const OpenMesh::PolyConnectivity&, std::string_view)>;

  /// `array`: a span, or a reference to what is none. Empty: nothing.
  template <class A>
  static Source source_of_array(A array) {
    const auto& numbers = static_cast<const std::unwrap_reference_t<A>&>(array);
    if (numbers.empty()) {
      return {};
    }
    return [array](const element_numbers::Mesh& mesh, std::string_view member) -> Reader {
      const auto& of_elements = static_cast<const std::unwrap_reference_t<A>&>(array);
      element_numbers::require_one_each<Handle>(mesh, of_elements.size(), member);
      return [array](Handle h) {
        const auto& values = static_cast<const std::unwrap_reference_t<A>&>(array);
        return static_cast<std::int64_t>(values[static_cast<std::size_t>(h.idx())]);
      };
    };
  }

  template <class T>
  static Source source_of(OpenMesh::BaseHandle property) {
    return [index = property.idx()](const element_numbers::Mesh& mesh, std::string_view member) -> Reader {
      const auto* values =
          dynamic_cast<const OpenMesh::PropertyT<T>*>(element_numbers::property_at<Handle>(mesh, index));
      if (values == nullptr) {
        element_numbers::refuse_handle<Handle>(mesh, member);
      }
      return [values](Handle h) { return static_cast<std::int64_t>((*values)[h.idx()]); };
    };
  }

  Source source_;
};

/// Of every vertex.
using VertexNumbers = ElementNumbers<OpenMesh::VertexHandle>;
/// Of every face.
using FaceNumbers = ElementNumbers<OpenMesh::FaceHandle>;

/// What the caller of an OpenMesh mesh holds fixed beside what the mesh itself does: its boundaries, and what its
/// status says (see MeshPlan). All members may be empty. The caller owns what they are made from and keeps it for as
/// long as these constraints are used; a function that takes them does not look at them any more when it has returned.
struct MeshConstraints {
  VertexNumbers fixed{};                ///< one a vertex; not zero: fixed
  ArrayView<std::int32_t> fixed_ids{};  ///< vertices by idx(), in any order, also more than once
  VertexNumbers other_cells{};          ///< one a vertex; not zero: used by a cell that is no face of this mesh, fixed,
                                        ///< as the corners of faces with five sides or more are
  FaceNumbers regions{};                ///< one a face; ends of edges between two regions are fixed; those of faces
                                        ///< with five sides or more say nothing
  Sliding slide{};                      ///< which of those that boundaries and interfaces hold move along them
};

}  // namespace trismooth
