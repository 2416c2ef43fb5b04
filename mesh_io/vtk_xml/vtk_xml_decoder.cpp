#include "trismooth/mesh_io/vtk_xml/vtk_xml_decoder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include <vtkDataCompressor.h>
#include <vtkObject.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/plain_rows.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_compressor.h"

namespace trismooth {

namespace {

/// No block gets larger than that many times its compressed size (and a little): a larger one is not even tried.
std::uint64_t most_expansion(VtkXmlCompressor compressor) {
  switch (compressor) {
    case VtkXmlCompressor::none:
      break;
    case VtkXmlCompressor::zlib:
      return 1032;
    case VtkXmlCompressor::lz4:
      return 255;
    case VtkXmlCompressor::lzma:
      return 16384;
  }
  return 1;
}

constexpr const char* unexpected_data = "holds data, but the file declares no rows for it";

template <class Word>
void swap_bytes(std::byte* bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i, bytes += sizeof(Word)) {
    std::reverse(bytes, bytes + sizeof(Word));
  }
}

void to_native_order(std::byte* bytes, std::size_t size, std::size_t word_size, bool big_endian) {
  if (big_endian == (std::endian::native == std::endian::big)) {
    return;
  }
  switch (word_size) {
    case 2:
      return swap_bytes<std::uint16_t>(bytes, size / 2);
    case 4:
      return swap_bytes<std::uint32_t>(bytes, size / 4);
    case 8:
      return swap_bytes<std::uint64_t>(bytes, size / 8);
    default:
      return;
  }
}

bool separates_tokens(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Cuts the next token off the text; empty at its end.
std::string_view take_token(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && separates_tokens(text[begin])) {
    ++begin;
  }
  std::size_t end = begin;
  while (end < text.size() && !separates_tokens(text[end])) {
    ++end;
  }
  const std::string_view token = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return token;
}

template <class T>
std::optional<T> parse(std::string_view token) {
  if constexpr (std::is_floating_point_v<T>) {
    const std::optional<T> value = parse_number<T>(token);
    const bool beyond_range =
        value && std::isinf(*value) && token.find_first_of("0123456789") != std::string_view::npos;
    return beyond_range ? std::nullopt : value;
  } else {
    return parse_integer_as<T>(token);
  }
}

std::string counted(std::uint64_t count) {
  return std::to_string(count);
}

/// a * b, or the largest number where that is too large.
std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > largest / b ? largest : a * b;
}

}  // namespace

VtkXmlDecoder::VtkXmlDecoder(std::filesystem::path path, std::string_view bytes, const VtkXmlHeader& header,
                             const FileWorkers& workers, std::vector<std::string>& losses)
    : path_(std::move(path)),
      bytes_(bytes),
      header_(header),
      workers_(workers),
      losses_(losses),
      compressor_(make_vtk_compressor(header.encoding.compressor)) {
  if (compressor_ != nullptr) {
    messages_.watch(compressor_);
  }
}

VtkXmlDecoder::~VtkXmlDecoder() = default;

void VtkXmlDecoder::fail(const XmlElement& array, const std::string& message) const {
  const std::string* const name = array.attribute("Name");
  throw ReadError(path_, array.line,
                  (name == nullptr ? "the array " : "array " + trismooth::quoted(*name) + " ") + message);
}

void VtkXmlDecoder::fail_at(const XmlElement& array, const char* place, const std::string& message) const {
  XmlElement at = {.name = {}, .attributes = array.attributes, .children = {}, .text = {}};
  at.line = 1 + static_cast<std::size_t>(std::count(bytes_.data(), place, '\n'));
  fail(at, message);
}

std::string_view VtkXmlDecoder::text_of(const XmlElement& array) const {
  return bytes_.substr(array.content_begin, array.content_end - array.content_begin);
}

std::uint64_t VtkXmlDecoder::appended_offset_of(const XmlElement& array) const {
  if (header_.appended_begin == 0) {
    fail(array, "is in appended data, but there is no <AppendedData>");
  }
  const std::string* const text = array.attribute("offset");
  const auto offset = text == nullptr ? std::nullopt : parse<std::uint64_t>(*text);
  const std::uint64_t size = header_.appended_end - header_.appended_begin;
  if (!offset || *offset > size) {
    fail(array, "has offset " + (text == nullptr ? "(none)" : trismooth::quoted(*text)) + "; the appended data have " +
                    counted(size) + " bytes");
  }
  return *offset;
}

