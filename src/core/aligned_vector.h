#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace sandstroke {

/// Memory that begins on a boundary of the widest vectors' size.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t boundary{64};

  AlignedAllocator() = default;
  template <class Other>
  AlignedAllocator(const AlignedAllocator<Other>& /*other*/) {}  // NOLINT: containers convert allocators

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), boundary)); }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { ::operator delete(memory, boundary); }
  bool operator==(const AlignedAllocator& /*other*/) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace sandstroke
