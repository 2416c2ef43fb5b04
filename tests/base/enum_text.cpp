// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/enum_text.h"

#include <array>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::enum_text_test {

template <class Enum>
std::string complaint(std::string_view text) {
  return message_of<std::invalid_argument>([&] { static_cast<void>(parse_enum<Enum>(text)); });
}

TEMPLATE_TEST_CASE("every text reads back as its value, and no two are alike", "", trismooth::Method, trismooth::Form,
                   trismooth::Layout, trismooth::Execution, trismooth::Order, trismooth::Precision,
                   trismooth::StopReason, trismooth::TargetShape) {
  std::set<std::string_view> texts;
  std::set<TestType> values;
  for (const auto& [value, text] : trismooth::EnumText<TestType>::texts) {
    CHECK(to_string(value) == text);
    CHECK(parse_enum<TestType>(text) == value);
    CHECK(texts.insert(text).second);
    CHECK(values.insert(value).second);
    // A misspelt one is refused with a message that lists this and all others.
    const std::string said = complaint<TestType>(std::string(text) + "x");
    CHECK(said.find(text) != std::string::npos);
    CHECK(said.find(valid_texts<TestType>()) != std::string::npos);
  }
}

TEST_CASE("the texts are those of the command line and the JSON report") {
  CHECK(valid_texts<trismooth::Method>().starts_with("smart, laplacian, weighted, mean-ratio"));
  CHECK(valid_texts<trismooth::Form>() == "a, b");
  CHECK(valid_texts<trismooth::Layout>() == "aos, soa");
  CHECK(valid_texts<trismooth::Execution>() == "resident, single-block, cdp");
  CHECK(valid_texts<trismooth::Order>() == "colour, unordered");
  CHECK(valid_texts<trismooth::Precision>() == "double, single");
  CHECK(valid_texts<trismooth::TargetShape>() == "uniform, input-shape");
  CHECK(to_string(trismooth::Form::swap) == "a");
  CHECK(to_string(trismooth::StopReason::quality_target) == "quality_target");
  CHECK(to_string(trismooth::StopReason::few_moves) == "few_moves");
}

TEST_CASE("the values of an enumeration are those of its texts, and help says what each stands for") {
  CHECK(trismooth::values_of<trismooth::Form>() == std::array{trismooth::Form::swap, trismooth::Form::in_place});
  const std::string help = trismooth::explained_texts<trismooth::Method>();
  CHECK(help.starts_with("smart: to the mean of the neighbours, where the worst element around gets better; "));
  CHECK(help.find("; laplacian: always; weighted: ") != std::string::npos);
  CHECK_FALSE(help.ends_with("; "));
}

TEST_CASE("a bad value's message says what it is and which are valid") {
  CHECK(complaint<trismooth::Form>("c") == "unknown form 'c'; valid are a, b");
  CHECK(complaint<trismooth::Method>("") == "unknown method ''; valid are " + valid_texts<trismooth::Method>());
  CHECK(complaint<trismooth::Layout>("") == "unknown layout ''; valid are aos, soa");
  CHECK(complaint<trismooth::Layout>("Soa") == "unknown layout 'Soa'; valid are aos, soa");
  CHECK(complaint<trismooth::Precision>("half") == "unknown precision 'half'; valid are double, single");
}

}  // namespace trismooth::enum_text_test