EncodedBytes VtkXmlDecoder::source_of(const XmlElement& array) const {
  if (vtk_xml_mode_of(path_, array) == VtkXmlMode::binary) {
    return {text_of(array), EncodedBytes::Encoding::base64};
  }
  const std::size_t begin = header_.appended_begin + appended_offset_of(array);
  return {bytes_.substr(begin, header_.appended_end - begin),
          header_.encoding.appended_base64 ? EncodedBytes::Encoding::base64 : EncodedBytes::Encoding::raw};
}

std::vector<std::uint64_t> VtkXmlDecoder::read_header_words(const XmlElement& array, EncodedBytes& source,
                                                            std::size_t count) const {
  const std::size_t word_size = header_.encoding.wide_block_headers ? 8 : 4;
  if (count > source.most_available() / word_size) {
    fail(array, "ends within its block header");
  }
  std::vector<std::byte> bytes(count * word_size);
  if (!source.read(bytes.data(), bytes.size())) {
    fail(array, "has a block header that is cut off or not base64");
  }
  to_native_order(bytes.data(), bytes.size(), word_size, header_.encoding.big_endian);
  std::vector<std::uint64_t> words(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (word_size == 8) {
      std::memcpy(&words[i], bytes.data() + 8 * i, 8);
    } else {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes.data() + 4 * i, 4);
      words[i] = word;
    }
  }
  return words;
}

void VtkXmlDecoder::check_size(const XmlElement& array, std::uint64_t size, std::size_t word_size,
                               std::optional<std::uint64_t> expected) const {
  if (expected && size < *expected) {
    fail(array, "declares " + counted(size) + " bytes of data, expected " + counted(*expected));
  }
  if (size % word_size != 0) {
    fail(array, "declares " + counted(size) + " bytes of data, which is not a multiple of " + counted(word_size));
  }
}

void VtkXmlDecoder::take_surplus(const XmlElement& array, const char* place, Surplus surplus, std::string_view what) {
  const std::string message = "holds more than the " + std::string(what);
  if (surplus == Surplus::refused) {
    fail_at(array, place, message + " expected");
  }
  const std::string* const name = array.attribute("Name");
  losses_.push_back("the array " + (name == nullptr ? std::string() : trismooth::quoted(*name) + " ") + "in line " +
                    counted(array.line) + " " + message + " that the file asks for; the rest is not kept");
}

bool VtkXmlDecoder::read_plain(const XmlElement& array, EncodedBytes& source, std::size_t word_size,
                               std::optional<std::uint64_t> expected, MemoryBlock& bytes) {
  const std::uint64_t size = read_header_words(array, source, 1)[0];
  check_size(array, size, word_size, expected);
  if (size > 0 && vtk_xml_mode_of(path_, array) != VtkXmlMode::ascii) {
    const bool apart = source.is_behind_padding();
    sizes_apart_ = sizes_apart_.value_or(apart);
    if (apart) {
      source.end_run();
    }
  }
  if (size > source.most_available()) {
    fail(array,
         "declares " + counted(size) + " bytes of data, but has " + counted(source.most_available()) + " at most");
  }
  const bool complete = source.append_to(bytes, size, workers_);
  if (!complete || !source.end_run()) {
    fail(array, "is not base64 of its " + counted(size) + " bytes");
  }
  return expected && size > *expected;
}

const unsigned char* VtkXmlDecoder::compressed_block(const XmlElement& array, EncodedBytes& source,
                                                     std::uint64_t compressed_size) {
  if (compressed_size > source.most_available()) {
    fail(array, "declares a compressed block of " + counted(compressed_size) + " bytes, but has " +
                    counted(source.most_available()) + " at most");
  }
  if (vtk_xml_mode_of(path_, array) == VtkXmlMode::appended && !header_.encoding.appended_base64) {
    return reinterpret_cast<const unsigned char*>(source.view(compressed_size).data());
  }
  compressed_block_.resize(compressed_size);
  if (!source.read(reinterpret_cast<std::byte*>(compressed_block_.data()), compressed_size)) {
    fail(array, "is cut off or not base64");
  }
  return compressed_block_.data();
}

void VtkXmlDecoder::uncompress_block(const XmlElement& array, EncodedBytes& source, std::uint64_t compressed_size,
                                     std::uint64_t size, MemoryBlock& bytes) {
  // VTK's compressors take some sizes as int.
  constexpr std::uint64_t most = std::numeric_limits<int>::max();
  if (size > most || compressed_size > most) {
    fail(array, "declares a compressed block of more than 2 GiB");
  }
  if (size > saturating_product(compressed_size, most_expansion(header_.encoding.compressor)) + 64) {
    fail(array, "declares " + counted(size) + " bytes in a compressed block of " + counted(compressed_size));
  }
  const unsigned char* const compressed = compressed_block(array, source, compressed_size);
  auto* const target = reinterpret_cast<unsigned char*>(bytes.extend(size));
  messages_.clear();
  if (size != 0 && (compressor_->Uncompress(compressed, compressed_size, target, size) != size ||
                    !messages_.first_error().empty())) {
    fail(array, "holds a compressed block that is damaged");
  }
}

