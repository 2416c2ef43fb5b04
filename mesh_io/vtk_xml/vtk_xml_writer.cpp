// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_xml_writer.h"

#include <algorithm>
#include <array>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <tbb/task_arena.h>
#include <vtkBase64OutputStream.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkIndent.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationInformationVectorKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_block.h"
#include "trismooth/mesh_io/vtk_xml/encoding/output_stream_buffer.h"
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_base64_stream.h"
#include "trismooth/mesh_io/vtk_xml/encoding/vtk_compressor.h"
#include "trismooth/mesh_io/vtk_xml/vtk_arrays.h"
#include "trismooth/mesh_io/vtk_xml/vtk_data_sets.h"
#include "trismooth/mesh_io/vtk_xml/vtk_messages.h"
#include "trismooth/mesh_io/xml/xml_names.h"

namespace trismooth {

namespace {

/// Six numbers a line, as VTK's writer does it.
template <class T>
void write_text(std::ostream& stream, vtkIndent indent, std::span<const T> values, const FileWorkers& workers) {
  constexpr std::size_t columns = 6;
  constexpr std::size_t number_bytes = 12;
  std::ostringstream margin;
  margin << indent;
  const auto write = [&stream](std::string_view text) {
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  };
  const auto append = [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
    TextBlock text(bytes);
    for (std::size_t row = begin; row < end; ++row) {
      text.text(margin.view());
      const std::size_t last = std::min(values.size(), (row + 1) * columns);
      for (std::size_t i = row * columns; i < last; ++i) {
        text.number(values[i]).text(i + 1 == last ? '\n' : ' ');
      }
    }
  };
  OrderedBlocks(write, workers).write_rows((values.size() + columns - 1) / columns, columns * number_bytes, append);
}

/// Ranges that VTK has computed for the array. It would write them beside the numbers, by chance (where something
/// asked for them before), and its reader complains where they are not finite.
void forget_ranges(vtkAbstractArray& array) {
  vtkInformation& information = *array.GetInformation();
  information.Remove(vtkDataArray::L2_NORM_RANGE());
  information.Remove(vtkDataArray::L2_NORM_FINITE_RANGE());
  information.Remove(vtkAbstractArray::PER_COMPONENT());
  information.Remove(vtkAbstractArray::PER_FINITE_COMPONENT());
}

void forget_ranges(vtkFieldData& fields) {
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    forget_ranges(*fields.GetAbstractArray(i));
  }
}

/// VTK's writer with faults mended: it writes -0 as 0 in text, values that are not finite as text that its own reader
/// cannot read, and ranges that it has just computed. It also writes to a stream of ours, so it does not delete what it
/// failed to write.
template <class Writer>
class ExactWriter : public Writer {
 public:
  static vtkSmartPointer<ExactWriter> make() {
    auto* const writer = new ExactWriter;
    writer->InitializeObjectBase();
    return vtkSmartPointer<ExactWriter>::Take(writer);
  }

  void set_stream(std::ostream& stream) { this->Stream = &stream; }
  void set_file_attributes(const XmlAttributes& attributes) { attributes_ = attributes; }
  /// Those who encode, which must outlive the writer; `apart`, of base64 in the elements.
  void set_workers(const FileWorkers& workers, VtkBase64Stream::Apart apart) {
    workers_ = &workers;
    Writer::SetDataStream(VtkBase64Stream::make(workers, apart));
  }

 protected:
  /// VTK's writer makes a stream by itself for appended data.
  void SetDataStream(vtkOutputStream* stream) override {
    const bool is_base64 = vtkBase64OutputStream::SafeDownCast(stream) != nullptr;
    Writer::SetDataStream(is_base64 ? VtkBase64Stream::make(*workers_, VtkBase64Stream::Apart::nothing) : stream);
  }

  void WriteFileAttributes() override {
    if (attributes_.empty()) {
      Writer::WriteFileAttributes();
    }
    for (const auto& [name, value] : attributes_) {
      *this->Stream << ' ' << name << "=\"" << escape_xml_attribute(value) << '"';
    }
  }

  void WriteArrayInline(vtkAbstractArray* array, vtkIndent indent, const char* name, int write_rows) override {
    const int mode = this->DataMode;
    const auto view = view_as_data_array(array);
    if (mode == vtkXMLWriter::Ascii && view && holds_non_finite(*view)) {
      this->DataMode = vtkXMLWriter::Binary;
    }
    Writer::WriteArrayInline(array, indent, name, write_rows);
    this->DataMode = mode;
  }

