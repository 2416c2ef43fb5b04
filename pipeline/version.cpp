#include "trismooth/pipeline/version.h"

namespace trismooth {

// The build system states it, for this file alone: a new version recompiles nothing else.
std::string_view version() {
  return TRISMOOTH_VERSION;
}

}  // namespace trismooth