/// Uncompresses the first blocks, `wanted` at most, on all workers; how many those were. At the first one with anything
/// wrong in it, or before, it leaves off, and `source` stands there.
std::size_t VtkXmlDecoder::uncompress_shared(EncodedBytes& source, const std::vector<std::uint64_t>& compressed_sizes,
                                             std::uint64_t block_size, std::uint64_t last_size, std::size_t wanted,
                                             MemoryBlock& bytes) const {
  constexpr std::size_t blocks_a_worker = 8;  // at a time: no more memory is taken than what has been decoded asks for
  constexpr std::uint64_t most_block_bytes = std::uint64_t{1} << 24;  // more than any writer makes of one block
  if (workers_.part_bytes == FileWorkers::whole || workers_.part_bytes == FileWorkers::serial ||
      block_size > most_block_bytes || block_size == 0) {
    return 0;
  }
  struct Uncompressor {
    vtkSmartPointer<vtkDataCompressor> compressor;
    VtkMessages messages;
  };
  std::vector<std::unique_ptr<Uncompressor>> uncompressors;
  for (int i = 0; i < workers_.workers.count(); ++i) {
    uncompressors.push_back(std::make_unique<Uncompressor>());
    uncompressors.back()->compressor = make_vtk_compressor(header_.encoding.compressor);
    uncompressors.back()->messages.watch(uncompressors.back()->compressor);
  }
  for (std::size_t done = 0;;) {
    const std::size_t count = std::min(blocks_a_worker * uncompressors.size(), wanted - done);
    const EncodedBytes source_before = source;
    const std::size_t size_before = bytes.size();
    std::vector<std::size_t> compressed_begins{0};
    std::vector<std::size_t> begins{0};
    bool sound = true;
    for (std::size_t block = done; block < done + count && sound; ++block) {
      const std::uint64_t compressed_size = compressed_sizes[block];
      const std::uint64_t size = block + 1 == compressed_sizes.size() ? last_size : block_size;
      sound = compressed_size <= most_block_bytes &&
              compressed_size <= source.most_available() - compressed_begins.back() && size > 0 &&
              size <= saturating_product(compressed_size, most_expansion(header_.encoding.compressor)) + 64;
      compressed_begins.push_back(compressed_begins.back() + compressed_size);
      begins.push_back(begins.back() + size);
    }
    if (count == 0 || !sound) {
      return done;
    }
    MemoryBlock compressed;
    if (source.append_to(compressed, compressed_begins.back(), workers_)) {
      auto* const target = reinterpret_cast<unsigned char*>(bytes.extend(begins.back()));
      const auto* const from = reinterpret_cast<const unsigned char*>(compressed.data());
      std::atomic<std::size_t> next_block = 0;
      std::atomic<bool> failed = false;
      const auto uncompress = [&](Uncompressor& one) {
        for (std::size_t i = next_block++; i < count && !failed; i = next_block++) {
          const std::size_t size = begins[i + 1] - begins[i];
          one.messages.clear();
          if (one.compressor->Uncompress(from + compressed_begins[i], compressed_begins[i + 1] - compressed_begins[i],
                                         target + begins[i], size) != size ||
              !one.messages.first_error().empty()) {
            failed = true;
          }
        }
      };
      workers_.workers.for_blocks(static_cast<std::int64_t>(uncompressors.size()), 1,
                                  [&](std::int64_t first, std::int64_t last) {
                                    for (std::int64_t i = first; i < last; ++i) {
                                      uncompress(*uncompressors[static_cast<std::size_t>(i)]);
                                    }
                                  });
      if (!failed) {
        done += count;
        continue;
      }
    }
    bytes.truncate(size_before);
    source = source_before;
    return done;
  }
}

