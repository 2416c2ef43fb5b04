// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/netcdf/netcdf_writer.h"

#include <array>
#include <memory>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"

namespace trismooth {

namespace {

constexpr std::size_t padded(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

/// The parts of a header, in its byte order.
class HeaderText {
 public:
  explicit HeaderText(char version) : version_(version), text_({'C', 'D', 'F', version}) {}

  template <class T>
  void number(T value) {
    const T stored = in_byte_order<std::endian::big>(value);
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &stored, sizeof(T));
    text_.append(bytes.data(), bytes.size());
  }

  void count(std::size_t value) {
    if (version_ == 5) {
      number(static_cast<std::uint64_t>(value));
    } else {
      number(static_cast<std::uint32_t>(std::min<std::size_t>(value, 0xFFFFFFFF)));
    }
  }

  void filled(std::string_view bytes) {
    text_ += bytes;
    text_.append(padded(bytes.size()) - bytes.size(), '\0');
  }

  void name(std::string_view name) {
    count(name.size());
    filled(name);
  }

  void begin_list(std::uint32_t tag, std::size_t items) {
    number(items == 0 ? std::uint32_t{0} : tag);
    count(items);
  }

  void type(NetcdfType type) { number(static_cast<std::uint32_t>(type)); }

  void attribute(const NetcdfAttribute& attribute, NetcdfType type) {
    name(attribute.name);
    this->type(type);
    if (type == NetcdfType::text) {
      name(attribute.text);
      return;
    }
    count(attribute.numbers.size());
    for (const double value : attribute.numbers) {
      if (type == NetcdfType::int32) {
        number(static_cast<std::int32_t>(value));
      } else {
        number(static_cast<float>(value));
      }
    }
  }

  const std::string& text() const { return text_; }

 private:
  char version_;
  std::string text_;
};

}  // namespace

std::size_t NetcdfWriter::add_dimension(std::string name, std::size_t length) {
  content_.dimensions.push_back({std::move(name), length, false});
  return content_.dimensions.size() - 1;
}

std::size_t NetcdfWriter::add_record_dimension(std::string name, bool is_empty) {
  content_.dimensions.push_back({std::move(name), is_empty ? 0U : 1U, true});
  return content_.dimensions.size() - 1;
}

void NetcdfWriter::add_attribute(std::string name, std::string text) {
  content_.attributes.push_back({std::move(name), std::move(text), {}});
  attribute_types_.push_back(NetcdfType::text);
}

void NetcdfWriter::add_attribute(std::string name, NetcdfType type, double number) {
  content_.attributes.push_back({std::move(name), {}, {number}});
  attribute_types_.push_back(type);
}

void NetcdfWriter::add(std::string name, NetcdfType type, std::vector<std::size_t> dimensions,
                       std::vector<NetcdfAttribute> attributes, Fill fill) {
  NetcdfVariable& variable = content_.variables.emplace_back();
  variable.name = std::move(name);
  variable.type = type;
  variable.has_records = !dimensions.empty() && content_.dimensions[dimensions.front()].is_record;
  variable.dimensions = std::move(dimensions);
  variable.attributes = std::move(attributes);
  fills_.push_back(std::move(fill));
}

void NetcdfWriter::add_texts(std::string name, std::vector<std::size_t> dimensions, std::vector<std::string> texts) {
  const std::size_t length = content_.dimensions[dimensions.back()].length;
  const auto characters = std::make_shared<std::string>();
  for (std::string& text : texts) {
    text.resize(length);
    *characters += text;
  }
  add(std::move(name), NetcdfType::text, std::move(dimensions), {},
      [characters](std::size_t begin, std::size_t end, std::byte* target) {
        std::memcpy(target, characters->data() + begin, end - begin);
      });
}

std::size_t NetcdfWriter::values_of(const NetcdfVariable& variable) const {
  std::size_t values = 1;
  for (const std::size_t dimension : variable.dimensions) {
    values *= content_.dimensions[dimension].is_record ? 1 : content_.dimensions[dimension].length;
  }
  return values;
}

std::string NetcdfWriter::header(char version, std::size_t begin_of_values) const {
  HeaderText text(version);
  const auto has_record = [](const NetcdfDimension& dimension) { return dimension.is_record && dimension.length > 0; };
  text.count(std::ranges::count_if(content_.dimensions, has_record) > 0 ? 1 : 0);
  text.begin_list(10, content_.dimensions.size());
  for (const NetcdfDimension& dimension : content_.dimensions) {
    text.name(dimension.name);
    text.count(dimension.is_record ? 0 : dimension.length);
  }
  text.begin_list(12, content_.attributes.size());
  for (std::size_t i = 0; i < content_.attributes.size(); ++i) {
    text.attribute(content_.attributes[i], attribute_types_[i]);
  }
  text.begin_list(11, content_.variables.size());
  std::size_t begin = begin_of_values;
  for (const NetcdfVariable& variable : content_.variables) {
    text.name(variable.name);
    text.count(variable.dimensions.size());
    for (const std::size_t dimension : variable.dimensions) {
      text.count(dimension);
    }
    text.begin_list(12, variable.attributes.size());
    for (const NetcdfAttribute& attribute : variable.attributes) {
      text.attribute(attribute, attribute.numbers.empty() ? NetcdfType::text : NetcdfType::int32);
    }
    text.type(variable.type);
    const std::size_t bytes = padded(size_of(variable.type) * values_of(variable));
    text.count(bytes);
    text.number(static_cast<std::uint64_t>(begin));
    begin += bytes;
  }
  return text.text();
}

void NetcdfWriter::write(const std::filesystem::path& path, const FileWorkers& workers) const {
  constexpr std::size_t most = (std::size_t{1} << 31) - 4;
  const bool is_large = std::ranges::any_of(content_.variables, [this](const NetcdfVariable& variable) {
    return size_of(variable.type) * values_of(variable) > most;
  });
  const char version = is_large ? 5 : 2;
  BufferedWriter writer(path);
  writer.write(header(version, header(version, 0).size()));
  OrderedBlocks blocks([&writer](std::string_view bytes) { writer.write(bytes); }, workers);
  for (std::size_t i = 0; i < fills_.size(); ++i) {
    const std::size_t each = size_of(content_.variables[i].type);
    const NetcdfVariable& variable = content_.variables[i];
    if (variable.has_records && content_.dimensions[variable.dimensions.front()].length == 0) {
      continue;
    }
    const std::size_t values = values_of(variable);
    blocks.write_rows(values, each, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
      fills_[i](begin, end, bytes.extend(each * (end - begin)));
    });
    blocks.write(std::string_view("\0\0\0", padded(each * values) - each * values));
  }
  writer.close();
}

}  // namespace trismooth
