#include "trismooth/mesh_io/ranges/msh_range.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/binary_numbers.h"
#include "trismooth/mesh_io/bytes/input_file.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_entities.h"
#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/msh/msh_reader.h"
#include "trismooth/mesh_io/text/blanks.h"

namespace trismooth {

namespace {

constexpr std::uint64_t most_blocks = 100'000;  // each is looked at by itself
constexpr std::size_t msh_point_bytes = 3 * sizeof(double);

/// Of what is in both.
NumberRange common(NumberRange a, NumberRange b) {
  const std::uint64_t first = std::max(a.first, b.first);
  return {first, std::max(first, std::min(a.last, b.last))};
}

std::uint64_t count_of(NumberRange range) {
  return range.last - range.first;
}

}  // namespace

class MshRanges::Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : file_(path) {
    read_head();
    read_node_blocks();
    pass_section("$EndNodes", "$Elements");
    read_element_blocks();
    pass_section("$EndElements", {});
    first_node_ = points_ > 0 ? tag_at(nodes_.front().tags) : 0;
    first_element_ = cells_ > 0 ? tag_at(first_of(elements_).rows) : 0;
  }

  std::uint64_t point_count() const { return points_; }
  std::uint64_t cell_count() const { return cells_; }
  bool may_repeat_elements() const { return !is_4(); }

  MeshDocument read(NumberRange points, NumberRange cells, const FileWorkers& workers) const {
    // Elements of the file that is made of the range all have its first node, so it needs one.
    const bool has_points = points.first < points.last;
    const NumberRange nodes = has_points ? points : NumberRange{0, 1};
    if (points_ == 0 || points.last > points_ || cells.last > cells_) {
      give_up("it has not these points and cells");
    }
    MemoryBlock made;
    append(made, head_);
    append_nodes(made, nodes);
    std::vector<std::int32_t> corners;
    append_elements(made, cells, first_node_ + static_cast<std::int64_t>(nodes.first), corners);
    MshLayout layout;
    const FileBytes bytes(std::move(made));
    MeshDocument document = read_msh(file_.path(), bytes, workers, layout);
    if (document.cells.size() != count_of(cells) || document.cells.connectivity.size() != corners.size() ||
        !document.cell_sets.empty()) {
      give_up("it lists elements again");
    }
    document.cells.connectivity = std::move(corners);
    if (!has_points) {
      document.points.clear();
    }
    set_implied_sets(document, points);
    return document;
  }

 private:
  /// Of nodes of one entity; a list of version 2 is one.
  struct NodeBlock {
    std::int32_t dimension = -1;
    std::int32_t entity = 0;
    std::int32_t parametric = 0;
    NumberRange numbers{};   ///< of the points
    std::uint64_t tags = 0;  ///< where they begin in the file; of version 2 they are in the rows
    std::uint64_t rows = 0;  ///< where rows begin
    std::size_t row_bytes = 0;
  };

  /// Of elements of one type.
  struct ElementBlock {
    std::int32_t dimension = 0;
    std::int32_t entity = 0;
    std::int32_t type = 0;
    std::int32_t labels = 0;  ///< of version 2: numbers between an element's tag and its nodes
    NumberRange numbers{};    ///< of the cells
    std::uint64_t rows = 0;
    std::size_t row_bytes = 0;
  };

  [[noreturn]] void give_up(const char* what) const {
    throw ReadError(file_.path(), std::string("is not read by ranges: ") + what);
  }

  bool is_4() const { return header_.version >= 40; }
  std::size_t tag_size() const { return is_4() ? sizeof(std::int64_t) : sizeof(std::int32_t); }

  template <class T>
  T number_at(std::uint64_t offset) const {
    const FileBytes bytes = file_.read_range(offset, offset + sizeof(T));
    T value{};
    if (!BinaryNumbers(bytes, 0, header_.swapped).next(value)) {
      give_up("it is cut off");
    }
    return value;
  }

  std::int64_t tag_at(std::uint64_t offset) const {
    return is_4() ? number_at<std::int64_t>(offset) : number_at<std::int32_t>(offset);
  }

  template <class Block>
  static const Block& first_of(const std::vector<Block>& blocks) {
    return *std::ranges::find_if(blocks, [](const Block& block) { return count_of(block.numbers) > 0; });
  }

  /// Everything before the line $Nodes, and where the nodes begin.
  void read_head() {
    constexpr std::size_t first_bytes = std::size_t{1} << 16;
    constexpr std::size_t most_bytes = std::size_t{1} << 26;
    for (std::size_t count = first_bytes;; count *= 8) {
      const FileBytes bytes = file_.read_range(0, count);
      try {
        parse_head(bytes);
        return;
      } catch (const ReadError&) {
        if (count >= most_bytes || bytes.size() < count) {
          throw;
        }
      }
    }
  }