bool VtkXmlDecoder::read_compressed(const XmlElement& array, EncodedBytes& source, std::size_t word_size,
                                    std::optional<std::uint64_t> expected, MemoryBlock& bytes) {
  const std::vector<std::uint64_t> header = read_header_words(array, source, 3);
  const std::uint64_t blocks = header[0];
  const std::uint64_t block_size = header[1];
  const std::uint64_t last_size = header[2] == 0 ? block_size : header[2];
  const std::vector<std::uint64_t> compressed_sizes = read_header_words(array, source, blocks);
  if (!source.end_run()) {
    fail(array, "has a block header that does not end where it should");
  }
  if (last_size > block_size) {
    fail(array, "has a last block larger than the others");
  }
  const std::uint64_t whole_blocks = blocks == 0 ? 0 : saturating_product(blocks - 1, block_size);
  const std::uint64_t total = blocks == 0 ? 0 : whole_blocks + std::min(last_size, ~whole_blocks);
  check_size(array, total, word_size, expected);
  const std::size_t begin = bytes.size();
  const std::uint64_t wanted = expected && block_size > 0 ? *expected / block_size : blocks;
  std::size_t block = uncompress_shared(source, compressed_sizes, block_size, last_size,
                                        static_cast<std::size_t>(std::min(wanted, blocks)), bytes);
  for (; block < blocks; ++block) {
    if (expected && bytes.size() - begin >= *expected) {
      compressed_block(array, source, compressed_sizes[block]);  // of what nobody asked for
      continue;
    }
    uncompress_block(array, source, compressed_sizes[block], block + 1 == blocks ? last_size : block_size, bytes);
  }
  if (!source.end_run()) {
    fail(array, "has more compressed data than it declares");
  }
  return expected && total > *expected;
}

void VtkXmlDecoder::read_bytes(const XmlElement& array, std::size_t word_size, std::optional<std::uint64_t> expected,
                               MemoryBlock& bytes, Surplus surplus) {
  const std::size_t begin = bytes.size();
  EncodedBytes source = source_of(array);
  const bool more = compressor_ == nullptr ? read_plain(array, source, word_size, expected, bytes)
                                           : read_compressed(array, source, word_size, expected, bytes);
  if (more) {
    take_surplus(array, text_of(array).data(), surplus, counted(*expected / word_size) + " numbers");
    bytes.truncate(begin + *expected);
  }
  if (vtk_xml_mode_of(path_, array) == VtkXmlMode::appended) {
    // Arrays that share appended data could make a small file fill the memory.
    offsets_read_.insert(appended_offset_of(array));
    appended_used_ += source.used();
    if (appended_used_ > header_.appended_end - header_.appended_begin) {
      fail(array, "overlaps another array in the appended data");
    }
  } else {
    std::string_view rest = source.rest();
    if (!take_token(rest).empty()) {
      fail(array, "holds more data than it declares");
    }
  }
  to_native_order(bytes.data() + begin, bytes.size() - begin, word_size, header_.encoding.big_endian);
}

void VtkXmlDecoder::expect_empty(const XmlElement& array) {
  const VtkXmlMode mode = vtk_xml_mode_of(path_, array);
  if (mode == VtkXmlMode::appended) {
    empty_in_appended_.push_back(&array);
    return;
  }
  std::string_view text = text_of(array);
  if (mode == VtkXmlMode::ascii) {
    if (!take_token(text).empty()) {
      fail(array, unexpected_data);
    }
    return;
  }
  // The first word is a number of bytes or of blocks.
  EncodedBytes source = source_of(array);
  if (take_token(text).empty()) {
    return;
  }
  const bool declares_data = read_header_words(array, source, 1)[0] != 0;
  std::string_view rest = source.rest();
  // A compressed array of no blocks may go on with their size.
  if (declares_data || (compressor_ == nullptr && !take_token(rest).empty())) {
    fail(array, unexpected_data);
  }
}

void VtkXmlDecoder::check_empty_arrays() {
  for (const XmlElement* const array : empty_in_appended_) {
    EncodedBytes source = source_of(*array);
    const bool shared = offsets_read_.contains(appended_offset_of(*array));
    const std::size_t word_size = header_.encoding.wide_block_headers ? 8 : 4;
    if (!shared && source.most_available() >= word_size && read_header_words(*array, source, 1)[0] != 0) {
      fail(*array, unexpected_data);
    }
  }
}

/// Exactly `count` numbers; false, and nothing done, where there is anything else or more.
template <class T>
bool VtkXmlDecoder::read_plain_numbers(const XmlElement& array, std::uint64_t count, MemoryBlock& numbers) {
  const std::size_t size_before = numbers.size();
  auto* const values = reinterpret_cast<T*>(numbers.extend(count * sizeof(T)));
  PlainRows rows(text_of(array), workers_);
  const auto end = rows.read(0, count, 1, [values](PlainNumbers& text, std::size_t first, std::size_t last) {
    return std::all_of(values + first, values + last, [&text](T& value) { return text.next(value); });
  });
  std::string_view rest = text_of(array).substr(end ? end->offset : 0);
  if (!end || !take_token(rest).empty()) {
    numbers.truncate(size_before);
    return false;
  }
  return true;
}

