// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_changes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/byte_order.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_child.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// The memory that HDF5 works in, which is this object's: a file that is closed there is whole, other than an image
/// that HDF5 hands out of one that is open.
struct Hdf5Image {
  explicit Hdf5Image(std::string_view all) : bytes(all), size(all.size()) {}

  std::string bytes;  ///< longer than the file, at times
  std::size_t size;

  /// Gives the memory, with room for `wanted` bytes; null where there is not as much.
  static void* grow(void*, std::size_t wanted, H5FD_file_image_op_t, void* image) {
    std::string& bytes = static_cast<Hdf5Image*>(image)->bytes;
    try {
      bytes.resize(std::max(bytes.size(), wanted));
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
    return bytes.data();
  }
  static void* give(std::size_t, H5FD_file_image_op_t, void* image) {
    return static_cast<Hdf5Image*>(image)->bytes.data();
  }
  static void* copy_nothing(void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) { return to; }
  static herr_t free_nothing(void*, H5FD_file_image_op_t, void*) { return 0; }
  static void* same(void* image) { return image; }
  static herr_t keep(void*) { return 0; }
};

void overwrite(const Hdf5Handle& file, const std::string& dataset, const std::vector<double>& values) {
  const Hdf5Handle at(H5Dopen2(file.get(), dataset.c_str(), H5P_DEFAULT), &H5Dclose);
  const Hdf5Handle space(at.is_valid() ? H5Dget_space(at.get()) : -1, &H5Sclose);
  if (!space.is_valid() || H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(values.size()) ||
      H5Dwrite(at.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw Hdf5Refusal(quoted(std::string_view(dataset)) + " cannot be written" + hdf5_reason());
  }
}

/// In a child: answers with the whole file.
void serve_changed(std::string_view bytes, const Hdf5Values& values, const Hdf5Channel& channel) {
  try {
    Hdf5Image image(bytes);
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
    H5FD_file_image_callbacks_t callbacks{&Hdf5Image::give,
                                          &Hdf5Image::copy_nothing,
                                          &Hdf5Image::grow,
                                          &Hdf5Image::free_nothing,
                                          &Hdf5Image::same,
                                          &Hdf5Image::keep,
                                          &image};
    H5Pset_fapl_core(access.get(), std::size_t{1} << 16, false);
    H5Pset_file_image_callbacks(access.get(), &callbacks);
    H5Pset_file_image(access.get(), image.bytes.data(), image.size);
    Hdf5Handle file(H5Fopen("trismooth file", H5F_ACC_RDWR, access.get()), &H5Fclose);
    if (!file.is_valid()) {
      throw Hdf5Refusal("cannot be opened by HDF5" + hdf5_reason());
    }
    for (const auto& [dataset, of_dataset] : values) {
      overwrite(file, dataset, of_dataset);
    }
    const ssize_t size = H5Fflush(file.get(), H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(file.get(), nullptr, 0);
    if (size < 0 || !file.close()) {
      throw Hdf5Refusal("cannot be written by HDF5" + hdf5_reason());
    }
    // What stands behind the end of HDF5's part stays.
    channel.answer(std::string_view(image.bytes).substr(0, std::max(image.size, static_cast<std::size_t>(size))));
  } catch (const Hdf5Refusal& refusal) {
    channel.refuse(refusal.what());
  } catch (const std::bad_alloc&) {
    channel.refuse("more memory is needed than there is");
  }
}

/// Writes the values where they stand in `bytes`. False where the library has to.
bool patch(MemoryBlock& bytes, const Hdf5Reader& reader, const std::string& dataset,
           const std::vector<double>& values) {
  const std::optional<Hdf5Place> place = reader.place_of(dataset);
  const Hdf5Shape shape = reader.shape_of(dataset);
  if (!place || shape.count() != values.size()) {
    return false;
  }
  return visit_scalar_type(*shape.type, [&](auto number) {
    using T = decltype(number);
    if constexpr (std::is_floating_point_v<T>) {
      const bool is_swapped = place->is_big_endian == (std::endian::native == std::endian::little);
      std::byte* at = bytes.data() + place->begin;
      for (const double value : values) {
        number = static_cast<T>(value);
        number = is_swapped ? with_bytes_reversed(number) : number;
        std::memcpy(at, &number, sizeof(T));
        at += sizeof(T);
      }
      return true;
    } else {
      return false;
    }
  });
}

}  // namespace

void write_changed_hdf5(const std::filesystem::path& file, const Hdf5Reader& reader, std::string_view bytes,
                        const Hdf5Values& values) {
  MemoryBlock patched;
  std::string by_library;
  std::string_view changed = bytes;
  if (!values.empty()) {
    patched.append(bytes.data(), bytes.size());
    changed = {reinterpret_cast<const char*>(patched.data()), patched.size()};
  }
  try {
    Hdf5Values others;
    std::size_t numbers = 0;
    for (const auto& [dataset, of_dataset] : values) {
      if (!patch(patched, reader, dataset, of_dataset)) {
        others.emplace(dataset, of_dataset);
        numbers += of_dataset.size();
      }
    }
    if (!others.empty()) {
      Hdf5Child child(Hdf5Child::limits_of(bytes.size()),
                      [&](const Hdf5Channel& channel) { serve_changed(changed, others, channel); });
      // What does not compress well takes more than before, beside what stood there.
      by_library = child.answer(saturating_product(4, bytes.size() + sizeof(double) * numbers) + (1U << 20));
      changed = by_library;
    }
  } catch (const std::runtime_error& error) {
    throw WriteError(file, error.what());
  }
  BufferedWriter writer(file);
  writer.write(changed);
  writer.close();
}

}  // namespace trismooth
