// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// TRISMOOTH_SANITIZED: the tests run under a sanitizer, which brings its own malloc() and takes some ten times as long,
// where much memory comes and goes (LZMA) a hundred times.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define TRISMOOTH_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TRISMOOTH_SANITIZED
#endif

/// Tests of very many cases leave some out then.
#ifdef TRISMOOTH_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif
