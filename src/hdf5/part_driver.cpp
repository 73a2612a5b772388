#include "hdf5/part_driver.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <vector>

#include "core/error.h"

namespace sandstroke {
namespace {

constexpr haddr_t page_bytes = 4096;
constexpr haddr_t first_bytes = 64 * 1024;   // all are kept in memory until the first commit writes them
constexpr std::size_t most_pages = 1 << 18;  // in a commit: 1 GiB

/// A page as a commit appends it.
struct Page {
  std::uint64_t address = 0;  // bytes from the file's beginning
  std::array<char, page_bytes> bytes{};
};

/// The last bytes of a file with appended pages.
struct Seal {
  std::array<char, 16> mark = {'s', 'a', 'n', 'd', 's', 't', 'r', 'o',
                               'k', 'e', ' ', 'p', 'a', 'g', 'e', 's'};
  std::uint64_t pages = 0;
  std::uint64_t checksum = 0;  // of the pages, one by one
};

int failure = 0;  // errno

/// Keeps the reason of a failure. Returns false.
bool fail_with(int error) {
  failure = error;
  return false;
}

haddr_t up_to_page(haddr_t bytes) { return (bytes + page_bytes - 1) / page_bytes * page_bytes; }

/// Transfers all bytes, with as many calls as it takes. call(bytes done): returns what the system call does.
template <class Call>
bool transfer(std::size_t count, std::size_t& done, const Call& call) {
  for (done = 0; done < count;) {
    const ssize_t some = call(done);
    if (some < 0 && errno == EINTR) continue;
    if (some < 0) return fail_with(errno);
    if (some == 0) break;  // the file ends here
    done += static_cast<std::size_t>(some);
  }
  return true;
}

bool write_at(int file, haddr_t address, const void* bytes, std::size_t count) {
  std::size_t done = 0;
  return transfer(count, done,
                  [&](std::size_t from) {
                    return pwrite(file, static_cast<const char*>(bytes) + from, count - from,
                                  static_cast<off_t>(address + from));
                  }) &&
         done == count;
}

/// Reads bytes; behind the file's end they are zeros.
bool read_at(int file, haddr_t address, void* bytes, std::size_t count) {
  auto* const to = static_cast<char*>(bytes);
  std::size_t done = 0;
  const bool read = transfer(count, done, [&](std::size_t from) {
    return pread(file, to + from, count - from, static_cast<off_t>(address + from));
  });
  std::fill(to + done, to + count, '\0');
  return read;
}

std::uint64_t checksum_of(std::uint64_t so_far, const Page& page) {
  return crc32(so_far, reinterpret_cast<const Bytef*>(&page), sizeof page);
}

/// The file as HDF5 knows it, and what this driver knows of it.
struct PartFile : H5FD_t {
  int file = -1;
  bool writes = false;
  bool bare = true;       // nothing was committed yet
  bool failed = false;    // a write failed: no commit may keep half of it
  haddr_t allocated = 0;  // by HDF5 (its "end of allocation")
  haddr_t end = 0;        // of the bytes that were written
  haddr_t committed = first_bytes;
  std::map<haddr_t, Page> pages;  // by address, until a commit writes them

