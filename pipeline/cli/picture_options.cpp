// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/picture_options.h"

#include <string>

#include "trismooth/pipeline/cli/mesh_options.h"
#include "trismooth/pipeline/cli/option_parsing.h"
#include "trismooth/pipeline/picture/picture_sheet.h"

namespace trismooth {

void add_picture_options(CLI::App& command, PictureSettings& pictures) {
  constexpr bool repeatable = true;
  add_parsed_option(
      command, "--picture", "FILE", "Draw the mesh as it is at the end: FILE.svg or FILE.png. Repeatable",
      [&pictures](const std::string& text) {
        require_picture_extension(text);
        pictures.files.emplace_back(text);
      },
      repeatable)
      ->group(option_group::results);
  add_parsed_option(command, "--picture-metric", "NAME",
                    "What elements of pictures are coloured by: a metric, region, or moved, the distance [shape]",
                    [&pictures](const std::string& text) {
                      pictures.shown.value = picture_value_named(text);
                      pictures.effects.emplace_back("--picture-metric");
                    })
      ->group(option_group::results);
  add_parsed_option(command, "--picture-window", "X0,Y0,X1,Y1",
                    "The part of the mesh that pictures show, in the file's unit; with --geographic longitudes and "
                    "latitudes [all of it]",
                    [&pictures](const std::string& text) {
                      pictures.shown.window = picture_window(text);
                      pictures.effects.emplace_back("--picture-window");
                    })
      ->group(option_group::results);
  add_parsed_option(command, "--picture-worst", "N",
                    "Close-ups of the N worst elements in pictures, of those that these show [0]",
                    [&pictures](const std::string& text) {
                      pictures.shown.worst = parse_integer(text, 0, most_close_ups);
                      pictures.effects.emplace_back("--picture-worst");
                    })
      ->group(option_group::results);
}

}  // namespace trismooth
