// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_writer.h"

#include <algorithm>
#include <string>
#include <utility>

#include <vtkCellData.h>
#include <vtkPointData.h>

#include "catch.h"
#include "vtk_xml_samples.h"

using trismooth::FileWorkers;
using trismooth::ScalarType;
using trismooth::VtkXmlCompressor;
using trismooth::VtkXmlEncoding;
using trismooth::VtkXmlKind;
using trismooth::VtkXmlMode;
using trismooth::Workers;
using namespace vtk_xml_samples;

namespace {

std::string xml_bytes(vtkPointSet& data, const VtkXmlEncoding& encoding, const FileWorkers& workers) {
  const TemporaryPath file(".xml");
  trismooth::write_vtk_xml(file.path(), data, encoding, {}, workers);
  return vtk_xml_samples::read_bytes(file.path());
}

/// Empty where there is none: files are too long to be shown.
std::string first_difference(const std::string& a, const std::string& b) {
  const auto [at_a, at_b] = std::ranges::mismatch(a, b);
  return at_a == a.end() && at_b == b.end()
             ? ""
             : "at " + std::to_string(at_a - a.begin()) + ": " + std::string(at_a, std::min(at_a + 80, a.end())) +
                   " and " + std::string(at_b, std::min(at_b + 80, b.end()));
}

/// Without the ranges that VTK's writer has just computed.
std::string without_ranges(std::string file) {
  const std::string end = "</InformationKey>\n";
  for (std::size_t at = 0; (at = file.find("<InformationKey name=\"L2_NORM_", at)) != std::string::npos;) {
    at = file.rfind('\n', at) + 1;
    file.erase(at, file.find(end, at) + end.size() - at);
  }
  return file;
}

}  // namespace

TEST_CASE("what is not compressed is, in the elements, what VTK writes there") {
  const VtkXmlKind kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const int threads = GENERATE(1, 3);
  Workers workers(threads);
  for (const VtkXmlEncoding& encoding : all_encodings()) {
    if (encoding.compressor != VtkXmlCompressor::none || encoding.mode == VtkXmlMode::appended) {
      continue;
    }
    INFO(threads << ' ' << to_string(encoding));
    const auto data = make_sample(kind, ScalarType::float64, SpecialValues::none);
    if (encoding.mode == VtkXmlMode::ascii) {
      // VTK writes float32 in text as the float64 that it is.
      data->GetPointData()->RemoveArray("plane floats");
      data->GetCellData()->RemoveArray("plane floats");
    }
    const TemporaryPath file(extension_of(kind));
    write_with_vtk(*data, file.path(), encoding);
    const std::string expected = without_ranges(vtk_xml_samples::read_bytes(file.path()));
    for (const std::size_t part_bytes : {std::size_t{1}, std::size_t{100}, FileWorkers::whole}) {
      INFO(part_bytes);
      CHECK(first_difference(xml_bytes(*data, encoding, FileWorkers(workers, part_bytes)), expected) == "");
    }
  }
}

TEST_CASE("VTU and VTP are the same bytes in every encoding by every number of threads, in parts of any size") {
  const VtkXmlKind kind = GENERATE(VtkXmlKind::unstructured_grid, VtkXmlKind::poly_data);
  const bool sizes_apart = GENERATE(false, true);
  for (VtkXmlEncoding encoding : all_encodings()) {
    const bool is_usual = !encoding.big_endian && encoding.wide_block_headers;
    if ((encoding.compressor == VtkXmlCompressor::lzma || sizes_apart) && !is_usual) {
      continue;  // takes its time
    }
    encoding.sizes_apart = sizes_apart;
    INFO(to_string(encoding));
    const auto write = [&](const FileWorkers& workers) {
      // Made anew, as VTK keeps what it has computed with its arrays.
      return xml_bytes(*make_sample(kind, ScalarType::float32, SpecialValues::all), encoding, workers);
    };
    Workers alone(1);
    const std::string expected = write(FileWorkers(alone, FileWorkers::whole));
    CHECK(first_difference(write(FileWorkers(alone, 7)), expected) == "");
    for (const auto& [threads, part_bytes] :
         {std::pair(2, std::size_t{1}), std::pair(3, std::size_t{100}), std::pair(8, std::size_t{33})}) {
      INFO(threads << ' ' << part_bytes);
      Workers workers(threads);
      CHECK(first_difference(write(FileWorkers(workers, part_bytes)), expected) == "");
    }
  }
}
