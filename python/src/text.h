// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Text of a file as a str. What is no UTF-8 goes through, as Python lets it through in names of files.
inline nanobind::str text_of_file(const std::string& text) {
  return nanobind::steal<nanobind::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape"));
}

/// A list of such texts.
inline nanobind::list texts(const std::vector<std::string>& lines) {
  nanobind::list list;
  for (const std::string& line : lines) {
    list.append(text_of_file(line));
  }
  return list;
}

/// The bytes of a text, as text_of_file() had them. Raises where the object is no str.
inline std::string bytes_of_text(nanobind::handle text) {
  const nanobind::object bytes = nanobind::steal(PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape"));
  if (!bytes.is_valid()) {
    throw nanobind::python_error();
  }
  const auto view = nanobind::borrow<nanobind::bytes>(bytes);
  return {view.c_str(), view.size()};
}

/// The shape of an array as NumPy writes it, "(3, 2)", and the name of its type, "float64", for messages: of arrays
/// with dimensions(), extent(d) and item_size().
template <class Array>
std::string shape_text_of(const Array& array) {
  std::string text = "(";
  for (std::size_t d = 0; d < array.dimensions(); ++d) {
    text += (d > 0 ? ", " : "") + std::to_string(array.extent(d));
  }
  return text + (array.dimensions() == 1 ? ",)" : ")");
}
template <class Array>
std::string type_text_of(const Array& array, char kind) {
  if (kind == '?') {
    return "bool";
  }
  return (kind == 'f' ? "float" : kind == 'i' ? "int" : "uint") + std::to_string(8 * array.item_size());
}

}  // namespace trismooth::python
