#include "trismooth/pipeline/text_report.h"

#include <string_view>

#include <fmt/format.h>

#include "trismooth/pipeline/held_text.h"
#include "trismooth/pipeline/region_table.h"
#include "trismooth/quality/quality_table.h"
#include "trismooth/smoothing/backend.h"

namespace trismooth {

namespace {

std::string counted(std::int64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string line(std::string_view label, std::string_view text) {
  return fmt::format("{:<12}{}\n", label, text);
}

std::string input_lines(const InputSummary& input) {
  std::string what = fmt::format("{}: {}, {}", input.path.string(), counted(input.vertices, "vertex", "vertices"),
                                 counted(input.triangles, "triangle", "triangles"));
  if (input.other_cells > 0) {
    what += ", " + counted(input.other_cells, "other cell", "other cells");
  }
  if (input.components > 1) {
    what += fmt::format(", {} components", input.components);
  }
  std::string text = line("input:", what);
  if (input.reoriented_triangles > 0) {
    text += line("", fmt::format("{} listed clockwise against the rest: taken as turned, kept so in the file",
                                 counted(input.reoriented_triangles, "triangle is", "triangles are")));
  }
  if (!input.region_array.empty()) {
    std::string regions = fmt::format("{} by the cell array{} '{}'", input.regions,
                                      input.region_arrays.size() > 1 ? "s" : "", input.region_array);
    if (input.regions > 1) {
      regions += "; vertices between two regions are fixed";
    }
    text += line("regions:", regions);
  }
  return text + line("vertices:", fmt::format("{} fixed, {} free", input.fixed_vertices, input.free_vertices)) +
         line("fixed:", held_text(input));
}

/// What a run that moved nothing should say, or nothing.
std::string_view why_nothing_moved(const PipelineResult& result) {
  if (result.smoothing->moved_vertices > 0) {
    return {};
  }
  if (result.input.triangles == 0) {
    return "nothing to smooth: the mesh has no triangles";
  }
  if (result.input.free_vertices == 0) {
    return "nothing to smooth: every vertex is fixed";
  }
  if (result.smoothing->reverted_vertices > 0) {
    return "nothing moved: every move would have made an element worse and was taken back";
  }
  return "nothing moved: no vertex could be improved";
}

std::string who_smoothed(const SmoothingResult& smoothing) {
  return ran_on_device(smoothing)
             ? smoothing.backend
             : fmt::format("{} with {}", smoothing.backend, counted(smoothing.threads, "thread", "threads"));
}

std::string device_line(const SmoothingOptions& options, const SmoothingResult& smoothing) {
  return line("device:", fmt::format("{}, {} execution, {} layout; launches: {}; {} of its memory", smoothing.device,
                                     to_string(options.execution), to_string(options.layout), launches_text(smoothing),
                                     bytes_text(smoothing.device_memory_bytes)));
}

std::string smoothing_lines(const SmoothingOptions& options, const PipelineResult& result) {
  const SmoothingResult& smoothing = *result.smoothing;
  std::string text =
      line("smoothing:", fmt::format("{}, form {}, {} precision, {}", to_string(options.method),
                                     to_string(options.form), to_string(options.precision), who_smoothed(smoothing)));
  if (!smoothing.backend_note.empty()) {
    text += line("", smoothing.backend_note);
  }
  if (ran_on_device(smoothing)) {
    text += device_line(options, smoothing);
  }
  if (!smoothing.reproducible) {
    text += line("order:", fmt::format("{}: {}", to_string(options.order), not_reproducible_text()));
  }
  text += line("stopped:", fmt::format("{} after {}: {}", to_string(smoothing.stop_reason),
                                       counted(smoothing.sweeps, "sweep", "sweeps"), describe(smoothing.stop_reason)));
  std::string moved = fmt::format("{} moved", counted(smoothing.moved_vertices, "vertex", "vertices"));
  if (smoothing.reverted_vertices > 0) {
    moved += fmt::format(", {} put back where they had made an element worse (in {})", smoothing.reverted_vertices,
                         counted(smoothing.guard_rounds, "round", "rounds"));
  }
  text += line("result:", moved);
  const PipelineTimings& timings = result.timings_ms;
  const double smoothing_time = timings.transfer_in + timings.smooth + timings.transfer_out + timings.commit;
  return text + line("time:", fmt::format("{} for smoothing, {} in all", duration_text(smoothing_time),
                                          duration_text(timings.total)));
}

std::string inverted_line(const PipelineResult& result) {
  const std::int64_t before = result.before.inverted;
  const std::int64_t now = result.after ? result.after->inverted : before;
  if (now == 0) {
    return result.after && before > 0 ? fmt::format("No inverted triangles remain ({} before).\n", before)
                                      : std::string{};
  }
  if (!result.after) {
    return fmt::format("{} inverted.\n", counted(now, "triangle is", "triangles are"));
  }
  return fmt::format("{} ({} before).\n", counted(now, "inverted triangle remains", "inverted triangles remain"),
                     before);
}

}  // namespace

std::string_view describe(StopReason reason) {
  switch (reason) {
    case StopReason::fixed_point:
      return "no vertex moved any more";
    case StopReason::tolerance:
      return "every move was within the tolerance";
    case StopReason::sweep_limit:
      return "the sweep limit was reached";
    case StopReason::time_limit:
      return "the time was up";
    case StopReason::quality_target:
      return "the quality target was reached";
    case StopReason::cancelled:
      break;
  }
  return "it was cancelled";
}

std::string duration_text(double milliseconds) {
  if (milliseconds < 9.95) {
    return fmt::format("{:.2f} ms", milliseconds);
  }
  return milliseconds < 999.5 ? fmt::format("{:.0f} ms", milliseconds) : fmt::format("{:.1f} s", milliseconds / 1000);
}

std::string bytes_text(std::int64_t bytes) {
  constexpr double mebibyte = 1024.0 * 1024.0;
  constexpr double gibibyte = 1024.0 * mebibyte;
  const auto size = static_cast<double>(bytes);
  if (size >= gibibyte) {
    return fmt::format("{:.1f} GiB", size / gibibyte);
  }
  return size < 9.95 * mebibyte ? fmt::format("{:.2f} MiB", size / mebibyte)
                                : fmt::format("{:.0f} MiB", size / mebibyte);
}

bool ran_on_device(const SmoothingResult& smoothing) {
  return smoothing.backend != cpu_backend().name();
}

std::string launches_text(const SmoothingResult& smoothing) {
  std::string text = fmt::format("{} by the host", smoothing.kernel_launches);
  if (smoothing.child_launches > 0) {
    text += fmt::format(", {} by the device", smoothing.child_launches);
  }
  return text;
}

std::string_view not_reproducible_text() {
  return "threads saw each other's moves in no fixed order; another run gives another result";
}

std::string text_report(const PipelineOptions& options, const PipelineResult& result) {
  std::string text = input_lines(result.input);
  if (result.smoothing) {
    text += smoothing_lines(options.smoothing, result);
  }
  text += '\n' + format_table(result.before, result.after ? &*result.after : nullptr) + '\n';
  if (result.smoothing) {
    if (const std::string_view why = why_nothing_moved(result); !why.empty()) {
      text += fmt::format("{}\n", why);
    }
  }
  text += inverted_line(result);
  if (!result.smoothing && result.region_names.size() <= few_regions) {
    text += region_table(result);
  }
  if (const auto& written = options.written()) {
    text += line("written:", written->string());
  }
  return text;
}

}  // namespace trismooth