  PartFile() : H5FD_t{} {}
  ~PartFile() {
    if (file >= 0) close(file);
  }
  bool take_appended();
  bool reserve(haddr_t bytes) const;
  bool append(haddr_t start) const;
  bool put_in_place() const;
  bool cut_off(haddr_t bytes) const;
  bool commit();
  Page* page_at(haddr_t address);
};

PartFile& part_of(H5FD_t* file) { return static_cast<PartFile&>(*file); }
const PartFile& part_of(const H5FD_t* file) { return static_cast<const PartFile&>(*file); }

/// Takes the appended pages of a commit that a kill interrupted after its seal. False: the file cannot be
/// read.
bool PartFile::take_appended() {
  struct stat status {};
  if (fstat(file, &status) != 0) return false;
  end = static_cast<haddr_t>(status.st_size);
  Seal seal;
  if (end < sizeof seal) return true;
  if (!read_at(file, end - sizeof seal, &seal, sizeof seal)) return false;
  const haddr_t room = end - sizeof seal;
  if (seal.mark != Seal{}.mark || seal.pages > std::min<haddr_t>(most_pages, room / sizeof(Page)))
    return true;
  const haddr_t start = room - seal.pages * sizeof(Page);
  std::uint64_t checksum = 0;
  std::map<haddr_t, Page> appended;
  for (std::uint64_t i = 0; i < seal.pages; ++i) {
    Page page;
    if (!read_at(file, start + i * sizeof page, &page, sizeof page)) return false;
    checksum = checksum_of(checksum, page);
    const bool in_order = appended.empty() || page.address > appended.rbegin()->first;
    if (!in_order || page.address % page_bytes != 0 || page.address >= start) return true;
    appended.emplace_hint(appended.end(), page.address, page);
  }
  if (checksum != seal.checksum) return true;
  pages = std::move(appended);
  end = start;
  return true;
}

Page* PartFile::page_at(haddr_t address) {
  if (pages.size() >= most_pages && !pages.contains(address)) {
    fail_with(EFBIG);
    return nullptr;
  }
  const auto [entry, is_new] = pages.try_emplace(address);
  Page& page = entry->second;
  page.address = address;
  if (is_new && !read_at(file, address, page.bytes.data(), page_bytes)) return nullptr;
  return &page;
}

/// Reserves disk space for all that was allocated, before anything old is overwritten.
bool PartFile::reserve(haddr_t bytes) const {
  if (fallocate(file, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes)) == 0) return true;
  if (errno != ENOSPC && errno != EDQUOT) return true;  // not every file system can
  return fail_with(errno);
}

bool PartFile::cut_off(haddr_t bytes) const {
  return ftruncate(file, static_cast<off_t>(bytes)) == 0 || fail_with(errno);
}

/// Appends the pages, and the seal.
bool PartFile::append(haddr_t start) const {
  Seal seal;
  haddr_t address = start;
  for (const auto& [at, page] : pages) {
    seal.checksum = checksum_of(seal.checksum, page);
    if (!write_at(file, address, &page, sizeof page)) return false;
    address += sizeof page;
  }
  seal.pages = pages.size();
  return write_at(file, address, &seal, sizeof seal);
}

/// The first commit writes everything in one call: a kill before it leaves an empty file.
bool PartFile::put_in_place() const {
  if (bare && !pages.empty()) {
    std::vector<char> begin(pages.rbegin()->first + page_bytes);
    for (const auto& [at, page] : pages)
      std::copy(page.bytes.begin(), page.bytes.end(), begin.begin() + static_cast<std::ptrdiff_t>(at));
    return write_at(file, 0, begin.data(), begin.size());
  }
  return std::all_of(pages.begin(), pages.end(), [&](const auto& entry) {
    return write_at(file, entry.first, entry.second.bytes.data(), page_bytes);
  });
}

bool PartFile::commit() {
  if (failed) return false;
  failed = true;  // until all is done
  const haddr_t start =
      up_to_page(std::max({end, allocated, pages.empty() ? 0 : pages.rbegin()->first + page_bytes}));
  if (!reserve(start) || (!bare && !pages.empty() && !append(start))) {
    cut_off(end);
    return false;
  }
  if (!put_in_place()) return false;
  bare = false;
  pages.clear();
  end = std::max(end, allocated);
  if (!cut_off(end)) return false;
  committed = std::max(first_bytes, end);
  failed = false;
  return true;
}

/// Lets no exception pass through HDF5, which is C.
template <class Result, class Work>
Result guarded(Result failed, const Work& work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    failure = ENOMEM;
    return failed;
  }
}

H5FD_t* open_part(const char* name, unsigned flags, hid_t, haddr_t) {
  return guarded<H5FD_t*>(nullptr, [&]() -> H5FD_t* {
    failure = 0;
    auto part = std::make_unique<PartFile>();
    part->writes = (flags & H5F_ACC_RDWR) != 0;
    part->bare = (flags & H5F_ACC_TRUNC) != 0;
    part->file = open(name, (part->writes ? O_RDWR : O_RDONLY) | O_CLOEXEC);
    if (part->file < 0) {
      fail_with(errno);
      return nullptr;
    }
    if (part->bare && !part->cut_off(0)) return nullptr;
    if (!part->take_appended()) return nullptr;
    part->committed = std::max(first_bytes, part->end);  // all that is there was committed, or is of no use
    return part.release();
  });
}

