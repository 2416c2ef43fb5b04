// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace test_support {

/// Selafin files, record by record, with bytes put one by one.
class SmallSelafin {
 public:
  explicit SmallSelafin(bool is_big = true, std::size_t real_size = 8) : is_big_(is_big), real_size_(real_size) {}

  const std::string& bytes() const { return bytes_; }

  /// Title, names of variables (of 32 characters, which blanks fill up), parameters and, if these say so, a date.
  void head(const std::vector<std::string>& variables = {},
            const std::vector<std::int32_t>& parameters = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0}) {
    record(filled("a plate", 72) + (real_size_ == 8 ? "SERAFIND" : "SERAFIN "));
    integers({static_cast<std::int32_t>(variables.size()), 0});
    for (const std::string& variable : variables) {
      record(filled(variable, 32));
    }
    integers(parameters);
    if (parameters.back() == 1) {
      integers({2026, 11, 30, 9, 25, 0});
    }
  }

  void record(const std::string& content) {
    put(content.size(), 4);
    bytes_ += content;
    put(content.size(), 4);
  }

  void integers(const std::vector<std::int32_t>& numbers) {
    put(4 * numbers.size(), 4);
    for (const std::int32_t number : numbers) {
      put(static_cast<std::uint32_t>(number), 4);
    }
    put(4 * numbers.size(), 4);
  }

  void reals(const std::vector<double>& numbers) {
    put(real_size_ * numbers.size(), 4);
    for (const double number : numbers) {
      const auto narrow = static_cast<float>(number);
      std::uint64_t bits = 0;
      std::uint32_t narrow_bits = 0;
      std::memcpy(&bits, &number, sizeof(bits));
      std::memcpy(&narrow_bits, &narrow, sizeof(narrow_bits));
      put(real_size_ == 8 ? bits : narrow_bits, real_size_);
    }
    put(real_size_ * numbers.size(), 4);
  }

  /// Offsets behind the records of a file, whose order of bytes its first four tell.
  static std::vector<std::size_t> ends_of_records(const std::string& bytes) {
    std::vector<std::size_t> ends;
    const bool is_big = bytes.at(0) == '\0';
    for (std::size_t at = 0; at + 4 <= bytes.size();) {
      std::size_t size = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        size = 256 * size + static_cast<unsigned char>(bytes[at + (is_big ? i : 3 - i)]);
      }
      at += size + 8;
      ends.push_back(at);
    }
    return ends;
  }

 private:
  static std::string filled(std::string text, std::size_t size) {
    text.resize(size, ' ');
    return text;
  }

  void put(std::uint64_t number, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) {
      bytes += static_cast<char>(number >> (8 * i) & 0xFFU);
    }
    if (is_big_) {
      std::reverse(bytes.begin(), bytes.end());
    }
    bytes_ += bytes;
  }

  bool is_big_;
  std::size_t real_size_;
  std::string bytes_;
};

}  // namespace test_support
