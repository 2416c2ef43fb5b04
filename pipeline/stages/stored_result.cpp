// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/stored_result.h"

#include <cmath>
#include <cstddef>

#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/pipeline/stages/run_state.h"

namespace trismooth {

namespace {

double rounded_for(const MeshDocument& document, double number) {
  return rounded_to_characters(rounded_to(storage_of(document), number), document.most_coordinate_characters,
                               document.coordinate_form);
}

}  // namespace

double stored_coordinate(const MeshDocument& document, double before, double now) {
  const double rounded = now == before ? before : rounded_for(document, now);
  return std::isfinite(rounded) ? rounded : before;
}

bool is_stored_otherwise(const RunState& run) {
  return run.document.most_coordinate_characters > 0 || !run.mesh.middles.empty();
}

StoredImage stored_image(const RunState& run) {
  using Numbers = Eigen::Map<const Eigen::Vector3d>;
  return {3, [&run](std::size_t vertex, const double* stored) { return run.mesh.place(vertex, Numbers(stored)); },
          [&run](const double* stored, Point2<double> from, Point2<double> to, double* moved) {
            Eigen::Map<Eigen::Vector3d>{moved} = run.mesh.moved(Numbers(stored), from, to);
          },
          [&run](double number) { return rounded_for(run.document, number); }};
}

}  // namespace trismooth
