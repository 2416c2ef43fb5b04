// SPDX-License-Identifier: BSD-3-Clause
// The line ends LF, CR LF and CR, all three in one file, and locales that write numbers with a comma: the same mesh,
// and the same bytes written back.
#include <clocale>
#include <locale>
#include <string>
#include <string_view>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"

using accepted_files::AcceptedFile;
using trismooth::MeshDocument;

namespace {

/// True for files that are text throughout.
bool is_text(const AcceptedFile& file) {
  const bool binary_vtk = file.extension == ".vtk" && file.bytes.find("\nBINARY") != std::string::npos;
  const bool raw = file.name.find("appended_raw") != std::string::npos;
  return !binary_vtk && !raw && !is_kept_by_hdf5(file) && file.name.find("endian") == std::string::npos &&
         !file.name.starts_with("stl_binary") && !file.bytes.starts_with("CDF") && file.extension != ".slf";
}

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// The n-th line end becomes ends[(first + n) % 3].
std::string with_mixed_line_ends(const std::string& text, std::size_t first) {
  constexpr std::string_view ends[] = {"\n", "\r\n", "\r"};
  std::string mixed;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_line_end(text[i])) {
      mixed += text[i];
      continue;
    }
    mixed += ends[first++ % 3];
    i += text.compare(i, 2, "\r\n") == 0 ? 1 : 0;
    // A CR before an empty line that ends with LF would be one line end, not two.
    if (mixed.back() == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      mixed += '\n';
    }
  }
  return mixed;
}

/// 1.234,5: of C++ streams.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Both locales of the program for as long as it lives; that of C where the machine has one (end_to_end.decimal_comma
/// makes one).
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new CommaNumbers))) {
    std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
  }

 private:
  std::locale before_;
};

}  // namespace

TEST_CASE("Line ends may be mixed in every text format") {
  Faults faults;
  std::size_t files = 0;
  for (const AcceptedFile& file : accepted_files::all()) {
    if (!is_text(file)) {
      continue;
    }
    ++files;
    const MeshDocument whole = read(file).document.value();
    for (std::size_t first = 0; first < 3; ++first) {
      const std::string mixed = with_mixed_line_ends(file.bytes, first);
      const Outcome outcome = read(file, mixed);
      const std::string place = "first line end " + std::to_string(first);
      faults.add_any(file.name, place, outcome.fault + outcome.message);
      if (!outcome.document) {
        continue;
      }
      faults.add_any(file.name, place, difference(whole, *outcome.document));
      if (!is_vtk_xml(file) && written_back(*outcome.document) != mixed) {
        faults.add(file.name, place, "other bytes are written back");
      }
    }
  }
  CHECK(files > 60);
  REQUIRE_NONE(faults);
}

TEST_CASE("A Ctrl-Z at the end, as DOS wrote it, ends every text format and is written back") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    if (!is_text(file) || !accepted_files::is_one_file(file)) {
      continue;
    }
    const MeshDocument whole = read(file).document.value();
    std::string trimmed = file.bytes;
    while (is_line_end(trimmed.back())) {
      trimmed.pop_back();
    }
    for (const std::string& text : {file.bytes + "\x1a", trimmed + "\x1a", trimmed + "\r\n\x1a\r\n"}) {
      const Outcome outcome = read(file, text);
      faults.add_any(file.name, "read", outcome.fault + outcome.message);
      if (!outcome.document) {
        continue;
      }
      faults.add_any(file.name, "read", difference(whole, *outcome.document));
      if (!is_vtk_xml(file) && written_back(*outcome.document) != text) {
        faults.add(file.name, "written", "other bytes are written back");
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("A locale that writes numbers with a comma changes neither what is read nor what is written") {
  Faults faults;
  for (const AcceptedFile& file : accepted_files::all()) {
    MeshDocument whole = read(file).document.value();
    // Moved, so that numbers have to be written.
    for (double& coordinate : whole.points) {
      coordinate += 0.0625;
    }
    const std::string written = written_back(whole);
    const CommaLocale comma;
    Outcome outcome = read(file);
    faults.add_any(file.name, "read", outcome.fault + outcome.message);
    if (outcome.document) {
      for (double& coordinate : outcome.document->points) {
        coordinate += 0.0625;
      }
      faults.add_any(file.name, "read", difference(whole, *outcome.document));
      if (written_back(*outcome.document) != written) {
        faults.add(file.name, "written", "other bytes");
      }
    }
  }
  REQUIRE_NONE(faults);
}
