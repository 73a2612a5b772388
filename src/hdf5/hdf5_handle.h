#pragma once

#include <hdf5.h>

#include <string_view>
#include <utility>

namespace sandstroke {

/// The first bytes of every HDF5 file of this program.
inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

/// Owns one HDF5 identifier.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { close(); }

  /// False if closing failed (a full disk shows here at the latest).
  bool close() { return id_ < 0 || close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }
  /// Gives the identifier up: it is never closed.
  void release() { id_ = H5I_INVALID_HID; }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Prepares HDF5. Call it before anything else of HDF5. HDF5 prints no errors: this program reports them in
/// the user's terms. HDF5 does not touch open files again when the program ends: with a full disk it would
/// crash there, and every file is closed before. It loads no code because a file asks for a filter.
inline void prepare_hdf5() {
  static const herr_t once = [] {
    H5dont_atexit();  // must be the first call
    return H5PLset_loading_state(0);
  }();
  (void)once;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Access properties without HDF5's own lock, which fails where there are no locks, and on NFS beside a
/// FileLock.
inline Hdf5Handle without_locks() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  return access;
}

}  // namespace sandstroke
