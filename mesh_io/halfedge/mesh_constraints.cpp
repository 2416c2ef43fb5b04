// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/mesh_constraints.h"

#include <concepts>
#include <stdexcept>

namespace trismooth::element_numbers {

namespace {

using OpenMesh::BaseProperty;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

template <class Handle>
constexpr bool of_vertices = std::same_as<Handle, VertexHandle>;
template <class Handle>
constexpr const char* element = of_vertices<Handle> ? "vertex" : "face";

template <class Handle>
std::span<BaseProperty* const> properties_of(const Mesh& mesh) {
  if constexpr (of_vertices<Handle>) {
    return {mesh.vprops_begin(), mesh.vprops_end()};
  } else {
    return {mesh.fprops_begin(), mesh.fprops_end()};
  }
}

/// The numbers of a property, if it is of type T.
template <class T, class Handle>
bool read_as(const BaseProperty* property, std::function<std::int64_t(Handle)>& reader) {
  const auto* values = dynamic_cast<const OpenMesh::PropertyT<T>*>(property);
  if (values != nullptr) {
    reader = [values](Handle h) { return static_cast<std::int64_t>((*values)[h.idx()]); };
  }
  return values != nullptr;
}

template <class Handle, class... Types>
std::function<std::int64_t(Handle)> read_as_one_of(const BaseProperty* property) {
  std::function<std::int64_t(Handle)> reader;
  (read_as<Types>(property, reader) || ...);
  return reader;
}

template <class Handle>
std::function<std::int64_t(Handle)> read_numbers(const BaseProperty* property) {
  return read_as_one_of<Handle, bool, char, signed char, unsigned char, short, unsigned short, int, unsigned int, long,
                        unsigned long, long long, unsigned long long>(property);
}

/// The end of a message: which properties there are. Those that have no name are called "<something>".
template <class Handle>
std::string properties_told(const Mesh& mesh) {
  std::string names;
  for (const BaseProperty* property : properties_of<Handle>(mesh)) {
    if (property != nullptr && !property->name().starts_with('<')) {
      names += (names.empty() ? "\"" : ", \"") + property->name() + '"';
    }
  }
  return std::string("; its ") + element<Handle> + " properties: " + (names.empty() ? "none with a name" : names);
}

}  // namespace

template <class Handle>
const BaseProperty* property_at(const Mesh& mesh, int index) {
  const auto properties = properties_of<Handle>(mesh);
  return index >= 0 && index < std::ssize(properties) ? properties[static_cast<std::size_t>(index)] : nullptr;
}

template <class Handle>
std::function<std::int64_t(Handle)> named(const Mesh& mesh, const std::string& name, std::string_view member) {
  bool is_there = false;
  for (const BaseProperty* property : properties_of<Handle>(mesh)) {
    if (property != nullptr && property->name() == name) {
      is_there = true;
      if (auto numbers = read_numbers<Handle>(property)) {
        return numbers;
      }
    }
  }
  const std::string property = std::string(element<Handle>) + " property \"" + name + '"';
  throw std::invalid_argument(
      std::string(member) + ": " +
      (is_there ? "the values of the " + property + " are neither bool nor integers" : "the mesh has no " + property) +
      properties_told<Handle>(mesh));
}

template <class Handle>
void require_one_each(const Mesh& mesh, std::size_t numbers, std::string_view member) {
  const std::size_t expected = of_vertices<Handle> ? mesh.n_vertices() : mesh.n_faces();
  if (numbers != expected) {
    throw std::invalid_argument(std::string(member) + " has " + std::to_string(numbers) +
                                " entries, expected one for each of " + std::to_string(expected) +
                                (of_vertices<Handle> ? " vertices" : " faces") + ", deleted ones as well, or none");
  }
}

template <class Handle>
void refuse_handle(const Mesh& mesh, std::string_view member) {
  throw std::invalid_argument(std::string(member) + ": the handle is that of no " + element<Handle> +
                              " property of this mesh, or of one of another type" + properties_told<Handle>(mesh));
}

template const BaseProperty* property_at<VertexHandle>(const Mesh&, int);
template const BaseProperty* property_at<FaceHandle>(const Mesh&, int);
template std::function<std::int64_t(VertexHandle)> named<VertexHandle>(const Mesh&, const std::string&,
                                                                       std::string_view);
template std::function<std::int64_t(FaceHandle)> named<FaceHandle>(const Mesh&, const std::string&, std::string_view);
template void refuse_handle<VertexHandle>(const Mesh&, std::string_view);
template void refuse_handle<FaceHandle>(const Mesh&, std::string_view);
template void require_one_each<VertexHandle>(const Mesh&, std::size_t, std::string_view);
template void require_one_each<FaceHandle>(const Mesh&, std::size_t, std::string_view);

}  // namespace trismooth::element_numbers
