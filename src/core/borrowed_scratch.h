#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sandstroke {

/// Objects whose content lasts from begin() to end(), kept for speed. An owner that is no copy keeps them for
/// the next time. Of copies there may be thousands: they borrow those of their thread.
template <class T>
class BorrowedScratch {
 public:
  BorrowedScratch() = default;
  BorrowedScratch(const BorrowedScratch& /*other*/) : borrows_(true) {}
  BorrowedScratch(BorrowedScratch&&) noexcept = default;
  BorrowedScratch& operator=(const BorrowedScratch& /*other*/) { return *this; }
  BorrowedScratch& operator=(BorrowedScratch&&) noexcept = default;

  void begin() {
    if (borrows_ && objects_.empty()) objects_.swap(of_this_thread());
  }
  void end() {
    if (!borrows_) return;
    std::vector<std::unique_ptr<T>> ours = std::exchange(objects_, {});
    constexpr std::size_t most_kept = 64;
    if (ours.size() > most_kept) ours.resize(most_kept);
    if (ours.size() > of_this_thread().size()) ours.swap(of_this_thread());
  }
  std::size_t size() const { return objects_.size(); }
  void add() { objects_.push_back(std::make_unique<T>()); }
  T& operator[](std::size_t i) const { return *objects_[i]; }

 private:
  static std::vector<std::unique_ptr<T>>& of_this_thread() {
    thread_local std::vector<std::unique_ptr<T>> objects;
    return objects;
  }

  bool borrows_ = false;
  std::vector<std::unique_ptr<T>> objects_;
};

}  // namespace sandstroke
