// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/mesh_document.h"

#include "support/accepted_files.h"
#include "support/text_words.h"

/// What reading some bytes came to: a document or a refusal.
struct Outcome {
  std::optional<trismooth::MeshDocument> document;
  std::string message;  ///< of the refusal
  std::string fault;    ///< what must never happen, did: another exception, an unclear message, a broken promise, ...
};

/// Reads the bytes as a file of that name and extension. Finds fault with anything but a document that keeps all
/// promises of mesh_document.h and a ReadError whose message is one short line that names the file, with what VTK
/// prints, and with memory out of proportion to the file.
Outcome read(const accepted_files::AcceptedFile& file);
/// The same for a changed copy of the file.
Outcome read(const accepted_files::AcceptedFile& file, const std::string& bytes);

/// The same, and the document must be writable to its own format.
Outcome read_and_write(const accepted_files::AcceptedFile& file, const std::string& bytes);

/// Which promise of mesh_document.h the document breaks; empty where it keeps all.
std::string broken_promise(const trismooth::MeshDocument& document);

/// The first difference between two documents, notes and originals apart; empty where there is none.
std::string difference(const trismooth::MeshDocument& a, const trismooth::MeshDocument& b);

/// The bytes that a document gives when it is written back to its own format.
std::string written_back(const trismooth::MeshDocument& document);

/// Tests that visit every place of a file visit every n-th where not all cases are asked for (share_of_cases.h), and
/// with sanitizers, which read some ten times slower, still fewer of the files that take longest.
std::size_t stride_of(const accepted_files::AcceptedFile& file);

bool is_vtk_xml(const accepted_files::AcceptedFile& file);
/// MED and CGNS: a library opens each file, which takes its time.
bool is_kept_by_hdf5(const accepted_files::AcceptedFile& file);

/// Faults of many cases: all are counted, the first few are told.
class Faults {
 public:
  void add(std::string_view file, std::string_view place, std::string_view what);
  /// Adds it where it is not empty.
  void add_any(std::string_view file, std::string_view place, std::string_view what) {
    if (!what.empty()) {
      add(file, place, what);
    }
  }
  std::size_t count() const { return count_; }
  const std::string& text() const { return text_; }

 private:
  std::size_t count_ = 0;
  std::string text_;
};

/// Fails where there is any.
#define REQUIRE_NONE(faults)         \
  do {                               \
    INFO((faults).text());           \
    REQUIRE((faults).count() == 0U); \
  } while (false)
