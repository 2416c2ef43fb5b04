// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace trismooth {

/// What a reader asks its child for, of an object or of one of its attributes.
enum class Hdf5Request : std::uint8_t {
  members,      ///< a count, and of each a name and a kind
  kind,         ///< one more than the Hdf5Kind, 0 for nothing
  description,  ///< rank, extents, one more than the ScalarType or 0, is text, bytes of a value, place, is big endian
  numbers,      ///< the numbers in memory, of the type that is asked for
  part,         ///< of a part of them, whose first places and counts by dimension the request has
  bytes,        ///< the values as they are
  characters,   ///< the values, of one character each
  texts,        ///< a count and the texts
  attribute_names,  ///< a count and the names
  has_attribute,    ///< 1 or 0
  references,       ///< a count, and what each list of references has first, or 0
  reference,        ///< what refers to the object
};

/// In a description: the values stand nowhere in the file as they are.
constexpr std::uint64_t nowhere = ~std::uint64_t{0};

/// Puts a message together: numbers of 8 bytes, and texts behind their lengths.
class Hdf5MessageWriter {
 public:
  Hdf5MessageWriter& number(std::uint64_t value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  Hdf5MessageWriter& text(std::string_view value) {
    number(value.size());
    bytes_.append(value);
    return *this;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// A child that gives no answer any more, or none that makes sense; the message goes on behind the name of what it was
/// asked for.
struct Hdf5ChildLost : std::runtime_error {
  using std::runtime_error::runtime_error;
  Hdf5ChildLost() : std::runtime_error("is damaged: HDF5's library has broken off at it") {}
};

/// Takes it apart again; `bytes` outlive the object. Throws Hdf5ChildLost where there is less than is asked for.
class Hdf5MessageReader {
 public:
  explicit Hdf5MessageReader(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, next(sizeof(value)).data(), sizeof(value));
    return value;
  }
  /// A number of at most that size.
  std::uint64_t number(std::uint64_t most) {
    const std::uint64_t value = number();
    if (value > most) {
      throw Hdf5ChildLost();
    }
    return value;
  }
  /// Of things that take 8 bytes or more each.
  std::size_t count() { return static_cast<std::size_t>(number(rest_.size() / sizeof(std::uint64_t))); }
  std::string text() { return std::string(next(number())); }

 private:
  std::string_view next(std::uint64_t size) {
    if (size > rest_.size()) {
      throw Hdf5ChildLost();
    }
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view rest_;
};

}  // namespace trismooth
