// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_changes.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <stdexcept>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_child.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"
#include "trismooth/mesh_io/hdf5/hdf5_image.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Whether a filter keeps less than the values: others would be read than were written.
bool loses_values(const Hdf5Handle& dataset) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset.get()), &H5Pclose);
  const bool has_filters = H5Pget_layout(properties.get()) == H5D_CHUNKED;
  const auto has = [&properties](H5Z_filter_t filter) {
    unsigned flags = 0;
    std::size_t values = 0;
    return H5Pget_filter_by_id2(properties.get(), filter, &flags, &values, nullptr, 0, nullptr, nullptr) >= 0;
  };
  return has_filters && (has(H5Z_FILTER_SCALEOFFSET) || has(H5Z_FILTER_NBIT));
}

void overwrite(const Hdf5Handle& file, const std::string& dataset, const std::vector<double>& values) {
  const Hdf5Handle at(H5Dopen2(file.get(), dataset.c_str(), H5P_DEFAULT), &H5Dclose);
  if (at.is_valid() && loses_values(at)) {
    throw Hdf5Refusal(quoted(std::string_view(dataset)) +
                      " is packed with a loss (scale-offset, n-bit): what is written there is not what is read; "
                      "'h5repack -f GZIP=6 in.h5 out.h5' packs it without one");
  }
  const Hdf5Handle space(at.is_valid() ? H5Dget_space(at.get()) : -1, &H5Sclose);
  if (!space.is_valid() || H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(values.size()) ||
      H5Dwrite(at.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw Hdf5Refusal(quoted(std::string_view(dataset)) + " cannot be written" + hdf5_reason());
  }
}

/// In a child: answers with the whole file.
void serve_changed(std::string_view bytes, const Hdf5Values& values, const Hdf5Channel& channel) {
  H5PLset_loading_state(0);
  try {
    std::string memory(bytes);
    Hdf5Image image(&memory);
    Hdf5Handle file = image.open();
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
    channel.answer(std::string_view(memory).substr(0, std::max(bytes.size(), static_cast<std::size_t>(size))));
  } catch (const Hdf5Refusal& refusal) {
    channel.refuse(refusal.what());
  } catch (const std::bad_alloc&) {
    channel.refuse("more memory is needed than there is");
  }
}

}  // namespace

void write_changed_hdf5(const std::filesystem::path& file, std::string_view bytes, const Hdf5Values& values) {
  std::size_t numbers = 0;
  for (const auto& [dataset, of_dataset] : values) {
    numbers += of_dataset.size();
  }
  std::string changed;
  try {
    Hdf5Child child(Hdf5Child::limits_of(bytes.size()),
                    [&](const Hdf5Channel& channel) { serve_changed(bytes, values, channel); });
    // What does not compress well takes more than before, beside what stood there.
    changed = child.answer(saturating_product(4, bytes.size() + sizeof(double) * numbers) + (1U << 20));
  } catch (const std::runtime_error& error) {
    throw WriteError(file, error.what());
  }
  BufferedWriter writer(file);
  writer.write(changed);
  writer.close();
}

}  // namespace trismooth
