#pragma once

// Whether a sanitizer keeps this program's memory, in its own way: then it is neither counted nor measured.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // gcc
#define SANDSTROKE_MEMORY_IS_SANITIZED
#elif defined(__has_feature)  // clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANDSTROKE_MEMORY_IS_SANITIZED
#endif
#endif