  void parse_head(std::string_view bytes) {
    MshInput input(bytes, file_.path());
    TextScanner& text = input.text();
    if (trimmed(text.next_line()) != "$MeshFormat") {
      give_up("it begins with another section");
    }
    input.read_header();
    header_ = input.header();
    const bool is_known = header_.version == 41 ? header_.size_bytes == sizeof(std::int64_t)
                                                : header_.version >= 20 && header_.version <= 22;
    if (!header_.binary || !is_known) {
      give_up("it is text, or of another version");
    }
    std::string_view section = "$MeshFormat";
    for (;;) {
      if (section != "$MeshFormat" && section != "$Entities") {
        const std::size_t end = bytes.find("\n$End" + std::string(section.substr(1)), text.offset());
        if (end == bytes.npos) {
          give_up("a section has no end");
        }
        text.seek(end);
      }
      if (text.next_token("the end of a section") != "$End" + std::string(section.substr(1))) {
        give_up("a section has another end");
      }
      text.next_line();
      section = text.next_token("a section");
      const std::size_t begin = text.token_offset();
      text.next_line();
      if (section == "$Nodes") {
        head_.assign(bytes.substr(0, begin));
        at_ = text.offset();
        return;
      }
      if (section == "$Entities" && is_4()) {
        MshEntities().read(input, false);
      } else if (section != "$PhysicalNames" && section != "$Comments") {
        give_up("it has other sections");
      }
    }
  }

  /// The number in the line at at_, which ends there.
  std::uint64_t text_count() {
    constexpr std::size_t line_bytes = 64;
    const FileBytes bytes = file_.read_range(at_, at_ + line_bytes);
    TextScanner text(bytes, file_.path());
    const std::int64_t count = text.next_integer("a number", 0, largest_msh_int);
    text.next_line();
    at_ += text.offset();
    return static_cast<std::uint64_t>(count);
  }

  std::uint64_t next_size() {
    const auto value = number_at<std::int64_t>(at_);
    at_ += sizeof(value);
    if (value < 0) {
      give_up("a count is negative");
    }
    return static_cast<std::uint64_t>(value);
  }

  std::int32_t next_int() {
    const auto value = number_at<std::int32_t>(at_);
    at_ += sizeof(value);
    return value;
  }

  /// Passes so many rows.
  void pass(std::uint64_t count, std::size_t row_bytes) {
    if (at_ > file_.size() || count > (file_.size() - at_) / row_bytes) {
      give_up("it is cut off");
    }
    at_ += count * row_bytes;
  }

