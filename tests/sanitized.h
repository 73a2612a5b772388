#pragma once

namespace sandstroke {

/// Whether a sanitizer watches this program: memory is then not counted or measured (the sanitizer keeps it in
/// its own way), and what takes long does less of the same.
#ifdef SANDSTROKE_SANITIZE
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

}  // namespace sandstroke
