// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_child.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"
#include "trismooth/mesh_io/hdf5/hdf5_service.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// As many bytes as unpacking may make of one, each a number of eight.
constexpr std::uint64_t most_bytes_of_one = std::uint64_t{8} * 1040;
/// HDF5 has no datasets of more dimensions.
constexpr std::uint64_t most_dimensions = 32;

/// Whether numbers of the type S become those of T as HDF5 converts them: not what it refuses, or rounds in its own
/// way.
template <class T, class S>
constexpr bool is_converted = std::is_same_v<T, S> || std::is_same_v<T, double> ||
                              (std::is_integral_v<T> && std::is_integral_v<S>);

template <class T, class S>
T converted(S value) {
  if constexpr (std::is_integral_v<T>) {
    constexpr T least = std::numeric_limits<T>::min();
    constexpr T most = std::numeric_limits<T>::max();
    return std::cmp_less(value, least) ? least : std::cmp_greater(value, most) ? most : static_cast<T>(value);
  } else {
    return static_cast<T>(value);
  }
}

/// Fills `values` from as many numbers that begin at `from`. False where they are of a type that is not taken so.
template <class T>
bool take_numbers(const char* from, ScalarType type, bool is_swapped, std::size_t count, T* values) {
  return visit_scalar_type(type, [&](auto number) {
    using S = decltype(number);
    if constexpr (is_converted<T, S>) {
      if (std::is_same_v<T, S> && !is_swapped) {
        std::memcpy(values, from, count * sizeof(S));
        return true;
      }
      for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(&number, from + i * sizeof(S), sizeof(S));
        values[i] = converted<T>(is_swapped ? with_bytes_reversed(number) : number);
      }
      return true;
    } else {
      return false;
    }
  });
}

bool is_swapped(const Hdf5Place& place) {
  return place.is_big_endian == (std::endian::native == std::endian::little);
}

/// The place of a part's first value among all values, where its values follow each other.
std::optional<std::size_t> begin_of_run(std::span<const std::uint64_t> extents, std::span<const std::size_t> begin,
                                        std::span<const std::size_t> counts) {
  std::size_t first = 0;
  std::size_t stride = 1;
  bool is_whole = true;  // as far as the last dimensions go
  for (std::size_t i = extents.size(); i-- > 0;) {
    if (!is_whole && counts[i] != 1) {
      return std::nullopt;
    }
    is_whole = is_whole && counts[i] == extents[i];
    first += begin[i] * stride;
    stride *= static_cast<std::size_t>(extents[i]);
  }
  return first;
}

}  // namespace

std::uint64_t Hdf5Shape::count() const {
  std::uint64_t product = 1;
  for (const std::uint64_t extent : extents) {
    product = saturating_product(product, extent);
  }
  return product;
}

Hdf5Reader::Hdf5Reader(std::filesystem::path file, std::string_view bytes)
    : file_(std::move(file)),
      bytes_(bytes),
      most_(saturating_product(most_bytes_of_one, bytes.size() + (std::size_t{1} << 10))) {
  try {
    child_ = std::make_unique<Hdf5Child>(Hdf5Child::limits_of(bytes.size()),
                                         [bytes](Hdf5Channel& channel) { serve_hdf5(bytes, channel); });
    child_->answer(0);
  } catch (const std::runtime_error& error) {
    throw ReadError(file_, error.what());
  }
}

Hdf5Reader::~Hdf5Reader() = default;

void Hdf5Reader::fail(const Name& name, const std::string& message) const {
  const std::string object = name.second ? name.first + ":" + *name.second : name.first;
  throw ReadError(file_, quoted(std::string_view(object)) + " " + message);
}

template <class Receive>
auto Hdf5Reader::ask(Hdf5Request request, ScalarType type, const Name& name, const Receive& receive,
                     std::span<const std::size_t> more) const {
  Hdf5MessageWriter message;
  message.number(static_cast<std::uint64_t>(request)).number(static_cast<std::uint64_t>(type)).text(name.first);
  message.number(name.second ? 1 : 0).text(name.second.value_or(std::string()));
  for (const std::size_t number : more) {
    message.number(number);
  }
  try {
    child_->ask(message.take());
    return receive(*child_);
  } catch (const Hdf5Refusal& refusal) {
    throw ReadError(file_, refusal.what());
  } catch (const Hdf5ChildLost& lost) {
    fail(name, lost.what());
  }
}

template <class Take>
auto Hdf5Reader::ask(Hdf5Request request, const Name& name, const Take& take) const {
  return ask(request, ScalarType::float64, name, [&](Hdf5Child& child) {
    const std::string answer = child.answer(most_);
    Hdf5MessageReader message(answer);
    return take(message);
  });
}