  void WriteInlineData(vtkAbstractArray* array, vtkIndent indent) override {
    const auto view = view_as_data_array(array);
    if (this->DataMode == vtkXMLWriter::Ascii && view) {
      visit_scalar_type(view->type, [&](auto zero) {
        write_text(*this->Stream, indent, view->template as<decltype(zero)>(), *workers_);
      });
    } else {
      Writer::WriteInlineData(array, indent);
    }
    forget_ranges(*array);
  }

 private:
  XmlAttributes attributes_;
  const FileWorkers* workers_ = nullptr;
};

/// The name and the component names as VTK's writer has to get them: it puts them into attributes as they are.
bool needs_escape(vtkAbstractArray& array) {
  const auto differs = [](const char* name) { return name != nullptr && escape_xml_attribute(name) != name; };
  bool needs = differs(array.GetName());
  for (int i = 0; array.HasAComponentName() && i < array.GetNumberOfComponents(); ++i) {
    needs = needs || differs(array.GetComponentName(i));
  }
  return needs;
}

/// A copy with escaped names; it shares the numbers.
vtkSmartPointer<vtkAbstractArray> escaped_copy(vtkAbstractArray& array) {
  vtkSmartPointer<vtkAbstractArray> copy;
  copy.TakeReference(array.NewInstance());
  if (auto* const numbers = vtkDataArray::SafeDownCast(copy)) {
    numbers->ShallowCopy(vtkDataArray::SafeDownCast(&array));
  } else {
    copy->DeepCopy(&array);
  }
  copy->CopyInformation(array.GetInformation(), 1);
  copy->SetName(escape_xml_attribute(array.GetName()).c_str());
  for (int i = 0; array.HasAComponentName() && i < array.GetNumberOfComponents(); ++i) {
    if (const char* const component = array.GetComponentName(i)) {
      copy->SetComponentName(i, escape_xml_attribute(component).c_str());
    }
  }
  return copy;
}

void escape_names(vtkFieldData& fields) {
  std::vector<vtkSmartPointer<vtkAbstractArray>> copies;
  bool any = false;
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    any = any || needs_escape(*fields.GetAbstractArray(i));
  }
  if (!any) {
    return;
  }
  copies.reserve(static_cast<std::size_t>(fields.GetNumberOfArrays()));
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    copies.push_back(escaped_copy(*fields.GetAbstractArray(i)));
  }
  std::array<int, vtkDataSetAttributes::NUM_ATTRIBUTES> active{};
  auto* const attributes = vtkDataSetAttributes::SafeDownCast(&fields);
  if (attributes != nullptr) {
    attributes->GetAttributeIndices(active.data());
  }
  fields.Initialize();
  reserve_vtk_arrays(fields, copies.size());
  for (const auto& copy : copies) {
    add_vtk_array(fields, *copy, copy->GetName());
  }
  for (int i = 0; attributes != nullptr && i < vtkDataSetAttributes::NUM_ATTRIBUTES; ++i) {
    if (active[static_cast<std::size_t>(i)] >= 0) {
      attributes->SetActiveAttribute(active[static_cast<std::size_t>(i)], i);
    }
  }
}

/// The bytes of the large arrays of the data set that the writer compresses where they stand.
std::vector<std::span<const std::byte>> numbers_of(vtkPointSet& data) {
  std::vector<std::span<const std::byte>> all;
  const auto add = [&all](vtkAbstractArray* array) {
    if (const auto view = array == nullptr ? std::nullopt : view_as_data_array(array)) {
      all.push_back(view->bytes);
    }
  };
  add(data.GetPoints()->GetData());
  for (vtkFieldData* const fields :
       {static_cast<vtkFieldData*>(data.GetPointData()), static_cast<vtkFieldData*>(data.GetCellData())}) {
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i) {
      add(fields->GetAbstractArray(i));
    }
  }
  const auto add_cells = [&add](vtkCellArray* cells) {
    if (cells == nullptr) {
      return;
    }
    add(cells->GetOffsetsArray());
    add(cells->GetConnectivityArray());
  };
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data)) {
    add_cells(grid->GetCells());
    add(grid->GetCellTypesArray());
  } else if (auto* const poly_data = vtkPolyData::SafeDownCast(&data)) {
    for (vtkCellArray* const cells :
         {poly_data->GetVerts(), poly_data->GetLines(), poly_data->GetPolys(), poly_data->GetStrips()}) {
      add_cells(cells);
    }
  }
  return all;
}

