#include "trismooth/mesh_io/vtk_information.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIdTypeKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationKeyLookup.h>
#include <vtkInformationStringKey.h>
#include <vtkInformationStringVectorKey.h>
#include <vtkInformationUnsignedLongKey.h>

#include "trismooth/mesh_io/number_text.h"
#include "trismooth/mesh_io/vtk_messages.h"

namespace trismooth {

namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin == std::string_view::npos
             ? ""
             : std::string(text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin));
}

template <class Value>
std::optional<Value> parse(const XmlElement& element) {
  const std::string text = trimmed(element.text);
  if constexpr (std::is_same_v<Value, std::string>) {
    return text;
  } else if constexpr (std::is_same_v<Value, double>) {
    return parse_number<double>(text);
  } else {
    Value value{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return stop == text.data() + text.size() && error == std::errc() ? std::optional(value) : std::nullopt;
  }
}

/// The values of the <Value index="0">, <Value index="1">, ... children.
template <class Value>
std::optional<std::vector<Value>> parse_vector(const XmlElement& element) {
  std::vector<Value> values;
  for (const XmlElement& child : element.children) {
    const std::string* const index = child.attribute("index");
    const std::optional<Value> value = parse<Value>(child);
    if (child.name != "Value" || index == nullptr || *index != std::to_string(values.size()) || !value) {
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return values;
}

template <class Value, class Key>
bool set_scalar(vtkInformation& information, Key* key, const XmlElement& element) {
  const std::optional<Value> value = parse<Value>(element);
  if (value) {
    information.Set(key, *value);
  }
  return value.has_value();
}

template <class Value, class Key>
bool set_vector(vtkInformation& information, Key* key, const XmlElement& element) {
  std::optional<std::vector<Value>> values = parse_vector<Value>(element);
  if (values) {
    information.Set(key, values->data(), static_cast<int>(values->size()));
  }
  return values.has_value();
}

bool set_key(vtkInformation& information, vtkInformationKey* key, const XmlElement& element) {
  if (auto* const real = vtkInformationDoubleKey::SafeDownCast(key)) {
    return set_scalar<double>(information, real, element);
  }
  if (auto* const reals = vtkInformationDoubleVectorKey::SafeDownCast(key)) {
    return set_vector<double>(information, reals, element);
  }
  if (auto* const integer = vtkInformationIntegerKey::SafeDownCast(key)) {
    return set_scalar<int>(information, integer, element);
  }
  if (auto* const integers = vtkInformationIntegerVectorKey::SafeDownCast(key)) {
    return set_vector<int>(information, integers, element);
  }
  if (auto* const id = vtkInformationIdTypeKey::SafeDownCast(key)) {
    return set_scalar<vtkIdType>(information, id, element);
  }
  if (auto* const count = vtkInformationUnsignedLongKey::SafeDownCast(key)) {
    return set_scalar<unsigned long>(information, count, element);
  }
  if (auto* const text = vtkInformationStringKey::SafeDownCast(key)) {
    return set_scalar<std::string>(information, text, element);
  }
  if (auto* const texts = vtkInformationStringVectorKey::SafeDownCast(key)) {
    const auto values = parse_vector<std::string>(element);
    for (std::size_t i = 0; values && i < values->size(); ++i) {
      information.Append(texts, values->at(i));
    }
    return values.has_value();
  }
  return false;
}

bool is_range(const std::string& name, const std::string& location) {
  return location == "vtkDataArray" && name.ends_with("_RANGE");
}

}  // namespace

void read_information_keys(const XmlElement& array, vtkInformation& information, std::vector<std::string>& losses) {
  VtkMessages messages;
  messages.watch(&information);
  for (const XmlElement& element : array.children) {
    const std::string* const name = element.attribute("name");
    const std::string* const location = element.attribute("location");
    if (element.name != "InformationKey" || name == nullptr || location == nullptr || is_range(*name, *location)) {
      continue;
    }
    vtkInformationKey* const key = vtkInformationKeyLookup::Find(*name, *location);
    if (key == nullptr || !set_key(information, key, element) || !messages.first_error().empty()) {
      const std::string* const array_name = array.attribute("Name");
      losses.push_back("the information " + *location + "::" + *name + " of the array " +
                       (array_name == nullptr ? std::string("without name") : *array_name) + " is not kept");
      messages.clear();
    }
  }
  messages.unwatch(&information);
}

}  // namespace trismooth