const Hdf5Reader::Description& Hdf5Reader::describe(const Name& name) const {
  const auto found = descriptions_.find(name);
  if (found != descriptions_.end()) {
    return found->second;
  }
  Description description = ask(Hdf5Request::description, name, [this](Hdf5MessageReader& message) {
    Description said;
    said.shape.extents.resize(static_cast<std::size_t>(message.number(most_dimensions)));
    for (std::uint64_t& extent : said.shape.extents) {
      extent = message.number();
    }
    const std::uint64_t type = message.number(static_cast<std::uint64_t>(ScalarType::float64) + 1);
    if (type > 0) {
      said.shape.type = static_cast<ScalarType>(type - 1);
    }
    said.shape.is_text = message.number(1) != 0;
    said.value_size = message.number();
    const Hdf5Place place{message.number(), message.number(1) != 0};
    if (type > 0 && place.begin <= bytes_.size() &&
        saturating_product(said.shape.count(), size_of(*said.shape.type)) <= bytes_.size() - place.begin) {
      said.place = place;
    }
    return said;
  });
  return descriptions_.emplace(name, std::move(description)).first->second;
}

std::vector<Hdf5Member> Hdf5Reader::members(const std::string& group) const {
  const std::lock_guard lock(mutex_);
  return ask(Hdf5Request::members, {group, {}}, [](Hdf5MessageReader& message) {
    std::vector<Hdf5Member> found(message.count());
    for (Hdf5Member& member : found) {
      member.name = message.text();
      member.kind = static_cast<Hdf5Kind>(message.number(static_cast<std::uint64_t>(Hdf5Kind::other)));
    }
    return found;
  });
}

std::optional<Hdf5Kind> Hdf5Reader::kind_of(const std::string& object) const {
  const std::lock_guard lock(mutex_);
  return ask(Hdf5Request::kind, {object, {}}, [](Hdf5MessageReader& message) {
    const std::uint64_t kind = message.number(static_cast<std::uint64_t>(Hdf5Kind::other) + 1);
    return kind == 0 ? std::nullopt : std::optional(static_cast<Hdf5Kind>(kind - 1));
  });
}

Hdf5Shape Hdf5Reader::shape_of(const std::string& dataset) const {
  const std::lock_guard lock(mutex_);
  return describe({dataset, {}}).shape;
}

std::optional<Hdf5Place> Hdf5Reader::place_of(const std::string& dataset) const {
  const std::lock_guard lock(mutex_);
  return describe({dataset, {}}).place;
}

template <class T>
std::vector<T> Hdf5Reader::read_numbers(const Name& name) const {
  const Description& description = describe(name);
  const std::uint64_t count = description.shape.count();
  std::vector<T> values;
  if (description.place) {
    values.resize(static_cast<std::size_t>(count));
    if (take_numbers(bytes_.data() + description.place->begin, *description.shape.type, is_swapped(*description.place),
                     values.size(), values.data())) {
      return values;
    }
  }
  return ask(Hdf5Request::numbers, scalar_type_of<T>(), name, [&](Hdf5Child& child) {
    const std::uint64_t size = child.answer_size();
    if (size > most_ || size != saturating_product(count, sizeof(T))) {
      child.lose();
    }
    values.resize(static_cast<std::size_t>(count));
    child.receive(values.data(), static_cast<std::size_t>(size));
    return std::move(values);
  });
}

template <class T>
std::vector<T> Hdf5Reader::read(const std::string& dataset) const {
  const std::lock_guard lock(mutex_);
  return read_numbers<T>({dataset, {}});
}

DataArray Hdf5Reader::read_array(const std::string& dataset, std::string name, std::size_t components) const {
  const Hdf5Shape shape = shape_of(dataset);
  return visit_scalar_type(shape.type.value_or(ScalarType::float64), [&](auto number) {
    return make_data_array(std::move(name), components, read<decltype(number)>(dataset));
  });
}

void Hdf5Reader::read_part(const std::string& dataset, std::span<const std::size_t> begin,
                           std::span<const std::size_t> counts, ScalarType type, void* values) const {
  const std::lock_guard lock(mutex_);
  const Name name{dataset, {}};
  const Description& description = describe(name);
  const std::vector<std::uint64_t>& extents = description.shape.extents;
  bool is_within = begin.size() == extents.size() && counts.size() == extents.size();
  std::uint64_t wanted = 1;
  for (std::size_t i = 0; i < extents.size() && is_within; ++i) {
    is_within = begin[i] <= extents[i] && counts[i] <= extents[i] - begin[i];
    wanted = saturating_product(wanted, counts[i]);
  }
  if (!is_within) {
    fail(name, "has not as many values as expected");
  }
  const std::optional<std::size_t> first =
      description.place && wanted > 0 ? begin_of_run(extents, begin, counts) : std::nullopt;
  if (first && visit_scalar_type(type, [&](auto number) {
        return take_numbers(bytes_.data() + description.place->begin + *first * size_of(*description.shape.type),
                            *description.shape.type, is_swapped(*description.place), static_cast<std::size_t>(wanted),
                            static_cast<decltype(number)*>(values));
      })) {
    return;
  }
  std::vector<std::size_t> part(begin.begin(), begin.end());
  part.insert(part.end(), counts.begin(), counts.end());
  ask(
      Hdf5Request::part, type, name,
      [&](Hdf5Child& child) {
        const std::uint64_t size = child.answer_size();
        if (size != saturating_product(wanted, size_of(type))) {
          child.lose();
        }
        child.receive(values, static_cast<std::size_t>(size));
      },
      part);
}

