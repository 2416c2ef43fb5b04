#include "trismooth/pipeline/report/report_format.h"

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/output_file.h"
#include "trismooth/mesh_io/errors.h"

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