herr_t close_part(H5FD_t* file) {
  const std::unique_ptr<PartFile> part(&part_of(file));
  if (!part->writes) return 0;
  return guarded<herr_t>(-1, [&] { return part->commit() && part->cut_off(part->allocated) ? 0 : -1; });
}

herr_t query(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t get_allocated(const H5FD_t* file, H5FD_mem_t) { return part_of(file).allocated; }
herr_t set_allocated(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  part_of(file).allocated = end;
  return 0;
}
haddr_t get_end(const H5FD_t* file, H5FD_mem_t) { return part_of(file).end; }
herr_t get_handle(H5FD_t* file, hid_t, void** handle) {
  *handle = file;
  return 0;
}

herr_t read_part(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t count, void* bytes) {
  const PartFile& part = part_of(file);
  if (!read_at(part.file, address, bytes, count)) return -1;
  const haddr_t stop = address + count;
  for (auto entry = part.pages.lower_bound(address / page_bytes * page_bytes);
       entry != part.pages.end() && entry->first < stop; ++entry) {
    const haddr_t from = std::max(address, entry->first), to = std::min(stop, entry->first + page_bytes);
    std::memcpy(static_cast<char*>(bytes) + (from - address),
                entry->second.bytes.data() + (from - entry->first), to - from);
  }
  return 0;
}

herr_t write_part(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t count, const void* bytes) {
  PartFile& part = part_of(file);
  const haddr_t stop = address + count;
  const auto* from = static_cast<const char*>(bytes);
  while (address < std::min(stop, up_to_page(part.committed))) {
    Page* const page =
        guarded<Page*>(nullptr, [&] { return part.page_at(address / page_bytes * page_bytes); });
    if (!page) {
      part.failed = true;
      return -1;
    }
    const haddr_t some = std::min(stop, page->address + page_bytes) - address;
    std::memcpy(page->bytes.data() + (address - page->address), from, some);
    from += some;
    address += some;
  }
  if (address < stop && !write_at(part.file, address, from, stop - address)) {
    part.failed = true;
    return -1;
  }
  part.end = std::max(part.end, stop);
  return 0;
}

const H5FD_class_t& part_class() {
  static const H5FD_class_t made = [] {
    H5FD_class_t methods{};
#ifdef H5FD_CLASS_VERSION  // since HDF5 1.14
    methods.version = H5FD_CLASS_VERSION;
    methods.value = H5_VFD_RESERVED + 101;  // a number that nobody owns, for drivers that are not published
#endif
    methods.name = "sandstroke_part";
    methods.maxaddr = (haddr_t{1} << 62) - 1;
    methods.fc_degree = H5F_CLOSE_STRONG;  // closing the file also closes datasets that are still open
    methods.open = open_part;
    methods.close = close_part;
    methods.query = query;
    methods.get_eoa = get_allocated;
    methods.set_eoa = set_allocated;
    methods.get_eof = get_end;
    methods.get_handle = get_handle;
    methods.read = read_part;
    methods.write = write_part;
    constexpr H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(kinds), std::end(kinds), methods.fl_map);
    return methods;
  }();
  return made;
}

}  // namespace

Hdf5Handle part_access() {
  static const hid_t driver = H5FDregister(&part_class());
  if (driver < 0)
    throw_io_error(
        "the HDF5 library does not accept sandstroke's file driver; build sandstroke with the headers of "
        "this library");
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_driver(access, driver, nullptr);
  return access;
}

Hdf5Handle reading_access(const std::filesystem::path& path) {
  return path.extension() == ".part" ? part_access() : without_locks();
}

bool commit_part(const Hdf5Handle& file) {
  void* part = nullptr;
  return H5Fget_vfd_handle(file, H5P_DEFAULT, &part) >= 0 && static_cast<PartFile*>(part)->commit();
}

int part_failure() { return failure; }

}  // namespace sandstroke
