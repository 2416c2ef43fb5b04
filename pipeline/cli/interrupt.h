// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth {

/// Whether a process that a signal ends says so: of the ranks of an MPI job, which get it together, the first alone.
enum class InterruptWords : std::uint8_t { said, none };

/// For the program, once, at its start: from now on SIGINT (Ctrl-C), SIGTERM and SIGHUP end the process at once with
/// status 130, unfinished output files removed and one line on standard error; nothing was written then, but what a
/// pipe or a device has taken. Once an output file is being put in its place, the first signal comes too late and
/// changes nothing, the run comes to its end; a second one ends it. A signal that is ignored (a job in the background
/// of a script, nohup) stays ignored.
void end_on_interrupt(InterruptWords words = InterruptWords::said);

/// For a run that writes several meshes, between two of them: ends the process, as a second signal would, where the
/// first came while one was being put in its place.
void end_where_interrupted();

/// From now on these signals change nothing: all is done.
void ignore_interrupts();

}  // namespace trismooth
