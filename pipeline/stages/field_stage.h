// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

struct LocalPoints;
struct RunState;

/// Chooses the point arrays whose values are to follow the mesh. Those that the output cannot take changed are among
/// the losses. Throws std::invalid_argument for names that do not fit the document.
void find_fields(RunState& run);

/// Takes their values at vertices that were moved from the mesh as it was read: `input` are its points. Where it was
/// projected, the third coordinate is one of them.
void move_fields(RunState& run, const LocalPoints& input);

}  // namespace trismooth
