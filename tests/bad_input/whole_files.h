#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "support/accepted_files.h"

/// Which cuts leave a whole file: the rules of every format, for the files of the collection.
namespace whole_files {

/// Whether the first `cut` bytes of the file are a whole file.
bool is_whole(const accepted_files::AcceptedFile& file, std::size_t cut);

/// The last number that a file needs, where it is a coordinate at the end of a text without an end of its own: cut, it
/// is another number, which no reader can tell. Else empty.
std::string_view last_coordinate(const accepted_files::AcceptedFile& file);

/// The same as is_whole() for OFF, OBJ, PLY, STL and VTK's formats, for formats of meshes with groups, and for decks:
/// Abaqus, Nastran and UNV.
bool is_whole_general(const accepted_files::AcceptedFile& file, std::size_t cut);
bool is_whole_mesh(const accepted_files::AcceptedFile& file, std::size_t cut);
bool is_whole_deck(const accepted_files::AcceptedFile& file, std::size_t cut);

bool is_space(char c);
std::vector<std::string> words(std::string_view text);
/// Whether the text is a number, with Fortran's exponents.
bool is_number(const std::string& text);
bool is_whole_number(const std::string& text);

}  // namespace whole_files
