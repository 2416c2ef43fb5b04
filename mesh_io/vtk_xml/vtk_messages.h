// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <vtkCommand.h>
#include <vtkObject.h>
#include <vtkSmartPointer.h>

namespace trismooth {

/// Takes the errors and warnings of VTK objects, which go to standard error otherwise.
class VtkMessages {
 public:
  void watch(vtkObject* object);
  void unwatch(vtkObject* object);

  /// The first error since the start or the last clear(), one line; empty where there was none.
  const std::string& first_error() const { return collector_->first_error; }
  void clear() { collector_->first_error.clear(); }

 private:
  class Collector : public vtkCommand {
   public:
    void Execute(vtkObject* caller, unsigned long event, void* data) override;
    std::string first_error;
  };

  vtkSmartPointer<Collector> collector_ = vtkSmartPointer<Collector>::Take(new Collector);
};

}  // namespace trismooth
