#include "hdf5/foreign_hdf5_reader.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "hdf5/hdf5_storage.h"

namespace sandstroke {
namespace {

/// What tells an object from others: its address, or since HDF5 1.12 a token.
template <class Info>
std::string place_of(const Info& info) {
  std::string place;
  const auto take = [&](const auto& value) {
    place.assign(reinterpret_cast<const char*>(&value), sizeof value);
  };
  if constexpr (requires { info.u.token; })
    take(info.u.token);
  else
    take(info.u.address);
  return place;
}

struct Gathered {
  std::vector<ForeignHdf5Reader::Member> members;
  std::size_t most = 0;
};

/// HDF5 calls this for each link.
template <class Info>
herr_t add_member(hid_t, const char* name, const Info* info, void* list) {
  auto& gathered = *static_cast<Gathered*>(list);
  if (gathered.members.size() > gathered.most) return 1;  // stops
  if (info->type == H5L_TYPE_HARD) gathered.members.push_back({"", name, place_of(*info)});
  return 0;
}

}  // namespace

std::vector<ForeignHdf5Reader::Member> ForeignHdf5Reader::own_members(const std::string& group,
                                                                      std::size_t most) const {
  Gathered gathered{{}, most};
  if (H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_member<H5L_info_t>,
                         &gathered, access_) < 0)
    fail_to_read(group, "cannot be read; the file is damaged");
  if (gathered.members.size() > most)
    fail(group, fmt::format("has more than {} members; save only what belongs to one stroke", most));
  std::sort(gathered.members.begin(), gathered.members.end(),
            [](const Member& a, const Member& b) { return a.name < b.name; });
  for (Member& member : gathered.members) {
    member.path = (group == "/" ? "" : group) + "/" + member.name;
    const Hdf5Handle object(H5Oopen(file_, member.path.c_str(), access_), H5Oclose);
    if (!object.valid()) fail_to_read(member.path, "cannot be read; the file is damaged");
    const H5I_type_t kind = H5Iget_type(object);
    if (kind == H5I_GROUP) member.kind = Member::Kind::group;
    if (kind == H5I_DATASET) member.kind = Member::Kind::dataset;
  }
  return std::move(gathered.members);
}

bool ForeignHdf5Reader::has_numbers(const std::string& dataset) const {
  const Hdf5Handle opened(H5Dopen2(file_, dataset.c_str(), access_), H5Dclose);
  if (!opened.valid()) fail_to_read(dataset, "cannot be read; the file is damaged");
  return is_hdf5_number(Hdf5Handle(H5Dget_type(opened), H5Tclose));
}

ForeignHdf5Reader::Numbers ForeignHdf5Reader::numbers(const std::string& dataset) const {
  Numbers numbers;
  numbers.shape = shape(dataset);
  double count = 1.0;
  for (const hsize_t side : numbers.shape) count *= static_cast<double>(side);
  if (count * sizeof(double) > most_unpacked(file_bytes_))
    fail(dataset,
         fmt::format("claims {:.0f} numbers, but its file has {} bytes; it is damaged", count, file_bytes_));
  const Hdf5Handle opened = open_dataset(dataset);
  const Hdf5Handle type(H5Dget_type(opened), H5Tclose);
  hid_t memory_type = H5T_NATIVE_DOUBLE;
  if (H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) == 8) {
    const bool natural = H5Tget_sign(type) == H5T_SGN_NONE;
    numbers.kind = natural ? Numbers::Kind::natural : Numbers::Kind::whole;
    memory_type = natural ? H5T_NATIVE_UINT64 : H5T_NATIVE_INT64;
  }
  numbers.bytes.resize(static_cast<std::size_t>(count) * sizeof(double));
  read(dataset, opened, memory_type, numbers.bytes.data());
  return numbers;
}

}  // namespace sandstroke
