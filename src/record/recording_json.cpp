#include "record/recording_json.h"

#include <algorithm>
#include <concepts>
#include <limits>

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

struct TakeField {
  const Json& json;

  template <class Field>
  void operator()(const char* name, Field& field) const {
    json.at(name).get_to(field);
  }
  /// nlohmann would cast any number to any other.
  template <std::signed_integral Count>
  void operator()(const char* name, Count& count) const {
    const std::int64_t number = json.at(name).get_ref<const Json::number_integer_t&>();
    if (number < 0 || number > std::min<std::int64_t>(most_ticks, std::numeric_limits<Count>::max()))
      throw Json::out_of_range::create(406, "no count", &json);
    count = static_cast<Count>(number);
  }
  void operator()(const char* name, double& number) const {
    const Json& value = json.at(name);
    number = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  }
  void operator()(const char* name, StopReason& reason) const {
    // Not of this program's reasons: a later one's. That there was one is all there is to know.
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
