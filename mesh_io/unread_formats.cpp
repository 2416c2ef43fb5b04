// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/unread_formats.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_head.h"

namespace trismooth {

namespace {

using namespace std::string_view_literals;

struct ExtensionOfUnread {
  std::string_view extension;
  UnreadFormat format;
};

constexpr UnreadFormat exodus{"Exodus II", "meshio convert in.exo out.vtu"};
constexpr UnreadFormat fluent{"Ansys Fluent", "meshio convert --input-format ansys in.msh out.vtu"};
constexpr UnreadFormat netgen{"Netgen", "meshio convert in.vol out.vtu"};
constexpr UnreadFormat netcdf{"NetCDF (as Exodus II, UGRID and models of the ocean have it)", exodus.converter};
constexpr UnreadFormat selafin{"Selafin (Telemac)", ""};
constexpr UnreadFormat mike{"MIKE (DHI)", ""};
constexpr UnreadFormat jigsaw{"JIGSAW", ""};
constexpr UnreadFormat utf_16{"text in UTF-16", "iconv -f UTF-16 -t UTF-8 in.off > out.off"};

constexpr auto by_extension = std::to_array<ExtensionOfUnread>({
    {".exo", exodus},
    {".e", exodus},
    {".ex2", exodus},
    {".g", exodus},
    {".cdb", {"an Ansys archive (CDB)", ""}},
    {".vol", netgen},
    {".h5", {"HDF5", ""}},
    {".hdf5", {"HDF5", ""}},
    {".nc", netcdf},
    {".slf", selafin},
    {".sel", selafin},
    {".dfsu", mike},
    {".cas", fluent},
});

bool begins_as_netcdf(std::string_view bytes) {
  return bytes.size() > 3 && bytes.starts_with("CDF") && (bytes[3] == 1 || bytes[3] == 2 || bytes[3] == 5);
}

/// The section "(0 "comment")", "(0 grid written by ..." or "(2 dimension)" that such files open with.
bool begins_as_fluent(std::string_view head) {
  const bool has_comment = head.starts_with("(0 ") && head.size() > 3 &&
                           (head[3] == '"' || ('A' <= (head[3] & ~0x20) && (head[3] & ~0x20) <= 'Z'));
  return has_comment || head.starts_with("(0\"") || head.starts_with("(1 \"") || head.starts_with("(2 2)") ||
         head.starts_with("(2 3)");
}

/// Records of Fortran, each between its lengths; the first is a title of 80 characters.
bool begins_as_selafin(std::string_view bytes) {
  constexpr std::string_view length = "\0\0\0\x50"sv;
  return bytes.starts_with(length) && bytes.size() > 88 && bytes.substr(84, 4) == length;
}

/// A first line of whole numbers and a projection: "100079 1000 28905 UTM-33", and without the first two in older
/// files.
bool begins_as_mike(std::string_view head) {
  std::vector<std::string_view> words = words_of(head.substr(0, head.find_first_of("\r\n")));
  const std::size_t numbers = words.size() > 3 ? 3 : 1;
  constexpr auto projections =
      std::to_array<std::string_view>({"PROJCS[", "GEOGCS[", "LOCAL_CS[", "LONG/LAT", "NON-UTM", "UTM-"});
  return words.size() > numbers &&
         std::ranges::all_of(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(numbers),
                             [](std::string_view word) { return parse_integer(word).has_value(); }) &&
         std::ranges::any_of(projections, [&](std::string_view name) { return words[numbers].starts_with(name); });
}

/// With its mark, or without it, where the first characters are ASCII.
bool begins_as_utf_16(std::string_view bytes) {
  const auto has_characters_at = [bytes](std::size_t first) {
    constexpr std::size_t looked_at = 16;
    if (bytes.size() < looked_at) {
      return false;
    }
    for (std::size_t i = 0; i < looked_at; ++i) {
      const bool is_character = (bytes[i] >= ' ' && bytes[i] <= '~') || (bytes[i] >= '\t' && bytes[i] <= '\r');
      if (i % 2 == first ? !is_character : bytes[i] != '\0') {
        return false;
      }
    }
    return true;
  };
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || has_characters_at(0) || has_characters_at(1);
}

/// "; 'meshio convert in.exo out.vtu' makes a file that is", or empty.
std::string describe_converter(const UnreadFormat& format) {
  return format.converter.empty() ? "" : "; '" + std::string(format.converter) + "' makes a file that is";
}

}  // namespace

std::optional<UnreadFormat> unread_format_of(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const auto* const found = std::ranges::find(by_extension, extension, &ExtensionOfUnread::extension);
  return found == by_extension.end() ? std::nullopt : std::optional(found->format);
}

std::optional<UnreadFormat> recognise_unread_format(std::string_view bytes) {
  const std::string_view head = text_head(bytes);
  if (head.starts_with("\x89HDF\r\n\x1a\n"sv)) {
    return UnreadFormat{"HDF5 (as Exodus II, XDMF and NetCDF 4 have it)", exodus.converter};
  }
  if (begins_as_netcdf(head)) {
    return netcdf;
  }
  if (begins_as_utf_16(bytes)) {
    return utf_16;
  }
  if (begins_as_selafin(bytes)) {
    return selafin;
  }
  if (begins_as_mike(head)) {
    return mike;
  }
  if (head.substr(0, 1024).find("MSHID=") != head.npos) {
    return jigsaw;
  }
  if (begins_as_fluent(head)) {
    return fluent;
  }
  if (head.starts_with("mesh3d") || head.starts_with("# Generated by NETGEN")) {
    return netgen;
  }
  return std::nullopt;
}

std::string describe_unread(const UnreadFormat& format) {
  return "is " + std::string(format.title) + ", which is not read" + describe_converter(format) + "; known are " +
         titled_format_list();
}

std::string describe_unwritten(const UnreadFormat& format) {
  return std::string(format.title) + " is not written; known are " + titled_format_list();
}

}  // namespace trismooth
