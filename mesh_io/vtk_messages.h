#pragma once

#include <string>

#include <vtkCommand.h>
#include <vtkNew.h>

class vtkObject;

namespace trismooth {

/// Takes the errors and warnings of VTK objects, which go to standard error otherwise. Must outlive what it watches,
/// or what it watches must not speak any more.
class VtkMessages {
 public:
  void watch(vtkObject* object);

  /// The first error since the start or the last clear(), one line; empty where there was none.
  const std::string& first_error() const { return collector_->first_error; }
  void clear() { collector_->first_error.clear(); }

 private:
  class Collector : public vtkCommand {
   public:
    static Collector* New() { return new Collector; }
    void Execute(vtkObject* caller, unsigned long event, void* data) override;
    std::string first_error;
  };

  vtkNew<Collector> collector_;
};

}  // namespace trismooth
