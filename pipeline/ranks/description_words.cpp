// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/description_words.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace trismooth {

namespace {

using Word = std::vector<std::string>::const_iterator;

void append_list(std::vector<std::string>& words, const std::vector<std::string>& list) {
  words.push_back(std::to_string(list.size()));
  words.insert(words.end(), list.begin(), list.end());
}

template <class Number>
Number number_at(Word& word) {
  Number number{};
  std::from_chars(word->data(), word->data() + word->size(), number);
  ++word;
  return number;
}

std::vector<std::string> list_at(Word& word) {
  const auto count = number_at<std::ptrdiff_t>(word);
  std::vector<std::string> list(word, word + count);
  word += count;
  return list;
}

}  // namespace

std::vector<std::string> words_of(const ArrayDescription* description) {
  const ArrayDescription nothing;
  const ArrayDescription& told = description == nullptr ? nothing : *description;
  std::vector<std::string> words;
  append_list(words, told.component_names);
  words.push_back(std::to_string(told.information.size()));
  for (const ArrayInformation& information : told.information) {
    words.push_back(information.name);
    words.push_back(information.location);
    append_list(words, information.values);
  }
  words.push_back(std::to_string(told.value_names.size()));
  for (const ValueName& value : told.value_names) {
    words.push_back(std::to_string(value.value));
    words.push_back(std::to_string(value.dimension));
    words.push_back(value.name);
  }
  append_list(words, told.roles);
  return words;
}

std::shared_ptr<const ArrayDescription> description_of(Word& word) {
  ArrayDescription told;
  told.component_names = list_at(word);
  told.information.resize(number_at<std::size_t>(word));
  for (ArrayInformation& information : told.information) {
    information.name = *word++;
    information.location = *word++;
    information.values = list_at(word);
  }
  told.value_names.resize(number_at<std::size_t>(word));
  for (ValueName& value : told.value_names) {
    value.value = number_at<std::int64_t>(word);
    value.dimension = number_at<int>(word);
    value.name = *word++;
  }
  told.roles = list_at(word);
  return told.empty() ? nullptr : std::make_shared<const ArrayDescription>(std::move(told));
}

}  // namespace trismooth
