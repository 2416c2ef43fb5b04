#include "trismooth/pipeline/report_format.h"

#include "trismooth/mesh_io/buffered_writer.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/output_file.h"

namespace trismooth {

void write_report_text(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  try {
    BufferedWriter writer(file.path());
    writer.write(text);
    writer.close();
  } catch (const WriteError& error) {
    // The writer knows the temporary file only.
    throw WriteError(path, error.reason);
  }
  file.commit();
}

}  // namespace trismooth
