#include "faults/content.h"

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "cli/program.h"
#include "core/hash.h"
#include "hdf5/hdf5_file.h"
#include "hdf5/part_driver.h"
#include "io/png_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& object) {
  throw std::runtime_error(fmt::format("{} cannot be read", object));
}

/// Adds what `read` puts into a buffer of this type and many elements.
template <class Read>
void add_values(hid_t type, hid_t space, const std::string& object, ContentHash& hash, const Read& read) {
  const auto count = static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
  if (count == 0) return;
  const Hdf5Handle memory_type(H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose);
  std::vector<char> bytes(count * H5Tget_size(memory_type));
  if (read(memory_type, bytes.data()) < 0) fail(object);
  if (H5Tget_class(type) == H5T_REFERENCE || H5Tget_class(type) == H5T_VLEN) return;  // addresses
  if (H5Tis_variable_str(type) <= 0) return hash.add(bytes.data(), bytes.size());
  auto** texts = reinterpret_cast<char**>(bytes.data());
  for (std::size_t i = 0; i < count; ++i) hash.add(std::string_view(texts[i] ? texts[i] : ""));
  H5Dvlen_reclaim(memory_type, space, H5P_DEFAULT, bytes.data());
}

/// True for what tells of the machine and the moment, not of what was asked for.
bool is_measured(const std::string& name) {
  for (const char* part : {"timing", "wall_seconds", "real_time_factor"})
    if (name.find(part) != std::string::npos) return true;
  return false;
}

herr_t add_attribute(hid_t object, const char* name, const H5A_info_t*, void* hash) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (is_measured(name)) return 0;
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  static_cast<ContentHash*>(hash)->add(std::string_view(name));
  add_values(type, space, name, *static_cast<ContentHash*>(hash),
             [&](hid_t memory_type, void* bytes) { return H5Aread(attribute, memory_type, bytes); });
  return 0;
}

/// Info: H5O_info_t of HDF5 1.10, which later versions call H5O_info1_t.
template <class Info>
herr_t add_object(hid_t file, const char* name, const Info* info, void* to) {
  auto& hash = *static_cast<ContentHash*>(to);
  if (is_measured(name)) return 0;
  const Hdf5Handle object(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  if (!object.valid()) return -1;
  hash.add(std::string_view(name));
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_attribute, to);
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Hdf5Handle type(H5Dget_type(object), H5Tclose), space(H5Dget_space(object), H5Sclose);
  try {
    add_values(type, space, name, hash, [&](hid_t memory_type, void* bytes) {
      return H5Dread(object, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes);
    });
  } catch (const std::runtime_error&) {  // which must not pass through HDF5
    return -1;
  }
  return 0;
}

std::string hdf5_content(const fs::path& path) {
  prepare_hdf5();
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, reading_access(path)), H5Fclose);
  if (!file.valid()) fail(path.string());
  ContentHash hash;
  if (H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add_object, &hash, H5O_INFO_BASIC) < 0)
    fail("an object in " + path.string());
  return hash.text();
}

std::string content_of_hdf5(const fs::path& path) {
  const std::string content = hdf5_content(path);
  const Hdf5Reader file(path);
  for (const char* object : {"/", "/stroke"})
    if (file.has_attribute(object, "complete") && file.number_attribute(object, "complete") != 1.0)
      throw std::runtime_error("has the name of a complete file, and says that it is not complete");
  return content;
}

void check_end(const std::string& text, const std::string& end) {
  if (!text.ends_with(end)) throw std::runtime_error("is cut off");
}

}  // namespace

std::string content_of(const fs::path& file) {
  const std::string kind = file.extension();
  if (kind == ".h5") return content_of_hdf5(file);
  if (kind == ".png") {
    const std::vector<std::uint8_t> pixels = read_png(file).rgb;
    return content_hash({reinterpret_cast<const char*>(pixels.data()), pixels.size()});
  }
  const std::string text = read_file(file);
  if (kind == ".json" && !nlohmann::json::accept(text)) throw std::runtime_error("is no JSON");
  check_end(text, kind == ".html" ? "</html>\n" : kind == ".xdmf" ? "</Xdmf>\n" : "\n");
  return content_hash(text);
}

bool can_be_read(const fs::path& part) {
  try {
    hdf5_content(part);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

std::string damage_in(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path path = entry.path();
    // Skips files not yet under their names, and the journal of a recording, which has its own checks.
    const bool in_part = path.string().find(".part") != std::string::npos;
    if (!entry.is_regular_file() || in_part || path.extension() == ".recording") continue;
    if (path.filename().string().starts_with(".")) continue;  // locks
    try {
      content_of(path);
    } catch (const std::exception& failure) {
      return fmt::format("{}: {}", path.lexically_relative(folder).string(), failure.what());
    }
  }
  return "";
}

}  // namespace sandstroke
