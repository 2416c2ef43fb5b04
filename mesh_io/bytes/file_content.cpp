// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/file_content.h"

#include <array>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/compressed_file.h"
#include "trismooth/mesh_io/bytes/gzip.h"
#include "trismooth/mesh_io/bytes/memory_file.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/bytes/standard_output.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/file_format.h"
#include "trismooth/mesh_io/standard_streams.h"

namespace trismooth {

namespace {

void decompress(FileContent& content) {
  try {
    content.bytes = FileBytes(gunzip(content.name, content.bytes));
  } catch (const std::bad_alloc&) {
    throw ReadError(content.name, "is too large for the memory of this machine, decompressed");
  }
  content.is_plain_file = false;
}

void write_compressed(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers) {
  BufferedWriter writer(path);
  write_gzip(
      bytes, [&writer](std::string_view part) { writer.write(part); }, workers);
  writer.close();
}

}  // namespace

FileContent read_content(const std::filesystem::path& path, const FileWorkers& workers) {
  const bool is_stream = is_standard_stream(path);
  FileContent content;
  content.name = shown_input(path);
  content.bytes = is_stream ? read_standard_input() : read_file_bytes(path, workers);
  content.is_plain_file = !is_stream;
  if (is_gzip(content.bytes)) {
    decompress(content);
    if (!is_stream && !names_gzip(path)) {
      content.note = "the file is compressed by gzip, which its name does not say";
    }
  } else if (names_gzip(path)) {
    throw ReadError(path, "is not compressed by gzip, as its name says; where it is a mesh as it is, leave out '.gz'");
  }
  if (const auto compression = compression_of(content.bytes)) {
    throw ReadError(content.name, describe(*compression));
  }
  return content;
}

WrittenAside::WrittenAside(std::vector<std::unique_ptr<OutputFile>> files) : files_(std::move(files)) {}

WrittenAside::WrittenAside(std::unique_ptr<MemoryFile> stream) : stream_(std::move(stream)) {}

WrittenAside::WrittenAside(WrittenAside&& other) noexcept = default;
WrittenAside& WrittenAside::operator=(WrittenAside&& other) noexcept = default;
WrittenAside::~WrittenAside() = default;

void WrittenAside::commit() {
  if (stream_ != nullptr) {
    write_standard_output(stream_->view());
    stream_.reset();
  }
  try {
    for (const std::unique_ptr<OutputFile>& file : files_) {
      file->commit();
    }
  } catch (const WriteError&) {
    take_back();
    throw;
  }
}

void WrittenAside::commit_before(const std::function<void()>& next) {
  commit();
  if (next) {
    try {
      next();
    } catch (...) {
      take_back();
      throw;
    }
  }
}

void WrittenAside::take_back() noexcept {
  for (const std::unique_ptr<OutputFile>& file : files_) {
    file->take_back();
  }
}

std::vector<std::filesystem::path> WrittenAside::others(const std::filesystem::path& path) const {
  std::vector<std::filesystem::path> names;
  for (const std::unique_ptr<OutputFile>& file : files_) {
    if (file->given() != path) {
      names.push_back(file->given());
    }
  }
  return names;
}

WrittenAside write_content_aside(const std::filesystem::path& path, const FileWorkers& workers,
                                 const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path name = shown_output(path);
  std::vector<std::unique_ptr<OutputFile>> files;
  try {
    if (is_standard_stream(path)) {
      auto plain = std::make_unique<MemoryFile>(name);
      write(plain->path());
      return WrittenAside(std::move(plain));
    }
    OutputFile& output = *files.emplace_back(std::make_unique<OutputFile>(path));
    if (names_gzip(path)) {
      MemoryFile plain(name);
      write(plain.path());
      write_compressed(output.path(), plain.view(), workers);
    } else {
      write(output.path());
    }
    output.prepare();
  } catch (const WriteError& error) {
    // Codecs know the temporary file only.
    throw WriteError(name, error.reason);
  }
  return WrittenAside(std::move(files));
}

namespace {

constexpr const char* needs_plain_files = "the mesh is several files, which are written as plain files, uncompressed";

void require_plain_name(const std::filesystem::path& path) {
  if (is_standard_stream(path)) {
    throw WriteError(shown_output(path),
                     std::string(needs_plain_files) + ": give the output a name, or another format by --format NAME");
  }
  if (names_gzip(path)) {
    throw WriteError(path, std::string(needs_plain_files) + ": leave out '.gz'");
  }
}

std::vector<std::unique_ptr<OutputFile>> open_files(std::span<const std::filesystem::path> names) {
  std::vector<std::unique_ptr<OutputFile>> files;
  for (const std::filesystem::path& name : names) {
    if (files.emplace_back(std::make_unique<OutputFile>(name))->is_direct()) {
      throw WriteError(name, needs_plain_files);
    }
  }
  return files;
}

/// Codecs know the temporary file only.
void write_file(const OutputFile& file, const std::filesystem::path& name,
                const std::function<void(const std::filesystem::path&)>& write) {
  try {
    write(file.path());
  } catch (const WriteError& error) {
    throw WriteError(name, error.reason);
  }
}

WrittenAside prepared(std::vector<std::unique_ptr<OutputFile>> files) {
  for (const std::unique_ptr<OutputFile>& file : files) {
    file->prepare();
  }
  return WrittenAside(std::move(files));
}

}  // namespace

WrittenAside write_files_aside(const std::filesystem::path& path, const std::vector<std::filesystem::path>& others,
                               const std::function<void(const std::filesystem::path&)>& write) {
  require_plain_name(path);
  std::vector<std::filesystem::path> names = others;
  names.push_back(path);  // last: it names the others
  std::vector<std::unique_ptr<OutputFile>> files = open_files(names);
  write_file(*files.back(), path, write);
  return prepared(std::move(files));
}

WrittenAside write_two_files_aside(const std::filesystem::path& path,
                                   std::filesystem::path (*partner_of)(const std::filesystem::path& path),
                                   const std::function<void(const std::filesystem::path&)>& write) {
  require_plain_name(path);
  const std::array names{path, partner_of(path)};
  std::vector<std::unique_ptr<OutputFile>> files = open_files(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    write_file(*files[i], names.at(i), write);
  }
  return prepared(std::move(files));
}

}  // namespace trismooth
