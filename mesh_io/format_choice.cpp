// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/format_choice.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "trismooth/base/text/suggestion.h"
#include "trismooth/mesh_io/bytes/compressed_file.h"
#include "trismooth/mesh_io/bytes/hdf5_signature.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/mesh_io/standard_streams.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/unread_formats.h"

namespace trismooth {

namespace {

/// "the extension '.of' names no format (did you mean '.off'?)".
std::string describe_unknown_extension(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension.empty()) {
    return "has no extension that names a format";
  }
  std::vector<std::string> known;
  for (const FileFormat format : all_formats()) {
    for (const std::string_view known_extension : extensions_of(format)) {
      known.emplace_back(known_extension);
    }
  }
  return "the extension " + trismooth::quoted(extension) + " names no format" + did_you_mean(extension, known);
}

std::string describe_unavailable(FileFormat format) {
  return "this program was built without " + std::string(codec_of(format).description.library) + ", which " +
         std::string(extensions_of(format).front()) + " needs; available are " + format_names();
}

bool is_recognised(FileFormat format, std::string_view bytes) {
  if (!is_available(format)) {
    return false;
  }
  const Codec& codec = codec_of(format);
  return codec.recognises != nullptr && codec.recognises(bytes);
}

/// The only format that recognises the bytes, or nothing.
std::optional<FileFormat> only_one_recognised(std::string_view bytes) {
  std::optional<FileFormat> found;
  for (const FileFormat format : all_formats()) {
    if (is_recognised(format, bytes)) {
      if (found) {
        return std::nullopt;
      }
      found = format;
    }
  }
  return found;
}

[[noreturn]] void fail_unknown(const std::filesystem::path& path, std::string_view bytes) {
  if (const auto compression = compression_named(path); compression && !names_gzip(path)) {
    throw ReadError(path, describe(*compression));
  }
  if (const auto unread = unread_format_of(path)) {
    throw ReadError(path, describe_unread(*unread));
  }
  if (const auto unread = recognise_unread_format(bytes)) {
    throw ReadError(path, describe_unread(*unread));
  }
  const bool is_stream = path == shown_input("-");
  throw ReadError(path, (is_stream ? "the content does not show its format"
                                   : describe_unknown_extension(path) + ", and the content does not show one") +
                            "; --format NAME tells it: " + format_names());
}

/// Throws ReadError for what no format is that is read. The numbers of an XDMF mesh are beside it under its name.
[[noreturn]] void fail_unread(const std::filesystem::path& path, std::string_view bytes, const UnreadFormat& unread) {
  if (is_hdf5(bytes)) {
    for (const std::string_view extension : extensions_of(FileFormat::xdmf)) {
      const std::filesystem::path beside = std::filesystem::path(path).replace_extension(extension);
      if (std::error_code error; std::filesystem::exists(beside, error)) {
        throw ReadError(path, "has numbers of an XDMF mesh: give " + beside.string());
      }
    }
  }
  throw ReadError(path, describe_unread(unread));
}

/// Whether bytes at the beginning are zero, which no text has.
bool has_zeros(std::string_view bytes) {
  constexpr std::size_t looked_at = 64;
  return bytes.substr(0, looked_at).find('\0') != std::string_view::npos;
}

/// What the bytes begin as that is not read. Files that HDF5 keeps look alike: where one is named that is read, its
/// reader says what is wrong with it.
std::optional<UnreadFormat> unread_format(std::string_view bytes, const std::vector<FileFormat>& named) {
  const bool is_kept_by_hdf5 = bytes.starts_with("\x89HDF") && std::ranges::any_of(named, [](FileFormat format) {
                                 return codec_of(format).description.library == "HDF5";
                               });
  return is_kept_by_hdf5 ? std::nullopt : recognise_unread_format(bytes);
}

/// "as its name says", "as was told".
FormatChoice otherwise(FileFormat format, std::optional<FileFormat> named, bool is_told) {
  const std::string title(title_of(format));
  if (!named) {
    return {format, "the name of the file names no format; it is " + title + " by its content and read as that"};
  }
  return {format, "the file is " + title + " by its content, not " + std::string(title_of(*named)) +
                      (is_told ? " as was told" : " as its name says") + ": it is read as that"};
}

}  // namespace

FormatChoice choose_format(const std::filesystem::path& path, std::string_view bytes, std::optional<FileFormat> told) {
  std::vector<FileFormat> named = formats_of(path);
  const bool is_told = named.empty() && told;
  if (is_told) {
    named.push_back(*told);
  }
  const auto recognising =
      std::ranges::find_if(named, [bytes](FileFormat format) { return is_recognised(format, bytes); });
  if (recognising != named.end()) {
    return {*recognising, {}};
  }
  // A format that shows nothing is text, and what has zeros is none.
  const auto unread = unread_format(bytes, named);
  const bool is_no_text = unread && has_zeros(bytes);
  if (is_no_text && !only_one_recognised(bytes)) {
    fail_unread(path, bytes, *unread);
  }
  // What is told is of the output, too, which is to be of another format then.
  if (named.size() == 1 && !is_told && !is_no_text && is_available(named.front()) &&
      codec_of(named.front()).recognises == nullptr) {
    return {named.front(), {}};
  }
  const auto first = named.empty() ? std::nullopt : std::optional(named.front());
  if (const auto other = only_one_recognised(bytes)) {
    FormatChoice choice = otherwise(*other, first, is_told);
    if (!first && path == shown_input("-")) {
      choice.note.clear();  // nothing was said of a stream
    }
    return choice;
  }
  if (!first) {
    fail_unknown(path, bytes);
  }
  if (unread) {
    fail_unread(path, bytes, *unread);
  }
  if (!is_available(*first)) {
    throw ReadError(path, describe_unavailable(*first));
  }
  return {*first, {}};
}

FileFormat input_format(const std::filesystem::path& path) {
  const auto format = format_of(path);
  if (!format) {
    fail_unknown(path, {});
  }
  if (!is_available(*format)) {
    throw ReadError(path, describe_unavailable(*format));
  }
  return *format;
}

FileFormat output_format(const std::filesystem::path& path, std::optional<FileFormat> of_document,
                         std::optional<FileFormat> told) {
  if (compression_named(path) && !names_gzip(path)) {
    throw WriteError(path, "nothing is written compressed but by gzip (.gz); leave out '" + path.extension().string() +
                               "' and compress the file then");
  }
  if (std::error_code error; std::filesystem::is_directory(path, error)) {
    throw WriteError(path, "is a folder");
  }
  const std::vector<FileFormat> named = formats_of(path);
  std::optional<FileFormat> format = told;
  if (!named.empty()) {
    const bool keeps = of_document && std::ranges::find(named, *of_document) != named.end();
    format = keeps ? *of_document : named.front();
  } else if (!told && is_standard_stream(path)) {
    format = of_document;
  }
  if (format) {
    if (!is_available(*format)) {
      throw WriteError(shown_output(path), describe_unavailable(*format));
    }
    return *format;
  }
  if (is_standard_stream(path)) {
    throw WriteError(shown_output(path), "nothing says its format; --format NAME tells it: " + format_names());
  }
  if (const auto unread = unread_format_of(path)) {
    throw WriteError(path, describe_unwritten(*unread));
  }
  throw WriteError(path, describe_unknown_extension(path) + "; --format NAME tells it; known are " + format_list());
}

}  // namespace trismooth