template <class T>
void VtkXmlDecoder::read_text_numbers(const XmlElement& array, std::optional<std::uint64_t> count, MemoryBlock& numbers,
                                      Surplus surplus) {
  std::string_view text = text_of(array);
  const std::uint64_t most = text.size() / 2 + 1;
  if (count && *count > most) {
    fail(array, "should hold " + counted(*count) + " numbers, but has room for " + counted(most) + " at most");
  }
  if (count) {
    numbers.reserve_more(*count * sizeof(T));
    if (read_plain_numbers<T>(array, *count, numbers)) {
      return;
    }
  }
  std::uint64_t read = 0;
  for (std::string_view token = take_token(text); !token.empty(); token = take_token(text)) {
    const std::optional<T> value = parse<T>(token);
    if (!value) {
      fail_at(array, token.data(), "expected a number of its type, got " + trismooth::quoted(token));
    }
    if (count && read >= *count) {
      if (read == *count) {
        take_surplus(array, token.data(), surplus, counted(read) + " numbers");
      }
      ++read;
      continue;
    }
    std::memcpy(numbers.extend(sizeof(T)), &*value, sizeof(T));
    ++read;
  }
  if (count && read < *count) {
    fail(array, "holds " + counted(read) + " numbers, expected " + counted(*count));
  }
}

void VtkXmlDecoder::read_numbers(const XmlElement& array, ScalarType type, std::optional<std::uint64_t> count,
                                 MemoryBlock& numbers, Surplus surplus) {
  if (count == 0) {
    return expect_empty(array);
  }
  if (vtk_xml_mode_of(path_, array) == VtkXmlMode::ascii) {
    visit_scalar_type(type, [&](auto zero) { read_text_numbers<decltype(zero)>(array, count, numbers, surplus); });
    return;
  }
  const std::size_t word_size = size_of(type);
  read_bytes(array, word_size, count ? std::optional(saturating_product(*count, word_size)) : std::nullopt, numbers,
             surplus);
}

void VtkXmlDecoder::read_bits(const XmlElement& array, std::uint64_t count, MemoryBlock& bits) {
  if (count == 0) {
    return expect_empty(array);
  }
  if (vtk_xml_mode_of(path_, array) == VtkXmlMode::ascii) {
    const std::size_t begin = bits.size();
    read_text_numbers<std::uint8_t>(array, count, bits, Surplus::noted);
    if (std::any_of(bits.data() + begin, bits.data() + bits.size(), [](std::byte bit) { return bit > std::byte{1}; })) {
      fail(array, "holds a number that is not a bit");
    }
    return;
  }
  MemoryBlock packed;
  read_bytes(array, 1, count / 8 + (count % 8 == 0 ? 0 : 1), packed);
  std::byte* const unpacked = bits.extend(count);
  for (std::size_t i = 0; i < count; ++i) {
    unpacked[i] = (packed.data()[i / 8] >> (7 - i % 8)) & std::byte{1};
  }
}

void VtkXmlDecoder::read_strings(const XmlElement& array, std::uint64_t count, std::vector<std::string>& strings) {
  if (count == 0) {
    return expect_empty(array);
  }
  MemoryBlock characters;
  if (vtk_xml_mode_of(path_, array) == VtkXmlMode::ascii) {
    MemoryBlock codes;
    read_text_numbers<std::int16_t>(array, std::nullopt, codes, Surplus::noted);
    const std::size_t length = codes.size() / sizeof(std::int16_t);
    std::byte* const target = characters.extend(length);
    for (std::size_t i = 0; i < length; ++i) {
      std::int16_t code = 0;
      std::memcpy(&code, codes.data() + i * sizeof(code), sizeof(code));
      if (code < -128 || code > 255) {
        fail(array, "holds the character code " + std::to_string(code));
      }
      target[i] = static_cast<std::byte>(code);
    }
  } else {
    read_bytes(array, 1, std::nullopt, characters);
  }
  const std::string_view all(reinterpret_cast<const char*>(characters.data()), characters.size());
  const auto found = static_cast<std::uint64_t>(std::ranges::count(all, '\0'));
  const std::size_t wanted = strings.size() + count;
  if (found < count || all.back() != '\0') {
    fail(array, "holds " + counted(found) + " strings, expected " + counted(count));
  }
  if (found > count) {
    take_surplus(array, text_of(array).data(), Surplus::noted, counted(count) + " strings");
  }
  for (std::size_t begin = 0; strings.size() < wanted;) {
    const std::size_t end = all.find('\0', begin);
    strings.emplace_back(all.substr(begin, end - begin));
    begin = end + 1;
  }
}

}  // namespace trismooth