template <class Writer>
void write_to_stream(std::ostream& stream, const std::filesystem::path& path, vtkPointSet& data,
                     const VtkXmlEncoding& encoding, const XmlAttributes& attributes, const FileWorkers& workers) {
  const vtkSmartPointer<ExactWriter<Writer>> writer = ExactWriter<Writer>::make();
  VtkMessages messages;
  messages.watch(writer);
  // Says no more than that the writer failed, but on standard error and in many lines.
  VtkMessages repetitions;
  repetitions.watch(writer->GetExecutive());
  writer->set_stream(stream);
  writer->SetInputData(&data);
  writer->SetDataMode(encoding.mode == VtkXmlMode::ascii    ? vtkXMLWriter::Ascii
                      : encoding.mode == VtkXmlMode::binary ? vtkXMLWriter::Binary
                                                            : vtkXMLWriter::Appended);
  writer->SetEncodeAppendedData(encoding.appended_base64);
  writer->SetByteOrder(encoding.big_endian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
  writer->SetHeaderType(encoding.wide_block_headers ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  writer->SetCompressor(workers.workers.count() == 1
                            ? make_vtk_compressor(encoding.compressor)
                            : make_vtk_compressor(encoding.compressor, numbers_of(data), workers.workers));
  writer->set_file_attributes(attributes);
  writer->set_workers(workers, encoding.sizes_apart ? VtkBase64Stream::Apart::first : VtkBase64Stream::Apart::nothing);
  // VTK loops over the types of cells on TBB's threads where it was built with it; a user may have asked for one.
  const bool written = tbb::task_arena(1).execute([&] { return writer->Write() != 0; });
  const unsigned long code = writer->GetErrorCode();
  if (!written || code != vtkErrorCode::NoError || !messages.first_error().empty()) {
    throw WriteError(
        path, "cannot be written: " + (messages.first_error().empty() ? vtkErrorCode::GetStringFromErrorCode(code)
                                                                      : messages.first_error()));
  }
}

void write_to_stream(std::ostream& stream, const std::filesystem::path& path, vtkPointSet& data,
                     const VtkXmlEncoding& encoding, const XmlAttributes& attributes, const FileWorkers& workers) {
  const vtkSmartPointer<vtkPointSet> copy = shallow_copy(data);
  for (vtkFieldData* const fields : {static_cast<vtkFieldData*>(copy->GetPointData()),
                                     static_cast<vtkFieldData*>(copy->GetCellData()), copy->GetFieldData()}) {
    forget_ranges(*fields);
    escape_names(*fields);
  }
  vtkDataArray* const points = data.GetPoints()->GetData();
  if (needs_escape(*points)) {
    const vtkNew<vtkPoints> escaped;
    escaped->SetData(vtkDataArray::SafeDownCast(escaped_copy(*points)));
    copy->SetPoints(escaped);
  }
  if (vtkUnstructuredGrid::SafeDownCast(copy) != nullptr) {
    write_to_stream<vtkXMLUnstructuredGridWriter>(stream, path, *copy, encoding, attributes, workers);
  } else {
    write_to_stream<vtkXMLPolyDataWriter>(stream, path, *copy, encoding, attributes, workers);
  }
}

}  // namespace

void write_vtk_xml(const std::filesystem::path& path, vtkPointSet& data, const VtkXmlEncoding& encoding,
                   const XmlAttributes& attributes) {
  Workers alone(1);
  write_vtk_xml(path, data, encoding, attributes, FileWorkers(alone));
}

void write_vtk_xml(const std::filesystem::path& path, vtkPointSet& data, const VtkXmlEncoding& encoding,
                   const XmlAttributes& attributes, const FileWorkers& workers) {
  constexpr std::size_t kibibyte = 1024;  // what VTK counts in
  constexpr std::size_t mebibyte = 1024 * kibibyte;
  const std::size_t data_bytes = data.GetActualMemorySize() * kibibyte;
  // Blocks of every worker, but no more of them than the data have.
  const std::size_t for_buffers =
      std::min(2 * mebibyte * (1 + static_cast<std::size_t>(workers.workers.count())), 4 * mebibyte + 3 * data_bytes);
  require_host_memory(data_bytes + for_buffers);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    // VTK's writer goes back and forth in what it writes; a pipe or a device cannot.
    std::ostringstream text;
    write_to_stream(text, path, data, encoding, attributes, workers);
    if (!text) {
      throw std::bad_alloc();  // which a string stream keeps to itself
    }
    BufferedWriter file(path);
    file.write(text.view());
    file.close();
    return;
  }
  OutputStreamBuffer file(path);
  std::ostream stream(&file);
  write_to_stream(stream, path, data, encoding, attributes, workers);
  file.close();
}

}  // namespace trismooth
