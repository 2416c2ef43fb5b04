// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_messages.h"

#include <algorithm>

#include <vtkObject.h>

namespace trismooth {

void VtkMessages::watch(vtkObject* object) {
  object->AddObserver(vtkCommand::ErrorEvent, collector_);
  object->AddObserver(vtkCommand::WarningEvent, collector_);
}

void VtkMessages::unwatch(vtkObject* object) {
  object->RemoveObserver(collector_);
}

void VtkMessages::Collector::Execute(vtkObject*, unsigned long event, void* data) {
  if (event != vtkCommand::ErrorEvent || !first_error.empty() || data == nullptr) {
    return;
  }
  // "ERROR: In <file>, line <n>\n<class> (<address>): <message>\n\n"
  first_error = static_cast<const char*>(data);
  const std::size_t address = first_error.find("): ");
  if (address != std::string::npos) {
    first_error.erase(0, address + 3);
  }
  first_error.erase(first_error.find_last_not_of(" \n") + 1);
  std::ranges::replace(first_error, '\n', ' ');
  if (first_error.empty()) {
    first_error = "unknown error";
  }
}

}  // namespace trismooth
