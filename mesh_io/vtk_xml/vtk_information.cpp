// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_information.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIdTypeKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationIterator.h>
#include <vtkInformationKeyLookup.h>
#include <vtkInformationStringKey.h>
#include <vtkInformationStringVectorKey.h>
#include <vtkInformationUnsignedLongKey.h>
#include <vtkNew.h>

#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/vtk_xml/vtk_messages.h"
#include "trismooth/mesh_io/xml/xml_names.h"

namespace trismooth {

namespace {

/// The text of an element without the white space of XML at its ends.
std::string value_of(const XmlElement& element) {
  return std::string(trimmed(element.text, " \t\r\n"));
}

template <class Value>
std::optional<Value> parse(const std::string& text) {
  if constexpr (std::is_same_v<Value, std::string>) {
    return as_xml_text(text);
  } else if constexpr (std::is_same_v<Value, double>) {
    return parse_number<double>(text);
  } else {
    Value value{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return stop == text.data() + text.size() && error == std::errc() ? std::optional(value) : std::nullopt;
  }
}

/// The text of the element, or of its children <Value index="0">, <Value index="1">, ...
std::optional<std::vector<std::string>> values_of(const XmlElement& element) {
  if (element.children.empty()) {
    return std::vector{value_of(element)};
  }
  std::vector<std::string> values;
  for (const XmlElement& child : element.children) {
    const std::string* const index = child.attribute("index");
    if (child.name != "Value" || index == nullptr || *index != std::to_string(values.size())) {
      return std::nullopt;
    }
    values.push_back(value_of(child));
  }
  return values;
}

template <class Value>
std::optional<std::vector<Value>> parse_all(std::span<const std::string> texts) {
  std::vector<Value> values;
  if (texts.size() == 1 && texts[0].empty() && !std::is_same_v<Value, std::string>) {
    return values;  // a list of nothing
  }
  for (const std::string& text : texts) {
    const std::optional<Value> value = parse<Value>(text);
    if (!value) {
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return values;
}

template <class Value, class Key>
bool set_scalar(vtkInformation& information, Key* key, std::span<const std::string> texts) {
  const std::optional<Value> value = texts.size() == 1 ? parse<Value>(texts[0]) : std::nullopt;
  if (value) {
    information.Set(key, *value);
  }
  return value.has_value();
}

template <class Value, class Key>
bool set_vector(vtkInformation& information, Key* key, std::span<const std::string> texts) {
  std::optional<std::vector<Value>> values = parse_all<Value>(texts);
  if (values) {
    information.Set(key, values->data(), static_cast<int>(values->size()));
  }
  return values.has_value();
}

/// Calls `use` with the key as what it is, if it is one that VTK writes to files; else returns `otherwise`.
template <class Result, class Use>
Result with_key(vtkInformationKey* key, Result otherwise, const Use& use) {
  if (auto* const real = vtkInformationDoubleKey::SafeDownCast(key)) {
    return use(real, double{});
  }
  if (auto* const reals = vtkInformationDoubleVectorKey::SafeDownCast(key)) {
    return use(reals, double{});
  }
  if (auto* const integer = vtkInformationIntegerKey::SafeDownCast(key)) {
    return use(integer, int{});
  }
  if (auto* const integers = vtkInformationIntegerVectorKey::SafeDownCast(key)) {
    return use(integers, int{});
  }
  if (auto* const id = vtkInformationIdTypeKey::SafeDownCast(key)) {
    return use(id, vtkIdType{});
  }
  if (auto* const count = vtkInformationUnsignedLongKey::SafeDownCast(key)) {
    return use(count, 0UL);
  }
  if (auto* const text = vtkInformationStringKey::SafeDownCast(key)) {
    return use(text, std::string());
  }
  if (auto* const texts = vtkInformationStringVectorKey::SafeDownCast(key)) {
    return use(texts, std::string());
  }
  return otherwise;
}

template <class Key>
constexpr bool is_list =
    std::is_same_v<Key, vtkInformationDoubleVectorKey> || std::is_same_v<Key, vtkInformationIntegerVectorKey> ||
    std::is_same_v<Key, vtkInformationStringVectorKey>;

bool set_key(vtkInformation& information, vtkInformationKey* key, std::span<const std::string> texts) {
  return with_key(key, false, [&]<class Key, class Value>(Key* typed, const Value&) {
    if constexpr (std::is_same_v<Key, vtkInformationStringVectorKey>) {
      for (const std::string& text : texts) {
        information.Append(typed, as_xml_text(text));
      }
      return true;
    } else if constexpr (is_list<Key>) {
      return set_vector<Value>(information, typed, texts);
    } else {
      return set_scalar<Value>(information, typed, texts);
    }
  });
}

template <class Value>
std::string text_of(const Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    std::string text;
    append_number(text, value);
    return text;
  } else {
    return std::to_string(value);
  }
}

std::string text_of(const char* text) {
  return text == nullptr ? "" : text;
}

std::vector<std::string> texts_of(vtkInformation& information, vtkInformationKey* key) {
  return with_key(key, std::vector<std::string>(), [&]<class Key, class Value>(Key* typed, const Value&) {
    std::vector<std::string> texts;
    if constexpr (std::is_same_v<Key, vtkInformationStringVectorKey>) {
      for (int i = 0; i < information.Length(typed); ++i) {
        texts.push_back(text_of(information.Get(typed, i)));
      }
    } else if constexpr (is_list<Key>) {
      for (int i = 0; i < information.Length(typed); ++i) {
        texts.push_back(text_of(information.Get(typed)[i]));
      }
    } else {
      texts.push_back(text_of(information.Get(typed)));
    }
    return texts;
  });
}

std::string lost_information(const std::string& name, const std::string& location, const std::string& array_name) {
  return "the information " + location + "::" + name + " of the array " + array_name + " is not kept";
}

}  // namespace

void read_information_keys(const XmlElement& array, vtkInformation& information, std::vector<std::string>& losses) {
  const std::string* const array_name = array.attribute("Name");
  const std::string named = array_name == nullptr ? std::string("without name") : *array_name;
  for (const XmlElement& element : array.children) {
    const std::string* const name = element.attribute("name");
    const std::string* const location = element.attribute("location");
    if (element.name != "InformationKey" || name == nullptr || location == nullptr ||
        is_range_information(*name, *location)) {
      continue;
    }
    if (std::optional<std::vector<std::string>> values = values_of(element)) {
      set_information(std::vector{ArrayInformation{*name, *location, std::move(*values)}}, named, information, losses);
    } else {
      losses.push_back(lost_information(*name, *location, named));
    }
  }
}

void set_information(std::span<const ArrayInformation> texts, const std::string& array_name,
                     vtkInformation& information, std::vector<std::string>& losses) {
  VtkMessages messages;
  messages.watch(&information);
  for (const ArrayInformation& text : texts) {
    vtkInformationKey* const key = vtkInformationKeyLookup::Find(text.name, text.location);
    if (key == nullptr || !set_key(information, key, text.values) || !messages.first_error().empty()) {
      losses.push_back(lost_information(text.name, text.location, array_name));
      messages.clear();
    }
  }
  messages.unwatch(&information);
}

std::vector<ArrayInformation> information_as_text(vtkInformation& information) {
  std::vector<ArrayInformation> texts;
  const vtkNew<vtkInformationIterator> iterator;
  iterator->SetInformationWeak(&information);
  for (iterator->InitTraversal(); iterator->IsDoneWithTraversal() == 0; iterator->GoToNextItem()) {
    vtkInformationKey* const key = iterator->GetCurrentKey();
    ArrayInformation text{key->GetName(), key->GetLocation(), texts_of(information, key)};
    if (!text.values.empty() && !is_range_information(text.name, text.location)) {
      texts.push_back(std::move(text));
    }
  }
  std::ranges::sort(texts, {}, [](const ArrayInformation& text) { return std::tie(text.location, text.name); });
  return texts;
}

}  // namespace trismooth
