// SPDX-License-Identifier: BSD-3-Clause
#include "vtk_runs.h"

#include <vtkGeometryFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmoothPolyDataFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "trismooth/base/machine/stopwatch.h"

namespace vtk_runs {

namespace {

template <class Reader, class Writer>
Times run_with(const std::filesystem::path& input, const std::filesystem::path& output, int sweeps) {
  Times times;
  trismooth::Stopwatch watch;
  vtkNew<Reader> reader;
  reader->SetFileName(input.c_str());
  reader->Update();
  times.read = watch.lap();

  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputData(reader->GetOutput());
  surface->Update();
  watch.lap();
  vtkNew<vtkSmoothPolyDataFilter> smoother;
  smoother->SetInputData(surface->GetOutput());
  smoother->SetNumberOfIterations(sweeps);
  smoother->SetRelaxationFactor(1);
  smoother->SetConvergence(0);
  smoother->BoundarySmoothingOff();
  smoother->FeatureEdgeSmoothingOff();
  smoother->Update();
  times.smooth = watch.lap();

  reader->GetOutput()->SetPoints(smoother->GetOutput()->GetPoints());
  vtkNew<Writer> writer;
  writer->SetFileName(output.c_str());
  writer->SetInputData(reader->GetOutput());
  watch.lap();
  writer->Write();
  times.write = watch.lap();
  return times;
}

/// As our own files are: raw, not compressed.
class RawWriter : public vtkXMLUnstructuredGridWriter {
 public:
  static RawWriter* New() {
    auto* const writer = new RawWriter;
    writer->InitializeObjectBase();
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    return writer;
  }
};

}  // namespace

bool reads(const std::string& format) {
  return format == "vtk" || format == "vtu";
}

Times run(const std::filesystem::path& input, const std::filesystem::path& output, const std::string& format,
          int sweeps) {
  return format == "vtk" ? run_with<vtkUnstructuredGridReader, vtkUnstructuredGridWriter>(input, output, sweeps)
                         : run_with<vtkXMLUnstructuredGridReader, RawWriter>(input, output, sweeps);
}

}  // namespace vtk_runs
