// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/number_text.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "catch.h"

using trismooth::append_number;
using trismooth::NumberForm;
using trismooth::parse_fortran_number;
using trismooth::parse_integer;
using trismooth::parse_number;
using trismooth::rounded_to_characters;
using trismooth::write_within;

namespace {

template <class T>
std::string text_of(T value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string text_within(double value, std::size_t most, NumberForm form) {
  std::array<char, 32> text{};
  return {text.data(), write_within(value, most, form, text.data())};
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
  // The exponents that 64 bits just hold, and digits in front of the point and behind it that move them.
  for (const std::string mantissa : {"1", "123.5", "0.001"}) {
    for (const std::string exponent : {"9223372036854775807", "9223372036854775806", "9223372036854775808"}) {
      CHECK(parse_number<double>(mantissa + "e" + exponent) == std::numeric_limits<double>::infinity());
      CHECK(parse_number<double>(mantissa + "e-" + exponent) == 0.0);
    }
  }
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

TEST_CASE("what a few characters hold is what their text reads back to, and stays as it is then") {
  std::mt19937_64 bits(2);
  for (int i = 0; i < 20000; ++i) {
    const auto pattern = bits();
    double value = 0;
    std::memcpy(&value, &pattern, sizeof(value));
    value = i % 2 == 0 ? value : std::ldexp(static_cast<double>(static_cast<std::int64_t>(pattern)), -(i % 90));
    if (!std::isfinite(value)) {
      continue;
    }
    CAPTURE(value);
    for (const NumberForm form : {NumberForm::usual, NumberForm::nastran}) {
      for (const std::size_t most : {16, 20}) {
        const std::string text = text_within(value, most, form);
        CAPTURE(text, most);
        REQUIRE(text.size() <= most);
        const double rounded = rounded_to_characters(value, most, form);
        REQUIRE(parse_fortran_number<double>(text) == rounded);
        REQUIRE(std::abs(rounded - value) <= 1e-8 * std::abs(value));
        REQUIRE(text_within(rounded, most, form) == text);
        REQUIRE((form == NumberForm::usual || text.find('.') < text.size()));
      }
    }
  }
  CHECK(rounded_to_characters(0.1234567890123456789, 0) == 0.1234567890123456789);
  CHECK(rounded_to_characters(0.1234567890123456789, 8) == 0.123457);
}

TEST_CASE("numbers in Nastran's form have a decimal point and no letter before the exponent") {
  const auto text = [](double value) { return text_within(value, 16, NumberForm::nastran); };
  CHECK(text(0) == "0.");
  CHECK(text(-0.0) == "-0.");
  CHECK(text(7) == "7.");
  CHECK(text(-12.25) == "-12.25");
  CHECK(text(0.5) == ".5");
  CHECK(text(-0.0625) == "-.0625");
  CHECK(text(1.5e-5) == "1.5-5");
  CHECK(text(0.001) == ".001");
  CHECK(text(100) == "100.");
  CHECK(text(1e20) == "1.+20");
  CHECK(text(-2e-300) == "-2.-300");
  CHECK(text(1.0 / 3) == ".333333333333333");
  CHECK(text(-1.0 / 3) == "-.33333333333333");
  CHECK(text(1e6 / 3) == "333333.333333333");
  CHECK(text(1e-4 / 3) == "3.333333333333-5");
  CHECK(text(0.99999999999999999e-3) == ".001");
}

TEST_CASE("The largest numbers stay finite in few characters") {
  constexpr double largest = std::numeric_limits<double>::max();
  for (const double value :
       {largest, -largest, std::nextafter(largest, 0.0), 1.79769313486e308, -1.7976931348622e308}) {
    for (const NumberForm form : {NumberForm::usual, NumberForm::nastran}) {
      for (const std::size_t most : {16, 20}) {
        CAPTURE(value, most);
        const double rounded = rounded_to_characters(value, most, form);
        CHECK(std::isfinite(rounded));
        CHECK(std::abs(rounded / value - 1) < 1e-8);
        CHECK(text_within(value, most, form).size() <= most);
        CHECK(rounded_to_characters(rounded, most, form) == rounded);
      }
    }
  }
  CHECK(text_within(largest, 16, NumberForm::nastran) == "1.7976931348+308");
  CHECK(text_within(-largest, 16, NumberForm::nastran) == "-1.797693134+308");
}
