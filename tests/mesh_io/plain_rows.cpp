#include "trismooth/mesh_io/text/plain_rows.h"

#include <charconv>

#include "trismooth/mesh_io/text/number_text.h"

#include "support/readings.h"
#include "vtk_legacy_files.h"

using test_support::reading_of;
using trismooth::Codec;
using trismooth::FileWorkers;
using trismooth::PlainNumbers;
using trismooth::PlainRows;
using trismooth::Workers;

namespace {

/// What is read of rows of `columns` integers from `offset` on, and where that ends; nothing where it cannot be read.
struct Rows {
  bool read = false;
  std::vector<std::int64_t> numbers;
  std::size_t last_number = 0;
  std::size_t offset = 0;

  bool operator==(const Rows&) const = default;
};

Rows read_rows(const std::string& text, std::size_t offset, std::size_t rows, std::size_t columns,
               const FileWorkers& workers) {
  Rows result;
  result.numbers.resize(rows * columns);
  const auto end = PlainRows(text, workers)
                       .read(offset, rows, columns, [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                         for (std::size_t i = first * columns; i < last * columns; ++i) {
                           if (!numbers.next(result.numbers[i])) {
                             return false;
                           }
                         }
                         return true;
                       });
  if (!end) {
    return {};
  }
  result.read = true;
  result.last_number = end->last_number;
  result.offset = end->offset;
  return result;
}

/// 0 to below - 1, by a fixed rule.
class Dice {
 public:
  std::size_t below(std::size_t limit) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>(state_ >> 33) % limit;
  }

 private:
  std::uint64_t state_ = 1;
};

struct Sample {
  std::string name;
  const Codec& codec;
  std::string bytes;
};

std::string off_text(const std::string& keyword, const std::string& after_vertex, const std::string& line_end,
                     const std::string& face) {
  std::string text = keyword + line_end + "9 8 0" + line_end;
  for (int i = 0; i < 9; ++i) {
    text += "0." + std::to_string(i * 37) + " " + std::to_string(-i) + "e-3 " + std::to_string(i % 2) + after_vertex +
            line_end;
  }
  for (int i = 0; i < 8; ++i) {
    text += face + line_end;
  }
  return text;
}

std::vector<Sample> samples() {
  using trismooth::off_codec;
  std::vector<Sample> all{
      {"plain", off_codec, off_text("OFF", "", "\n", "3 0 1 2")},
      {"quads, CR LF", off_codec, off_text("OFF", "", "\r\n", "4 0 1 2 3")},
      {"blanks", off_codec, off_text("  OFF ", " \t", " \n\n ", "3  0\t1 \v2 ")},
      {"comments", off_codec, off_text("OFF # 1 2 3", " # 7 8", "\n", "3 0 1 2 # 3")},
      {"vertex colours", off_codec, off_text("COFF", " 1 0 0.5", "\n", "3 0 1 2")},
      {"face colours", off_codec, off_text("OFF", "", "\n", "3 0 1 2 255 0 0")},
      {"a face over two lines", off_codec, off_text("OFF", "", "\n", "3 0\n1 2")},
      {"an index out of range", off_codec, off_text("OFF", "", "\n", "3 0 1 9")},
      {"plus signs", off_codec, off_text("OFF", "", "\n", "3 +0 1 2")},
      {"counts glued to the keyword", off_codec, "OFF" + off_text("", "", "\n", "3 0 1 2").substr(1)},
  };
  for (const bool with_offsets : {false, true}) {
    legacy_test::Builder file = legacy_test::grid_file(false, with_offsets);
    all.push_back({with_offsets ? "legacy VTK with offsets" : "legacy VTK", trismooth::vtk_legacy_codec, file.bytes()});
    file.text("POINT_DATA 9\n");
    legacy_test::add_attributes(file, 9, false, "p_");
    all.push_back({"legacy VTK with arrays", trismooth::vtk_legacy_codec, file.bytes()});
  }
  return all;
}

}  // namespace

TEST_CASE("rows of numbers are the same in parts of any size") {
  Dice dice;
  Workers alone(1);
  Workers two(2);
  for (int round = 0; round < 40; ++round) {
    const std::string in_front = round % 3 == 0 ? "" : round % 3 == 1 ? "words and 1 2 " : "3\n";
    std::string text = in_front;
    std::vector<std::int64_t> expected;
    const std::size_t columns = 1 + dice.below(5);
    const std::size_t rows = 1 + dice.below(12);
    for (std::size_t i = 0; i < rows * columns; ++i) {
      std::string digits;
      for (std::size_t length = 1 + dice.below(round % 2 == 0 ? 3 : 17); length > 0; --length) {
        digits += static_cast<char>('0' + dice.below(10));
      }
      digits.insert(0, dice.below(4) == 0 ? "-" : "");
      expected.push_back(std::stoll(digits));
      text += digits;
      for (std::size_t blanks = 1 + dice.below(3); blanks > 0; --blanks) {
        text += " \n\t\r\v\f"[dice.below(6)];
      }
    }
    const std::size_t behind = text.find_last_of("0123456789") + 1;
    text += round % 2 == 0 ? "7 words" : "";
    for (const std::size_t part_bytes :
         {1UL, 2UL, 3UL, 4UL, 5UL, 7UL, 16UL, 63UL, 64UL, 65UL, 200UL, FileWorkers::whole}) {
      for (Workers* const workers : {&alone, &two}) {
        const Rows got = read_rows(text, in_front.size(), rows, columns, FileWorkers(*workers, part_bytes));
        REQUIRE(got.read);
        REQUIRE(got.numbers == expected);
        REQUIRE(got.offset == behind);
      }
    }
  }
}

