// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/format_option.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/pipeline/cli/option_parsing.h"

namespace trismooth {

namespace {

FileFormat parse_format(const std::string& text) {
  if (const auto format = format_named(text)) {
    return *format;
  }
  std::vector<std::string> names;
  for (const FileFormat format : all_formats()) {
    names.emplace_back(to_string(format));
  }
  throw std::invalid_argument("unknown format '" + text + "'; valid are " + list_text(names) +
                              did_you_mean(text, names));
}

}  // namespace

CLI::Option* add_format_option(CLI::App& command, std::optional<FileFormat>& format) {
  return add_parsed_option(command, "--format", "NAME",
                           "Format of '-' and of files whose extension names none: off, vtu, ...; 'trismooth info' "
                           "lists them [by content; for output that of the input]",
                           [&format](const std::string& text) { format = parse_format(text); });
}

void require_use_of_format(std::optional<FileFormat> format,
                           std::initializer_list<std::optional<std::filesystem::path>> files) {
  const auto has_its_own = [](const std::optional<std::filesystem::path>& file) { return !file || format_of(*file); };
  if (format && std::ranges::all_of(files, has_its_own)) {
    throw std::invalid_argument(
        "--format names the format of '-' and of files whose extension names none; here every extension names one");
  }
}

}  // namespace trismooth
