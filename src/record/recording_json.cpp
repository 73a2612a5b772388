#include "record/recording_json.h"

#include <concepts>
#include <limits>

#include "core/json_count.h"
#include "haptics/recording_fields.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

struct PutField {
  Json& json;

  template <class Field>
  void operator()(const char* name, const Field& field) const {
    json[name] = field;
  }
  void operator()(const char* name, const StopReason& reason) const { json[name] = stop_reason_text(reason); }
};

/// Reads fields. A number, or yes and no, that is missing, because the file is older than it, keeps its
/// default.
struct TakeField {
  const Json& json;

  template <class Field>
  void operator()(const char* name, Field& field) const {
    json.at(name).get_to(field);
  }
  template <std::signed_integral Count>
  void operator()(const char* name, Count& count) const {
    if (json.contains(name)) count = json_count<Count>(json.at(name), most_ticks);
  }
  void operator()(const char* name, bool& flag) const {
    if (json.contains(name)) json.at(name).get_to(flag);
  }
  void operator()(const char* name, double& number) const {
    if (!json.contains(name)) return;
    const Json& value = json.at(name);
    number = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  }
  void operator()(const char* name, StopReason& reason) const {
    // A reason that this program does not know, from a later one, becomes cut_off.
    reason = stop_reason_of(json.at(name).get<std::string>()).value_or(StopReason::cut_off);
  }
};

}  // namespace

Json as_json(const RecordingHeader& header) {
  Json json;
  visit_header(header, PutField{json});
  return json;
}

Json as_json(const RecordingFooter& footer) {
  Json json;
  visit_footer(footer, PutField{json});
  return json;
}

RecordingHeader header_from_json(const Json& json) {
  RecordingHeader header;
  visit_header(header, TakeField{json});
  return header;
}

RecordingFooter footer_from_json(const Json& json) {
  RecordingFooter footer;
  visit_footer(footer, TakeField{json});
  return footer;
}

}  // namespace sandstroke
