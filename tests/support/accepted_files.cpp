// SPDX-License-Identifier: BSD-3-Clause
#include "support/accepted_files.h"

#include <algorithm>

#include <fmt/format.h>

#include "trismooth/mesh_io/codec.h"

#include "support/format_sample.h"

namespace accepted_files {

/// One a format, each in a file of formats/.
FormatSample off_sample(), obj_sample(), ply_sample(), stl_sample(), vtk_sample(), vtu_sample(), vtp_sample(),
    msh_sample(), medit_sample(), su2_sample(), inp_sample(), adcirc_sample(), sms_sample(), freefem_sample(),
    mfem_sample(), triangle_sample(), nastran_sample(), unv_sample(), xdmf_sample(), exodus_sample(), ugrid_sample(),
    med_sample(), cgns_sample(), selafin_sample();

const std::vector<FormatSample>& format_samples() {
  static const std::vector<FormatSample> samples{
      off_sample(),  obj_sample(),     ply_sample(),   stl_sample(),      vtk_sample(),     vtu_sample(),
      vtp_sample(),  msh_sample(),     medit_sample(), su2_sample(),      inp_sample(),     adcirc_sample(),
      sms_sample(),  freefem_sample(), mfem_sample(),  triangle_sample(), nastran_sample(), unv_sample(),
      xdmf_sample(), exodus_sample(),  ugrid_sample(), med_sample(),      cgns_sample(),    selafin_sample()};
  return samples;
}

const FormatSample& sample_of(trismooth::FileFormat format) {
  return format_samples().at(static_cast<std::size_t>(format));
}

std::string text_of(const std::array<double, 3>& point) {
  return fmt::format("{} {} {}", point[0], point[1], point[2]);
}

Mesh mesh(bool others) {
  Mesh all{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0.75, 1.25, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  if (others) {
    all.points.insert(all.points.end(), {{4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {0, 4, 0}});
    all.faces.insert(all.faces.end(), {{1, 5, 6, 2}, {3, 2, 6, 7, 8}});
  }
  return all;
}

trismooth::FileFormat format_of(const AcceptedFile& file) {
  const std::string first_word = file.name.substr(0, file.name.find('_'));
  const auto named = trismooth::format_named(first_word == "legacy" ? "vtk" : first_word);
  const auto formats = trismooth::formats_of("file" + file.extension);
  return named && std::ranges::find(formats, *named) != formats.end() ? *named : formats.at(0);
}

bool is_one_file(const AcceptedFile& file) {
  return trismooth::codec_of(format_of(file)).partner_of == nullptr;
}

const std::vector<AcceptedFile>& all() {
  static const std::vector<AcceptedFile> files = [] {
    std::vector<AcceptedFile> made;
    for (const FormatSample& sample : format_samples()) {
      sample.add_files(made);
    }
    return made;
  }();
  return files;
}

}  // namespace accepted_files