TEST_CASE("what is not plain is left to others, wherever it stands") {
  Workers two(2);
  const std::vector<std::string> tokens(30, "12");
  for (const std::string odd : {"x", "#", "+1", "1#", "1.", "99999999999999999999", "0x1", "--1", "1,"}) {
    for (std::size_t at = 0; at < tokens.size(); ++at) {
      std::string text;
      for (std::size_t i = 0; i < tokens.size(); ++i) {
        text += (i == at ? odd : tokens[i]) + " ";
      }
      for (const std::size_t part_bytes : {1UL, 5UL, 32UL, FileWorkers::whole}) {
        CHECK_FALSE(read_rows(text, 0, 10, 3, FileWorkers(two, part_bytes)).read);
      }
    }
  }
  for (const std::size_t part_bytes : {1UL, 5UL, 32UL, FileWorkers::whole}) {
    CHECK_FALSE(read_rows("1 2 3 4 5 6 7 8", 0, 3, 3, FileWorkers(two, part_bytes)).read);
    CHECK_FALSE(read_rows("1 2 3 4 5 6 7 8", 15, 1, 1, FileWorkers(two, part_bytes)).read);
  }
  CHECK_FALSE(read_rows("OFF12 3 4 5 6 7 8", 3, 2, 3, FileWorkers(two, 4)).read);
}

TEST_CASE("numbers read as parse_number() and parse_integer_as() read them") {
  const auto agrees = [](const std::string& token, auto zero) {
    using T = decltype(zero);
    const std::string text = token + " 1 2 3 4 5 6 7 8 9";
    PlainNumbers numbers(text, 0);
    T value{};
    if (!numbers.next(value)) {
      return true;  // others judge it
    }
    if constexpr (std::is_floating_point_v<T>) {
      const auto expected = trismooth::parse_number<T>(token);
      return expected && std::memcmp(&*expected, &value, sizeof(T)) == 0 && numbers.offset() == token.size();
    } else {
      return trismooth::parse_integer_as<T>(token) == value && numbers.offset() == token.size();
    }
  };
  for (const std::string token : {"0",
                                  "-0",
                                  "007",
                                  "1",
                                  "12",
                                  "127",
                                  "128",
                                  "-128",
                                  "-129",
                                  "255",
                                  "256",
                                  "1234567",
                                  "12345678",
                                  "123456789",
                                  "2147483647",
                                  "2147483648",
                                  "-2147483648",
                                  "1e5",
                                  "1.5",
                                  "0.1",
                                  "-2.5e-3",
                                  "1e400",
                                  "1e-400",
                                  "nan",
                                  "inf",
                                  "-inf",
                                  "1/2",
                                  "9223372036854775807",
                                  "9223372036854775808",
                                  "18446744073709551615",
                                  ":",
                                  "/",
                                  "1:"}) {
    INFO(token);
    CHECK(agrees(token, std::int8_t{}));
    CHECK(agrees(token, std::uint8_t{}));
    CHECK(agrees(token, std::int32_t{}));
    CHECK(agrees(token, std::uint64_t{}));
    CHECK(agrees(token, std::int64_t{}));
    CHECK(agrees(token, float{}));
    CHECK(agrees(token, double{}));
  }
  std::int32_t value = 0;
  CHECK(PlainNumbers("1234567 89", 0).next(value));
  CHECK(value == 1234567);
}

TEST_CASE("text files give the same document in parts of any size, and the same errors when they are damaged") {
  Workers alone(1);
  Workers two(2);
  Dice dice;
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    const std::string expected = reading_of(sample.codec, sample.bytes, FileWorkers(alone, FileWorkers::serial));
    for (std::size_t part_bytes = 1; part_bytes <= sample.bytes.size() + 1; ++part_bytes) {
      INFO(part_bytes);
      REQUIRE(reading_of(sample.codec, sample.bytes, FileWorkers(alone, part_bytes)) == expected);
    }
    REQUIRE(reading_of(sample.codec, sample.bytes, FileWorkers(two, 16)) == expected);
    for (int round = 0; round < 400; ++round) {
      std::string damaged = sample.bytes;
      constexpr std::string_view characters = "#x-+.e\n \t\\/190nN";
      damaged[dice.below(damaged.size())] = characters[dice.below(characters.size())];
      if (round % 4 == 0) {
        damaged.resize(dice.below(damaged.size()));
      }
      INFO(damaged);
      const std::string serial = reading_of(sample.codec, damaged, FileWorkers(alone, FileWorkers::serial));
      for (const std::size_t part_bytes : {1 + dice.below(8), 1 + dice.below(200), FileWorkers::whole}) {
        REQUIRE(reading_of(sample.codec, damaged, FileWorkers(alone, part_bytes)) == serial);
      }
    }
  }
}