std::string Hdf5Reader::read_values(Hdf5Request request, const Name& name) const {
  const Description& description = describe(name);
  return ask(request, ScalarType::float64, name, [&](Hdf5Child& child) {
    std::string values = child.answer(most_);
    if (values.size() != saturating_product(description.shape.count(), description.value_size)) {
      child.lose();
    }
    return values;
  });
}

std::string Hdf5Reader::read_bytes(const std::string& dataset) const {
  const std::lock_guard lock(mutex_);
  return read_values(Hdf5Request::bytes, {dataset, {}});
}

std::string Hdf5Reader::read_characters(const std::string& dataset) const {
  const std::lock_guard lock(mutex_);
  return read_values(Hdf5Request::characters, {dataset, {}});
}

std::vector<std::string> Hdf5Reader::read_list(Hdf5Request request, const Name& name) const {
  return ask(request, name, [](Hdf5MessageReader& message) {
    std::vector<std::string> texts(message.count());
    for (std::string& text : texts) {
      text = message.text();
    }
    return texts;
  });
}

std::vector<std::string> Hdf5Reader::read_texts(const Name& name) const {
  const std::uint64_t count = describe(name).shape.count();
  std::vector<std::string> texts = read_list(Hdf5Request::texts, name);
  if (texts.size() != count) {
    fail(name, Hdf5ChildLost().what());
  }
  return texts;
}

std::vector<std::string> Hdf5Reader::read_texts(const std::string& dataset) const {
  const std::lock_guard lock(mutex_);
  return read_texts(Name{dataset, {}});
}

std::vector<std::string> Hdf5Reader::attribute_names(const std::string& object) const {
  const std::lock_guard lock(mutex_);
  return read_list(Hdf5Request::attribute_names, {object, {}});
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return ask(Hdf5Request::has_attribute, {object, name},
             [](Hdf5MessageReader& message) { return message.number(1) != 0; });
}

Hdf5Shape Hdf5Reader::attribute_shape(const std::string& object, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return describe({object, name}).shape;
}

template <class T>
std::vector<T> Hdf5Reader::read_attribute(const std::string& object, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return read_numbers<T>({object, name});
}

std::vector<std::string> Hdf5Reader::read_attribute_texts(const std::string& object, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return read_texts(Name{object, name});
}

std::vector<std::uint64_t> Hdf5Reader::read_attribute_references(const std::string& object,
                                                                 const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return ask(Hdf5Request::references, {object, name}, [](Hdf5MessageReader& message) {
    std::vector<std::uint64_t> references(static_cast<std::size_t>(message.number(most_dimensions)));
    for (std::uint64_t& reference : references) {
      reference = message.number();
    }
    return references;
  });
}

std::uint64_t Hdf5Reader::reference_to(const std::string& object) const {
  const std::lock_guard lock(mutex_);
  return ask(Hdf5Request::reference, {object, {}}, [](Hdf5MessageReader& message) { return message.number(); });
}

#define TRISMOOTH_HDF5_READ(T)                                                \
  template std::vector<T> Hdf5Reader::read(const std::string& dataset) const; \
  template std::vector<T> Hdf5Reader::read_attribute(const std::string& object, const std::string& name) const;
TRISMOOTH_HDF5_READ(std::int8_t)
TRISMOOTH_HDF5_READ(std::uint8_t)
TRISMOOTH_HDF5_READ(std::int16_t)
TRISMOOTH_HDF5_READ(std::uint16_t)
TRISMOOTH_HDF5_READ(std::int32_t)
TRISMOOTH_HDF5_READ(std::uint32_t)
TRISMOOTH_HDF5_READ(std::int64_t)
TRISMOOTH_HDF5_READ(std::uint64_t)
TRISMOOTH_HDF5_READ(float)
TRISMOOTH_HDF5_READ(double)
#undef TRISMOOTH_HDF5_READ

}  // namespace trismooth
