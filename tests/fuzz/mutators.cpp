// SPDX-License-Identifier: BSD-3-Clause
#include "mutators.h"

#include <array>
#include <charconv>
#include <cstring>
#include <limits>
#include <string_view>

#include "support/xml_arrays.h"

namespace fuzz {

using accepted_files::vtk::XmlArrays;

namespace {

constexpr std::string_view digits = "0123456789";
constexpr std::string_view number_characters = "0123456789+-.eE";

constexpr std::array<std::string_view, 32> texts{"0",
                                                 "-0",
                                                 "1",
                                                 "-1",
                                                 "2",
                                                 "3",
                                                 "4",
                                                 "5",
                                                 "6",
                                                 "7",
                                                 "9",
                                                 "100",
                                                 "0.1",
                                                 "0.5",
                                                 "-2.5",
                                                 "1e-7",
                                                 "1e300",
                                                 "-1e308",
                                                 "1.7976931348623157e308",
                                                 "1e999",
                                                 "5e-324",
                                                 "2e-308",
                                                 "3.4028235e38",
                                                 "1e-45",
                                                 "nan",
                                                 "-inf",
                                                 "2147483647",
                                                 "2147483648",
                                                 "4294967296",
                                                 "9223372036854775807",
                                                 "18446744073709551615",
                                                 "0x10"};

/// Begin and length of the number around or behind `from`; a length of 0 where there is none.
std::pair<std::size_t, std::size_t> number_near(std::string_view text, std::size_t from) {
  std::size_t begin = text.find_first_of(digits, from);
  if (begin == std::string_view::npos) {
    return {0, 0};
  }
  while (begin > 0 && number_characters.find(text[begin - 1]) != std::string_view::npos) {
    --begin;
  }
  const std::size_t end = std::min(text.find_first_not_of(number_characters, begin), text.size());
  return {begin, end - begin};
}

std::string neighbour_of(std::string_view token, HashedChoices& choices) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), number);
  if (error != std::errc() || end != token.data() + token.size() ||
      number == std::numeric_limits<std::int64_t>::max() || number == std::numeric_limits<std::int64_t>::min()) {
    return std::string(token) + std::string(1, digits[choices.below(10)]);
  }
  return std::to_string(choices.flag() ? number + 1 : number - 1);
}

std::uint64_t word_near(std::uint64_t word, HashedChoices& choices) {
  constexpr std::array<std::uint64_t, 12> words{
      0, 1, 2, 3, 8, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU, 1ULL << 32U, 1ULL << 40U, 1ULL << 63U, ~0ULL};
  switch (choices.below(4)) {
    case 0:
      return word + 1;
    case 1:
      return word - 1;
    case 2:
      return 2 * word;
    default:
      return words[choices.below(words.size())];
  }
}

template <class T>
void put(std::string& bytes, std::size_t at, T number) {
  if (at + sizeof(T) <= bytes.size()) {
    std::memcpy(bytes.data() + at, &number, sizeof(T));
  }
}

/// Puts a number of a common type where one of its size may stand.
void mutate_binary_number(std::string& bytes, HashedChoices& choices) {
  constexpr std::array<double, 14> reals{0,
                                         -0.0,
                                         1,
                                         -1,
                                         0.5,
                                         2.5,
                                         1e-7,
                                         1e300,
                                         -1e308,
                                         5e-324,
                                         std::numeric_limits<double>::max(),
                                         std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::quiet_NaN(),
                                         3};
  const double real = reals[choices.below(reals.size())];
  const bool wide = choices.flag();
  const std::size_t size = wide ? 8 : 4;
  if (bytes.size() < size) {
    return;
  }
  const std::size_t at = choices.below(bytes.size() / size) * size;
  std::uint64_t old = 0;
  std::memcpy(&old, bytes.data() + at, size);
  switch (choices.below(3)) {
    case 0:
      return wide ? put(bytes, at, real) : put(bytes, at, static_cast<float>(real));
    case 1:
      return wide ? put(bytes, at, word_near(old, choices))
                  : put(bytes, at, static_cast<std::uint32_t>(word_near(old, choices)));
    default:  // another of the array's own
      std::memcpy(bytes.data() + at, std::string(bytes, choices.below(bytes.size() / size) * size, size).data(), size);
  }
}

}  // namespace

std::string mutate_number(const std::string& text, HashedChoices& choices) {
  if (text.empty()) {
    return text;
  }
  const auto [begin, length] = number_near(text, choices.below(text.size()));
  if (length == 0) {
    return text;
  }
  std::string number;
  switch (choices.below(4)) {
    case 0: {
      const auto [other, other_length] = number_near(text, choices.below(text.size()));
      number = text.substr(other, other_length);
      break;
    }
    case 1:
      number = neighbour_of(std::string_view(text).substr(begin, length), choices);
      break;
    default:
      number = texts[choices.below(texts.size())];
  }
  std::string changed = text;
  return changed.replace(begin, length, number);
}

std::string mutate_xml_array(const std::string& file, HashedChoices& choices, ByteMutator mutate) {
  const XmlArrays arrays(file);
  if (arrays.arrays().empty()) {
    return file;
  }
  const XmlArrays::Array& array = arrays.arrays()[choices.below(arrays.arrays().size())];
  // LZMA takes as long to encode a few numbers as all else takes for a hundred inputs.
  if (choices.below(6) == 0 || (arrays.is_slow() && choices.below(16) != 0)) {
    XmlArrays::Array changed = array;
    std::uint64_t& word = changed.header[choices.below(changed.header.size())];
    word = word_near(word, choices);
    return arrays.with(array, changed);
  }
  std::optional<std::string> payload = arrays.payload(array);
  if (!payload) {
    return file;
  }
  if (choices.flag()) {
    mutate_binary_number(*payload, choices);
  } else {
    const std::size_t size = payload->size();
    // Mostly of the same size: the number of values stands elsewhere in the file, too.
    const std::size_t capacity = choices.below(4) == 0 ? size + 16 : std::max<std::size_t>(size, 1);
    payload->resize(capacity);
    payload->resize(mutate(reinterpret_cast<std::uint8_t*>(payload->data()), size, capacity));
  }
  return arrays.with(array, arrays.with_payload(array, *payload));
}

}  // namespace fuzz
