// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/document_layout.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "trismooth/pipeline/ranks/description_words.h"

namespace trismooth {

namespace {

using LayoutWords = std::vector<std::string>;

void append_description(LayoutWords& words, const ArrayDescription* description) {
  const LayoutWords told = words_of(description);
  words.insert(words.end(), told.begin(), told.end());
}

void append_arrays(LayoutWords& words, const std::vector<DataArray>& arrays) {
  words.push_back(std::to_string(arrays.size()));
  for (const DataArray& array : arrays) {
    words.push_back(array.name);
    words.push_back(std::to_string(static_cast<unsigned>(array.type)));
    words.push_back(std::to_string(array.components));
    append_description(words, array.description.get());
  }
}

std::vector<DataArray> arrays_at(LayoutWords::const_iterator& word) {
  std::vector<DataArray> arrays(std::stoul(*word++));
  for (DataArray& array : arrays) {
    array.name = *word++;
    array.type = static_cast<ScalarType>(std::stoul(*word++));
    array.components = std::stoul(*word++);
    array.description = description_of(word);
  }
  return arrays;
}

/// Each with a zero behind it; names in files have none.
std::vector<char> bytes_of_words(const LayoutWords& words) {
  std::vector<char> bytes;
  for (const std::string& word : words) {
    bytes.insert(bytes.end(), word.begin(), word.end());
    bytes.push_back('\0');
  }
  return bytes;
}

LayoutWords words_in(const std::vector<char>& bytes) {
  LayoutWords words;
  for (auto at = bytes.begin(); at != bytes.end();) {
    const auto end = std::find(at, bytes.end(), '\0');
    words.emplace_back(at, end);
    at = end + 1;
  }
  return words;
}

}  // namespace

std::vector<char> packed_point_layout(const MeshDocument& document) {
  LayoutWords words{std::to_string(static_cast<unsigned>(document.point_type)), document.has_float32_axis ? "1" : "0"};
  append_description(words, document.points_description.get());
  append_arrays(words, document.point_arrays);
  return bytes_of_words(words);
}

std::vector<char> packed_cell_layout(const MeshDocument& document) {
  LayoutWords words;
  append_arrays(words, document.cell_arrays);
  return bytes_of_words(words);
}

void take_point_layout(const std::vector<char>& layout, MeshDocument& document) {
  const LayoutWords words = words_in(layout);
  auto word = words.begin();
  document.point_type = static_cast<ScalarType>(std::stoul(*word++));
  document.has_float32_axis = *word++ == "1";
  document.points_description = description_of(word);
  document.point_arrays = arrays_at(word);
}

void take_cell_layout(const std::vector<char>& layout, MeshDocument& document) {
  const LayoutWords words = words_in(layout);
  auto word = words.begin();
  document.cell_arrays = arrays_at(word);
}

}  // namespace trismooth