  void read_node_blocks() {
    if (!is_4()) {
      points_ = text_count();
      NodeBlock block{.numbers = {0, points_}, .tags = at_, .rows = at_, .row_bytes = tag_size() + msh_point_bytes};
      pass(points_, block.row_bytes);
      nodes_.push_back(block);
      return;
    }
    const std::uint64_t blocks = next_size();
    points_ = next_size();
    next_size();
    next_size();
    if (blocks > most_blocks || points_ > static_cast<std::uint64_t>(largest_msh_int)) {
      give_up("it has many blocks");
    }
    std::uint64_t done = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      NodeBlock block;
      block.dimension = next_int();
      block.entity = next_int();
      block.parametric = next_int();
      const std::uint64_t count = next_size();
      if (block.dimension < 0 || block.dimension > 3 || block.parametric < 0 || block.parametric > 1 ||
          count > points_ - done) {
        give_up("the head of a block is wrong");
      }
      const auto parameters = static_cast<std::size_t>(block.parametric == 1 ? block.dimension : 0);
      block.row_bytes = msh_point_bytes + parameters * sizeof(double);
      block.numbers = {done, done + count};
      done += count;
      block.tags = at_;
      pass(count, tag_size());
      block.rows = at_;
      pass(count, block.row_bytes);
      has_surfaces_ = has_surfaces_ || (block.dimension > 1 && count > 0);
      if (count > 0) {
        nodes_.push_back(block);
      }
    }
    if (done != points_) {
      give_up("nodes are missing");
    }
  }

  void read_element_blocks() {
    std::uint64_t blocks = 0;
    if (is_4()) {
      blocks = next_size();
      cells_ = next_size();
      next_size();
      next_size();
    } else {
      cells_ = text_count();
    }
    if (blocks > most_blocks || cells_ > static_cast<std::uint64_t>(largest_msh_int)) {
      give_up("it has many blocks");
    }
    for (std::uint64_t done = 0, b = 0; is_4() ? b < blocks : done < cells_; ++b) {
      ElementBlock block;
      if (is_4()) {
        block.dimension = next_int();
        block.entity = next_int();
      }
      block.type = next_int();
      const std::uint64_t count = is_4() ? next_size() : static_cast<std::uint64_t>(std::max(next_int(), 0));
      block.labels = is_4() ? 0 : next_int();
      const std::size_t vertices = msh_element_type(block.type).vertices;
      if (vertices == 0 || count > cells_ - done || block.labels < 0 || b > most_blocks) {
        give_up("the head of a block is wrong, or there are many");
      }
      block.row_bytes = tag_size() * (1 + vertices) + static_cast<std::size_t>(block.labels) * sizeof(std::int32_t);
      block.numbers = {done, done + count};
      done += count;
      block.rows = at_;
      pass(count, block.row_bytes);
      if (count > 0) {
        elements_.push_back(block);
      }
      if (is_4() && b + 1 == blocks && done != cells_) {
        give_up("elements are missing");
      }
    }
  }

  /// At at_ a section ends, and that one begins; with none the file ends.
  void pass_section(std::string_view end, std::string_view begin) {
    constexpr std::size_t line_bytes = 64;
    const FileBytes bytes = file_.read_range(at_, at_ + line_bytes);
    TextScanner text(bytes, file_.path());
    if (text.next_token(end) != end) {
      give_up("a section is longer than it says");
    }
    text.next_line();
    if (begin.empty()) {
      if (!text.at_end() || at_ + bytes.size() < file_.size()) {
        give_up("it has other sections");
      }
      return;
    }
    if (text.next_token(begin) != begin) {
      give_up("it has other sections");
    }
    text.next_line();
    at_ += text.offset();
  }

  static void append(MemoryBlock& made, std::string_view bytes) {
    if (!bytes.empty()) {
      std::memcpy(made.extend(bytes.size()), bytes.data(), bytes.size());
    }
  }

  template <class T>
  void append_number(MemoryBlock& made, T value) const {
    store(made.extend(sizeof(T)), value);
  }

  /// In the byte order of the file.
  template <class T>
  void store(std::byte* target, T value) const {
    std::memcpy(target, &value, sizeof(T));
    if (header_.swapped) {
      std::reverse(target, target + sizeof(T));
    }
  }

  void append_tag(MemoryBlock& made, std::int64_t tag) const {
    if (is_4()) {
      append_number(made, tag);
    } else {
      append_number(made, static_cast<std::int32_t>(tag));
    }
  }

  FileBytes rows_of(std::uint64_t begin, std::uint64_t first, std::uint64_t count, std::size_t row_bytes) const {
    FileBytes bytes = file_.read_range(begin + first * row_bytes, begin + (first + count) * row_bytes);
    if (bytes.size() != count * row_bytes) {
      give_up("it is cut off");
    }
    return bytes;
  }

  /// Throws unless the tags, one in every `step` bytes, count on from `tag`.
  void require_run(std::string_view bytes, std::size_t step, std::int64_t tag) const {
    for (std::size_t at = 0; at < bytes.size(); at += step, ++tag) {
      BinaryNumbers numbers(bytes, at, header_.swapped);
      std::int64_t found = 0;
      std::int32_t narrow = 0;
      const bool is_read = is_4() ? numbers.next(found) : numbers.next(narrow);
      if (!is_read || (is_4() ? found : narrow) != tag) {
        give_up("its tags do not count on");
      }
    }
  }

  void append_nodes(MemoryBlock& made, NumberRange range) const {
    append(made, "$Nodes\n");
    MemoryBlock blocks;
    std::int64_t block_count = 0;
    for (const NodeBlock& block : nodes_) {
      const NumberRange here = common(range, block.numbers);
      const std::uint64_t count = count_of(here);
      if (count == 0) {
        continue;
      }
      ++block_count;
      const std::uint64_t first = here.first - block.numbers.first;
      const std::int64_t tag = first_node_ + static_cast<std::int64_t>(here.first);
      const FileBytes rows = rows_of(block.rows, first, count, block.row_bytes);
      if (is_4()) {
        const FileBytes tags = rows_of(block.tags, first, count, tag_size());
        require_run(tags, tag_size(), tag);
        append_number(blocks, block.dimension);
        append_number(blocks, block.entity);
        append_number(blocks, block.parametric);
        append_number(blocks, static_cast<std::int64_t>(count));
        append(blocks, tags);
      } else {
        require_run(rows, block.row_bytes, tag);
      }
      append(blocks, rows);
    }
    append_counts(made, block_count, static_cast<std::int64_t>(count_of(range)));
    append(made, {reinterpret_cast<const char*>(blocks.data()), blocks.size()});
    append(made, "\n$EndNodes\n");
  }

  void append_counts(MemoryBlock& made, std::int64_t blocks, std::int64_t count) const {
    if (!is_4()) {
      append(made, std::to_string(count) + "\n");
      return;
    }
    append_number(made, blocks);
    append_number(made, count);
    append_number(made, std::int64_t{1});
    append_number(made, count);
  }

  /// With that node as all corners; those that they have go to `corners`.
  void append_elements(MemoryBlock& made, NumberRange range, std::int64_t node,
                       std::vector<std::int32_t>& corners) const {
    append(made, "$Elements\n");
    const std::ptrdiff_t block_count = std::ranges::count_if(
        elements_, [&](const ElementBlock& block) { return count_of(common(range, block.numbers)) > 0; });
    append_counts(made, block_count, static_cast<std::int64_t>(count_of(range)));
    for (const ElementBlock& block : elements_) {
      const NumberRange here = common(range, block.numbers);
      const std::uint64_t count = count_of(here);
      if (count == 0) {
        continue;
      }
      if (is_4()) {
        append_number(made, block.dimension);
        append_number(made, block.entity);
        append_number(made, block.type);
        append_number(made, static_cast<std::int64_t>(count));
      } else {
        append_number(made, block.type);
        append_number(made, static_cast<std::int32_t>(count));
        append_number(made, block.labels);
      }
      const FileBytes rows = rows_of(block.rows, here.first - block.numbers.first, count, block.row_bytes);
      require_run(rows, block.row_bytes, first_element_ + static_cast<std::int64_t>(here.first));
      append_rows(made, rows, block, node, corners);
    }
    append(made, "\n$EndElements\n");
  }

  void append_rows(MemoryBlock& made, std::string_view rows, const ElementBlock& block, std::int64_t node,
                   std::vector<std::int32_t>& corners) const {
    const MshElementType& type = msh_element_type(block.type);
    const std::size_t front = block.row_bytes - type.vertices * tag_size();
    for (std::size_t at = 0; at < rows.size(); at += block.row_bytes) {
      append(made, rows.substr(at, front));
      BinaryNumbers numbers(rows, at + front, header_.swapped);
      const std::size_t first = corners.size();
      corners.resize(first + type.vertices);
      for (std::size_t i = 0; i < type.vertices; ++i) {
        std::int64_t tag = 0;
        std::int32_t narrow = 0;
        const bool is_read = is_4() ? numbers.next(tag) : numbers.next(narrow);
        const std::uint64_t corner =
            static_cast<std::uint64_t>(is_4() ? tag : narrow) - static_cast<std::uint64_t>(first_node_);
        if (!is_read || corner >= points_) {
          give_up("an element has a node that is not there");
        }
        corners[first + (type.places.empty() ? i : type.places[i])] = static_cast<std::int32_t>(corner);
        append_tag(made, node);
      }
    }
  }

  /// Those of the points of the range, as the whole file has them.
  void set_implied_sets(MeshDocument& document, NumberRange points) const {
    document.implied_sets.clear();
    if (!has_surfaces_) {
      return;
    }
    for (const std::int32_t dimension : {0, 1}) {
      std::vector<std::int32_t> members;
      for (const NodeBlock& block : nodes_) {
        const NumberRange here = common(points, block.numbers);
        for (std::uint64_t p = here.first; p < here.last && block.dimension == dimension; ++p) {
          members.push_back(static_cast<std::int32_t>(p - points.first));
        }
      }
      if (!members.empty()) {
        document.implied_sets.push_back(
            {std::string(dimension == 0 ? points_of_geometry : curves_of_geometry), std::move(members)});
      }
    }
  }

  InputFile file_;
  MshHeader header_;
  std::string head_;
  std::uint64_t at_ = 0;
  std::uint64_t points_ = 0;
  std::uint64_t cells_ = 0;
  std::vector<NodeBlock> nodes_;
  std::vector<ElementBlock> elements_;
  bool has_surfaces_ = false;  ///< nodes of surfaces or volumes
  std::int64_t first_node_ = 0;
  std::int64_t first_element_ = 0;
};

MshRanges::MshRanges(const std::filesystem::path& path) : reader_(std::make_unique<Reader>(path)) {}
MshRanges::~MshRanges() = default;

std::uint64_t MshRanges::point_count() const {
  return reader_->point_count();
}

std::uint64_t MshRanges::cell_count() const {
  return reader_->cell_count();
}

bool MshRanges::may_repeat_elements() const {
  return reader_->may_repeat_elements();
}

MeshDocument MshRanges::read(NumberRange points, NumberRange cells, const FileWorkers& workers) const {
  return reader_->read(points, cells, workers);
}

}  // namespace trismooth
