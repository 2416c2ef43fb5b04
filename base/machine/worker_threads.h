// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

/// The most threads that anybody may ask for: 1024, or as many as the machine has cores.
int most_threads();

/// `threads` itself. Throws std::invalid_argument unless it is from 0 (one for each core) to most_threads().
int checked_threads(int threads);

/// Sees to it that `count` threads, the calling one included, can be at work at a time, before a loop asks TBB for
/// them. TBB lets its threads start each other when they are needed, and ends the program where the system refuses one
/// (a limit of processes, of address space). Here they are started one by one; where one is refused, TBB has to do with
/// those that could be started, in the whole process from then on. Where none comes within half a second, as TBB's
/// threads are busy elsewhere, no more are started. Answers how many may be asked for. Cheap where they are there
/// already.
int start_worker_threads(int count);

/// `count`, or what is left of it where the system has refused threads before.
int allowed_threads(int count);

/// From this call on fork() is watched: TBB's threads are at work, or about to be.
void expect_fork();

/// True in a process that fork() has made of one that expected it: TBB waits for ever there for threads that have not
/// come along.
bool has_lost_threads();

}  // namespace trismooth
