#include "trismooth/mesh_io/text/number_text.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "catch.h"

using trismooth::append_number;
using trismooth::parse_integer;
using trismooth::parse_number;

namespace {

template <class T>
std::string text_of(T value) {
  std::string text;
  append_number(text, value);
  return text;
}

}  // namespace

TEST_CASE("every double survives the way through its text") {
  std::mt19937_64 bits(1);
  for (int i = 0; i < 100000; ++i) {
    const auto pattern = bits();
    double value = 0;
    std::memcpy(&value, &pattern, sizeof(value));
    if (std::isfinite(value)) {
      const auto back = parse_number<double>(text_of(value));
      REQUIRE(back.has_value());
      REQUIRE(std::memcmp(&*back, &value, sizeof(value)) == 0);
    }
  }
}

TEST_CASE("the shortest text is chosen") {
  CHECK(text_of(0.1) == "0.1");
  CHECK(text_of(0.1F) == "0.1");
  CHECK(text_of(1e22) == "1e+22");
  CHECK(text_of(-0.0) == "-0");
}

TEST_CASE("a whole token is a number or it is not") {
  CHECK(parse_number<double>("1e3") == 1000.0);
  CHECK(parse_number<double>("+.5") == 0.5);
  CHECK(parse_number<double>("5.") == 5.0);
  for (const char* token : {"", "+", "-", "+-1", "++1", "1,5", "1.5x", "0x10", "e5", ".", "1e", "1d3"}) {
    CAPTURE(token);
    CHECK_FALSE(parse_number<double>(token).has_value());
  }
}

TEST_CASE("values beyond the range are infinite, values below it zero") {
  CHECK(parse_number<double>("1e400") == std::numeric_limits<double>::infinity());
  CHECK(parse_number<double>("-1e400") == -std::numeric_limits<double>::infinity());
  CHECK(parse_number<double>("1e-400") == 0.0);
  CHECK(std::signbit(*parse_number<double>("-1e-400")));
  CHECK(parse_number<float>("1e39") == std::numeric_limits<float>::infinity());
  CHECK(parse_number<float>("1e-60") == 0.0F);
  CHECK(parse_number<double>("1e99999999999999999999") == std::numeric_limits<double>::infinity());
  CHECK(parse_number<double>("1e-99999999999999999999") == 0.0);
  CHECK(parse_number<double>("0.000" + std::string(400, '0') + "1") == 0.0);
  CHECK(parse_number<double>("1" + std::string(400, '0')) == std::numeric_limits<double>::infinity());
}

TEST_CASE("whole numbers are whole tokens within 64 bits") {
  CHECK(parse_integer("9223372036854775807") == std::numeric_limits<std::int64_t>::max());
  CHECK(parse_integer("-9223372036854775808") == std::numeric_limits<std::int64_t>::min());
  CHECK(parse_integer("+7") == 7);
  for (const char* token : {"", "+", "-", "+-1", "1.", "1e3", "0x1", "9223372036854775808", "18446744073709551617"}) {
    CAPTURE(token);
    CHECK_FALSE(parse_integer(token).has_value());
  }
}
