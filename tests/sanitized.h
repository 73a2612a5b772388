#pragma once

namespace sandstroke {

/// True if a sanitizer watches this program: memory is then not counted or measured (the sanitizer keeps it
/// in its own way), and what takes long does less of the same.
#ifdef SANDSTROKE_SANITIZE
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
/// True if it is the one for threads: its own memory is a file, which small limits of files' sizes make fail.
#ifdef SANDSTROKE_SANITIZE_THREADS
constexpr bool threads_sanitized = true;
#else
constexpr bool threads_sanitized = false;
#endif

}  // namespace sandstroke
