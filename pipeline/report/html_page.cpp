// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/html_page.h"

#include <fmt/format.h>

#include "trismooth/pipeline/report/html_style.h"
#include "trismooth/pipeline/report/html_text.h"

namespace trismooth {

std::string html_page(std::string_view title, std::string body, std::string_view more_style) {
  const std::string head = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>{} - trismooth</title>\n<style>{}{}</style>\n</head>\n<body>\n<main>\n",
      escape_html(title), html_style, more_style);
  body.insert(0, head);  // (Where it is, if it has room: it may be large.)
  body += "</main>\n</body>\n</html>\n";
  return body;
}

std::string html_section(std::string_view title, std::string_view content) {
  return html_section_begin(title).append(content).append(html_section_end);
}

std::string html_section_begin(std::string_view title) {
  return fmt::format("<section>\n<h2>{}</h2>\n", title);
}

std::string html_cell(std::string_view content, std::string_view classes, std::string_view label) {
  const auto attribute = [](std::string_view name, const std::string& value) {
    return value.empty() ? std::string{} : fmt::format(" {}=\"{}\"", name, value);
  };
  return fmt::format("<td{}{}>{}</td>", attribute("class", std::string(classes)),
                     attribute("data-label", escape_html(label)), content);
}

std::string html_list(const std::vector<std::string>& texts) {
  std::string html = "<ul>\n";
  for (const std::string& text : texts) {
    html += "<li>" + escape_html(text) + "</li>\n";
  }
  return html + "</ul>\n";
}

}  // namespace trismooth
